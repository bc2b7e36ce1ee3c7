//! Bytes of snapshots, read back by readers that share nothing with the writers: each value must return bit for bit.

use pd_verify::record::Snapshot;
use pd_verify::report::{npy, pvd, vti};

/// A plate of 5 × 3 cells whose values tell where they belong; one cell is empty.
fn plate() -> Snapshot {
    let field = |of: f64| -> Vec<Vec<f64>> {
        let component = |axis: usize| {
            let value =
                |n: usize| if n == 7 { f64::NAN } else { (of + axis as f64) / (n as f64 + 3.0) - 0.1 };
            (0..15).map(value).collect()
        };
        (0..2).map(component).collect()
    };
    Snapshot {
        name: "s".into(),
        index: 3,
        step: 12,
        time: 12.0 * 1.1e-7,
        nodes: vec![5, 3],
        spacing: 0.1 / 3.0,
        displacement: field(1e-6),
        velocity: field(7.0),
    }
}

fn bar() -> Snapshot {
    let one = |values: &[f64]| vec![values.to_vec()];
    let (displacement, velocity) = (one(&[1.5, -0.0, f64::MIN_POSITIVE]), one(&[-1.0, 2.0, 1e300]));
    Snapshot { nodes: vec![3], displacement, velocity, ..plate() }
}

/// What stands between two pieces of text.
fn between<'a>(text: &'a str, before: &str, after: &str) -> &'a str {
    text.split_once(before).unwrap_or_else(|| panic!("no {before} in {text}")).1.split_once(after).unwrap().0
}

fn number(bytes: &[u8]) -> [u8; 8] {
    bytes[..8].try_into().unwrap()
}

/// The numbers of an appended array: as many bytes as its header says.
fn appended(bytes: &[u8], name: &str) -> Vec<f64> {
    let text = String::from_utf8_lossy(bytes);
    let array = between(&text, &format!("Name=\"{name}\""), "/>");
    let offset: usize = between(array, "offset=\"", "\"").parse().unwrap();
    let start = bytes.windows(2).position(|two| two == b"\n_").unwrap() + 2;
    let data = &bytes[start + offset..];
    let count = u64::from_le_bytes(number(data)) as usize;
    data[8..8 + count].chunks(8).map(|eight| f64::from_le_bytes(number(eight))).collect()
}

fn same_bits(found: &[f64], expected: impl Iterator<Item = f64>) {
    let bits: Vec<u64> = expected.map(f64::to_bits).collect();
    assert_eq!(found.iter().map(|value| value.to_bits()).collect::<Vec<_>>(), bits);
}

#[test]
fn image_data_holds_each_cell_at_its_place() {
    for (snapshot, extent) in [(plate(), "0 5 0 3 0 0"), (bar(), "0 3 0 1 0 0")] {
        let bytes = vti(&snapshot);
        let text = String::from_utf8_lossy(&bytes);
        assert_eq!(between(&text, "WholeExtent=\"", "\""), extent);
        assert_eq!(between(&text, "Piece Extent=\"", "\""), extent);
        let spacing: Vec<f64> =
            between(&text, "Spacing=\"", "\"").split(' ').map(|dx| dx.parse().unwrap()).collect();
        same_bits(&spacing, [snapshot.spacing; 3].into_iter());
        same_bits(&appended(&bytes, "TimeValue"), [snapshot.time].into_iter());
        for (name, field) in [("displacement", &snapshot.displacement), ("velocity", &snapshot.velocity)] {
            let zero = vec![0.0; field[0].len()];
            let [y, z] = [field.get(1).unwrap_or(&zero), &zero];
            let cells = field[0].iter().zip(y).zip(z).flat_map(|((x, y), z)| [*x, *y, *z]);
            same_bits(&appended(&bytes, name), cells);
        }
        // Nothing is left over: the last array ends where the appended data do.
        let end = b"\n</AppendedData>\n</VTKFile>\n";
        assert!(bytes.ends_with(end));
        let last = bytes.len() - end.len() - 8;
        let z = f64::from_le_bytes(number(&bytes[last..]));
        assert_eq!(z.to_bits(), 0.0_f64.to_bits());
        let start = bytes.windows(2).position(|two| two == b"\n_").unwrap() + 2;
        assert_eq!(bytes.len() - end.len() - start, 16 + 2 * (8 + 24 * snapshot.displacement[0].len()));
    }
}

#[test]
fn arrays_of_numpy_hold_each_node_at_its_place() {
    for (snapshot, shape) in [(plate(), "3, 5, 2"), (bar(), "3, 1")] {
        let bytes = npy(&snapshot.nodes, &snapshot.velocity);
        assert_eq!(&bytes[..8], b"\x93NUMPY\x01\x00");
        let length = u16::from_le_bytes([bytes[8], bytes[9]]) as usize;
        assert_eq!((10 + length) % 64, 0);
        let header = std::str::from_utf8(&bytes[10..10 + length]).unwrap();
        assert!(header.ends_with('\n'));
        assert_eq!(between(header, "'descr': '", "'"), "<f8");
        assert_eq!(between(header, "'fortran_order': ", ","), "False");
        assert_eq!(between(header, "'shape': (", ")"), shape);
        let values: Vec<f64> =
            bytes[10 + length..].chunks(8).map(|eight| f64::from_le_bytes(number(eight))).collect();
        let nodes = 0..snapshot.velocity[0].len();
        same_bits(&values, nodes.flat_map(|n| snapshot.velocity.iter().map(move |values| values[n])));
    }
}

#[test]
fn a_collection_lists_files_with_their_times() {
    let text = pvd([(0.0, "a.000.vti"), (1.5e-6, "a.001.vti")]);
    let rows: Vec<&str> = text.lines().filter(|line| line.starts_with("<DataSet")).collect();
    assert_eq!(rows.len(), 2);
    assert_eq!(between(rows[1], "timestep=\"", "\"").parse::<f64>().unwrap(), 1.5e-6);
    assert_eq!(between(rows[1], "file=\"", "\""), "a.001.vti");
}
