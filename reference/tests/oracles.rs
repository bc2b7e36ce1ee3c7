//! Are the tables the ones described? Checksums, row counts and the printed precision.

use pd_verify_reference::{Kernel, oracles};

const README: &str = include_str!("../data/README.md");

/// Fowler, Noll and Vo's hash, variant 1a, 64 bits.
fn fnv(text: &str) -> u64 {
    text.bytes()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

#[test]
fn checksums_are_those_of_the_readme() {
    for (file, text) in [
        ("continuum_dispersion.csv", oracles::CONTINUUM_CSV),
        ("published_values.csv", oracles::PUBLISHED_CSV),
    ] {
        let line =
            README.lines().find(|line| line.starts_with(&format!("| `{file}`"))).expect("a row per file");
        let sum = format!("{:016x}", fnv(text));
        assert!(line.contains(&sum), "{file} hashes to {sum}; the README says {line}");
    }
}

#[test]
fn every_row_of_the_continuum_table_is_a_wave() {
    let table = oracles::continuum_table();
    assert_eq!(table.len(), 11 * 18 * 3);
    for row in &table {
        assert!(row.phase_speed_ratio > 0.0 && row.phase_speed_ratio <= 1.0, "{row:?}");
        assert!(row.group_speed_ratio.abs() <= 1.0, "{row:?}");
        assert!((row.dimension, row.branch.as_str()) != (1, "S"), "a bar has one branch");
    }
    assert_eq!(table.iter().filter(|row| row.kernel == Kernel::Gaussian { p: 7.3 }).count(), 54);
}

#[test]
fn printed_numbers_carry_their_precision() {
    let reflections = oracles::published("reflection_fd_lattice");
    assert_eq!(reflections.iter().map(|row| row.value).collect::<Vec<_>>(), [0.024, 0.084, 0.224]);
    assert!(reflections.iter().all(|row| row.half_unit == 0.0005));
    assert_eq!(oracles::published("neighbours_plane")[0].half_unit, 0.5);
    let printed_to_the_last_bit = &oracles::published("lattice_bar_omega_over_v")[0];
    assert_eq!(printed_to_the_last_bit.half_unit, printed_to_the_last_bit.value * f64::EPSILON);
}
