//! Data files that a page shows as tables, since they are answers and not evidence.

use super::Folder;
use pd_verify::report::Shown;
use std::path::Path;

/// A data file, what it answers, and its columns that a page has room for.
const SHOWN: [(&str, &str, &str, &[&str]); 2] = [
    (
        "work_cheapest.csv",
        "What accuracy costs",
        "The cheapest way to each error, by bond updates, which are exact, and by seconds, which are those of this machine. Bytes are those that the march holds.",
        &[
            "case",
            "error",
            "by",
            "method",
            "kernel",
            "p",
            "m",
            "volume_rule",
            "calibrated",
            "time_step_over_limit",
            "extraction",
            "dx_m",
            "bond_updates",
            "seconds",
            "bytes_peak",
        ],
    ),
    (
        "ablation.csv",
        "What each effect costs",
        "One plate with each effect on: its rate, bytes and largest time step over those of the plain plate, and how much the result changes.",
        &["case", "effect", "rate_over_plain", "bytes_over_plain", "limit_over_plain", "change_l2"],
    ),
];

/// Rows beyond these are in the file alone.
const MOST: usize = 200;

/// The tables of a folder that are shown.
pub fn shown(folder: &Folder, place: &Path) -> Vec<Shown> {
    let written = |file: &str| folder.tables.iter().any(|table| table.file.name == file);
    let asked = SHOWN.iter().filter(|(file, ..)| written(file));
    asked.filter_map(|&(file, title, caption, columns)| read(place, file, title, caption, columns)).collect()
}

fn read(place: &Path, file: &str, title: &str, caption: &str, columns: &[&str]) -> Option<Shown> {
    let mut reader = csv::Reader::from_path(place.join(file)).ok()?;
    let headers = reader.headers().ok()?.clone();
    let at: Vec<usize> =
        columns.iter().map(|column| headers.iter().position(|one| one == *column)).collect::<Option<_>>()?;
    let rows: Vec<Vec<String>> = reader
        .records()
        .take(MOST)
        .map_while(Result::ok)
        .map(|record| at.iter().map(|&column| short(&record[column])).collect())
        .collect();
    Some(Shown {
        id: file.trim_end_matches(".csv").to_owned(),
        title: title.to_owned(),
        caption: format!("{caption} All digits are in {file}."),
        columns: columns.iter().map(|column| column.replace('_', " ")).collect(),
        rows,
    })
}

/// Numbers with four digits; all else as it is.
fn short(cell: &str) -> String {
    match cell.parse::<f64>() {
        Ok(number) if cell.len() > 6 => pd_verify::report::readable(Some(number)),
        _ => cell.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_found_by_name_and_a_file_without_them_is_not_shown() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        std::fs::write(&path, "x,y,z\n1.23456789,two,3\n").unwrap();
        let read = |columns: &[&str]| read(folder.path(), "a.csv", "A", "C.", columns);
        let table = read(&["z", "y", "x"]).unwrap();
        assert_eq!(table.rows, [["3", "two", "1.235"]]);
        assert_eq!((table.id.as_str(), table.columns.len()), ("a", 3));
        assert!(read(&["z", "w"]).is_none());
    }
}
