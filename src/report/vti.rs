//! Snapshots as VTK files: ImageData (.vti) with its cells' values as raw bytes, and the list of times (.pvd).

use crate::record::Snapshot;
use std::fmt::Write;

/// A snapshot as ImageData. Cells have the size Δx and the nodes stand at their centres; cell data `displacement` in m
/// and `velocity` in m/s have three components (x, y, 0), row by row along x; `TimeValue` is t in s.
///
/// Raw appended data: before each array the number of its bytes as an unsigned integer of 64 bits, all little-endian.
/// (VTK User's Guide, 11th edition, "XML file formats".)
pub fn vti(snapshot: &Snapshot) -> Vec<u8> {
    let fields = [("displacement", &snapshot.displacement), ("velocity", &snapshot.velocity)];
    let [columns, rows] = [0, 1].map(|axis| snapshot.nodes.get(axis).copied().unwrap_or(1));
    let extent = format!("0 {columns} 0 {rows} 0 0");
    let (header, number) = (size_of::<u64>(), size_of::<f64>());
    let mut text = format!(
        r#"<?xml version="1.0"?>
<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" header_type="UInt64">
<ImageData WholeExtent="{extent}" Origin="0 0 0" Spacing="{dx} {dx} {dx}">
<FieldData>
<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="appended" offset="0"/>
</FieldData>
<Piece Extent="{extent}">
<CellData Vectors="displacement">
"#,
        dx = snapshot.spacing
    );
    let mut offset = header + number;
    for (name, _) in fields {
        let _ = writeln!(
            text,
            r#"<DataArray type="Float64" Name="{name}" NumberOfComponents="3" format="appended" offset="{offset}"/>"#
        );
        offset += header + 3 * number * columns * rows;
    }
    text += "</CellData>\n</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_";
    let mut bytes = Vec::with_capacity(text.len() + offset + 64);
    bytes.extend(text.as_bytes());
    bytes.extend((number as u64).to_le_bytes());
    bytes.extend(snapshot.time.to_le_bytes());
    for (_, components) in fields {
        bytes.extend((3 * number as u64 * (columns * rows) as u64).to_le_bytes());
        for node in 0..columns * rows {
            for axis in 0..3 {
                bytes.extend(components.get(axis).map_or(0.0, |values| values[node]).to_le_bytes());
            }
        }
    }
    bytes.extend(b"\n</AppendedData>\n</VTKFile>\n");
    bytes
}

/// The list that lets ParaView play files of many times; each is (t in s, file).
pub fn pvd<'a>(files: impl IntoIterator<Item = (f64, &'a str)>) -> String {
    let mut text = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n",
    );
    for (time, file) in files {
        let _ = writeln!(text, r#"<DataSet timestep="{time:e}" part="0" file="{file}"/>"#);
    }
    text + "</Collection>\n</VTKFile>\n"
}
