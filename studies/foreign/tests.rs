//! The reader: NumPy arrays of every kind that is read, and any bytes at all.

use super::{Asked, Delimiter, Keys, Source, Wanted, read};
use proptest::prelude::*;

fn wanted() -> Vec<Wanted> {
    vec![Wanted::new("t_s", "s", &["t"], "time"), Wanted::new("k", "1", &[], "value")]
}

fn columns(bytes: &[u8], asked: &Asked) -> Result<Vec<Vec<f64>>, String> {
    let table = |source: Source| read("x", &source, &wanted(), Keys::Growing("t_s"), asked);
    let data = Source::of("x", bytes, None).and_then(table).map_err(|refusal| refusal.to_string())?;
    Ok(["t_s", "k"].map(|name| data.of(name).to_vec()).to_vec())
}

fn npy(head: &str, body: &[u8]) -> Vec<u8> {
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((head.len() as u16).to_le_bytes());
    bytes.extend(head.as_bytes());
    bytes.extend(body);
    bytes
}

#[test]
fn arrays_are_read_in_both_orders_of_bytes_and_of_axes() {
    let right = Ok(vec![vec![0.0, 1.0, 2.0], vec![5.0, 6.0, 7.0]]);
    let rows = [0.0_f64, 5.0, 1.0, 6.0, 2.0, 7.0];
    let by_column = [0.0_f32, 1.0, 2.0, 5.0, 6.0, 7.0];
    let little: Vec<u8> = rows.iter().flat_map(|x| x.to_le_bytes()).collect();
    let big: Vec<u8> = by_column.iter().flat_map(|x| x.to_be_bytes()).collect();
    let head = |descr: &str, fortran: &str, shape: &str| {
        format!("{{'descr': {descr}, 'fortran_order': {fortran}, 'shape': {shape}, }}\n")
    };
    let of = |head: String, body: &[u8]| columns(&npy(&head, body), &Asked::default());
    assert_eq!(of(head("'<f8'", "False", "(3, 2)"), &little), right);
    assert_eq!(of(head("'>f4'", "True", "(3, 2)"), &big), right);
    assert_eq!(of(head("[('t', '<f8'), ('k', '<f8')]", "False", "(3,)"), &little), right);
    assert!(of(head("'<f8'", "False", "(4, 2)"), &little).unwrap_err().contains("other numbers"));
    assert!(of(head("'<i8'", "False", "(3, 2)"), &little).unwrap_err().contains("f4 and f8"));
    assert!(of(head("'<f8'", "False", "(6,)"), &little).unwrap_err().contains("no table"));
    let huge = head("'<f8'", "True", "(18446744073709551615, 9999)");
    assert!(of(huge, &little).is_err());
}

#[test]
fn units_of_headers_endings_and_options_are_converted() {
    let of = |text: &str, unit: &[(&str, &str)]| {
        let unit = unit.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect();
        columns(text.as_bytes(), &Asked { unit, ..Asked::default() })
    };
    let right = Ok(vec![vec![1e-6, 2e-6], vec![3.0, 4.0]]);
    assert_eq!(of("t_us,k\n1,3\n2,4\n", &[]), right);
    assert_eq!(of("k;t [us]\n3;1\n4;2\n", &[]).map(|found| found[1].clone()), Ok(vec![3.0, 4.0]));
    assert_eq!(of("k\tt\n3,0\t1e-6\n4,0\t2e-6\n", &[]), right);
    assert_eq!(of("t,k\n1e-3,300\n2e-3,400\n", &[("t", "ms"), ("k", "%")]), right);
}

fn pieces() -> impl Strategy<Value = Vec<u8>> {
    let words = [
        "t", "k", "t_us", "t [us]", ",", ";", "\t", " ", "\n", "\r", "#", "\"", "1", "-2.5", "1d3", "nan",
        "é", "\u{feff}",
    ];
    let words = words.map(|word| word.as_bytes().to_vec()).to_vec();
    let piece =
        prop_oneof![8 => proptest::sample::select(words), 1 => proptest::collection::vec(any::<u8>(), 0..8)];
    proptest::collection::vec(piece, 0..60).prop_map(|pieces| pieces.concat())
}

proptest! {
    #[test]
    fn no_bytes_panic_the_reader(text in pieces(), head in "[ -~]{0,80}", body in proptest::collection::vec(any::<u8>(), 0..64), unit in "[a-zA-Z0-9*/^().√ -]{0,30}") {
        for delimiter in [None, Some(Delimiter::Blank), Some(Delimiter::Comma)] {
            if let Ok(source) = Source::of("x", &text, delimiter) {
                let _ = read("x", &source, &wanted(), Keys::Distinct(&["t_s", "k"]), &Asked::default());
            }
        }
        let _ = columns(&npy(&head, &body), &Asked::default());
        let asked = Asked { unit: vec![("t".into(), unit)], map: vec![("k".into(), "2".into())] };
        let _ = columns(b"t,b\n1,2\n", &asked);
    }

    #[test]
    fn no_head_of_an_array_panics_the_reader(rows in any::<u64>(), width in any::<u64>(), fortran in any::<bool>(), size in prop_oneof![Just("<f4"), Just(">f8"), Just("|u1")]) {
        let fortran = if fortran { "True" } else { "False" };
        let head = format!("{{'descr': '{size}', 'fortran_order': {fortran}, 'shape': ({rows}, {width}), }}");
        let _ = columns(&npy(&head, &[0; 64]), &Asked::default());
    }
}
