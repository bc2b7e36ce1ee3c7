//! Arrays as NumPy files (.npy), format 1.0.

/// Fields of a lattice as one array of shape (…, ny, nx, components), C order, little-endian doubles.
///
/// `nodes` along x, y; `components` hold one field each, row by row along x.
/// (NumPy Enhancement Proposal 1: magic, version, length of the header, the header padded to 64 bytes, the data.)
pub fn npy(nodes: &[usize], components: &[Vec<f64>]) -> Vec<u8> {
    let shape: Vec<String> = nodes.iter().rev().chain([&components.len()]).map(usize::to_string).collect();
    let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}), }}", shape.join(", "));
    const BEFORE: usize = 10;
    let whole = (BEFORE + header.len() + 1).next_multiple_of(64);
    let header = format!("{header:<width$}\n", width = whole - BEFORE - 1);
    let count: usize = nodes.iter().product();
    let mut bytes = Vec::with_capacity(whole + size_of::<f64>() * count * components.len());
    bytes.extend(b"\x93NUMPY\x01\x00");
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    for node in 0..count {
        components.iter().for_each(|values| bytes.extend(values[node].to_le_bytes()));
    }
    bytes
}
