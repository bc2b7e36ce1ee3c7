//! Data files that a page shows as tables, since they are answers and not evidence.

use super::Folder;
use pd_verify::report::Shown;
use std::path::Path;

/// A data file, what it answers, and what a page has room for: headings, each over one column or several.
const SHOWN: [(&str, &str, &str, &[Heading]); 2] = [
    (
        "work_cheapest.csv",
        "What accuracy costs",
        "The cheapest way to each error, by bond updates, which are exact, and by seconds, which are those of this machine. Bytes are those that the march holds.",
        &[
            ("case", &["case"]),
            ("error", &["error"]),
            ("by", &["by"]),
            ("way", &["method", "kernel", "p", "m", "volume_rule", "calibrated", "extraction"]),
            ("Δt over its limit", &["time_step_over_limit"]),
            ("Δx in m", &["dx_m"]),
            ("bond updates", &["bond_updates"]),
            ("seconds", &["seconds"]),
            ("bytes", &["bytes_peak"]),
        ],
    ),
    (
        "ablation.csv",
        "What each effect costs",
        "One plate with each effect on: its rate, bytes and largest time step over those of the plain plate, and how much the result changes.",
        &[
            ("case", &["case"]),
            ("effect", &["effect"]),
            ("rate over plain", &["rate_over_plain"]),
            ("bytes over plain", &["bytes_over_plain"]),
            ("Δt limit over plain", &["limit_over_plain"]),
            ("change in l2", &["change_l2"]),
        ],
    ),
];

/// A heading and the columns that stand under it.
type Heading = (&'static str, &'static [&'static str]);

/// Rows beyond these are in the file alone.
const MOST: usize = 200;

/// The tables of a folder that are shown.
pub fn shown(folder: &Folder, place: &Path) -> Vec<Shown> {
    let written = |file: &str| folder.tables.iter().any(|table| table.file.name == file);
    let asked = SHOWN.iter().filter(|(file, ..)| written(file));
    asked.filter_map(|&(file, title, caption, columns)| read(place, file, title, caption, columns)).collect()
}

fn read(place: &Path, file: &str, title: &str, caption: &str, headings: &[Heading]) -> Option<Shown> {
    let mut reader = csv::Reader::from_path(place.join(file)).ok()?;
    let headers = reader.headers().ok()?.clone();
    let at = |column: &&str| headers.iter().position(|one| one == *column);
    let places: Vec<Vec<usize>> =
        headings.iter().map(|(_, columns)| columns.iter().map(at).collect()).collect::<Option<_>>()?;
    let cell = |record: &csv::StringRecord, (_, columns): &Heading, places: &[usize]| {
        if let [place] = places {
            return short(&record[*place]);
        }
        let given = columns.iter().zip(places).filter(|(_, place)| !record[**place].is_empty());
        let words: Vec<String> = given.map(|(column, place)| word(column, &record[*place])).collect();
        if words.is_empty() { "none comes so near".to_owned() } else { words.join(", ") }
    };
    let row = |record: csv::StringRecord| {
        headings.iter().zip(&places).map(|(heading, places)| cell(&record, heading, places)).collect()
    };
    Some(Shown {
        id: file.trim_end_matches(".csv").to_owned(),
        title: title.to_owned(),
        caption: format!("{caption} All digits are in {file}."),
        columns: headings.iter().map(|(heading, _)| (*heading).to_owned()).collect(),
        rows: reader.records().take(MOST).map_while(Result::ok).map(row).collect(),
    })
}

/// A value among others of a cell.
fn word(column: &str, value: &str) -> String {
    match (column, value) {
        ("p" | "m", value) => format!("{column} = {value}"),
        ("calibrated", "true") => "calibrated".to_owned(),
        ("calibrated", _) => "as printed".to_owned(),
        (_, value) => value.replace('_', " "),
    }
}

/// Numbers with four digits; words without underscores.
fn short(cell: &str) -> String {
    match cell.parse::<f64>() {
        Ok(number) if cell.len() > 6 => pd_verify::report::readable(Some(number)),
        _ => cell.replace('_', " "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_found_by_name_and_a_file_without_them_is_not_shown() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        std::fs::write(&path, "x,y,z,m\n1.23456789,two,3,4\n2,,,\n").unwrap();
        let read = |headings: &[Heading]| read(folder.path(), "a.csv", "A", "C.", headings);
        let table = read(&[("z", &["z"]), ("way", &["y", "m"]), ("x", &["x"])]).unwrap();
        assert_eq!(table.rows, [["3", "two, m = 4", "1.235"], ["", "none comes so near", "2"]]);
        assert_eq!((table.id.as_str(), table.columns.len()), ("a", 3));
        assert!(read(&[("z", &["z"]), ("w", &["w"])]).is_none());
    }
}
