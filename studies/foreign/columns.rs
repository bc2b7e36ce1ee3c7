//! The columns that a case asks for, found among those of a file, in SI, and checked row by row.

use super::source::Source;
use super::text::number;
use super::unit::Unit;
use crate::input::{Refusal, nearest, to_si_factor};
use std::collections::HashMap;

/// More rows say nothing more.
const MOST_ROWS: usize = 1_000_000;

/// A column that a case asks for.
#[derive(Debug, Clone)]
pub struct Wanted {
    /// With its SI unit as ending: `t_s`.
    pub name: &'static str,
    /// SI.
    pub unit: &'static str,
    /// Other names it goes by, in lower case.
    pub short: &'static [&'static str],
    pub what: String,
    /// Another quantity that says the same: its name, its SI unit, and what its numbers are multiplied by.
    pub instead: Option<(&'static str, &'static str, f64)>,
}

impl Wanted {
    pub fn new(
        name: &'static str,
        unit: &'static str,
        short: &'static [&'static str],
        what: impl Into<String>,
    ) -> Self {
        Self { name, unit, short, what: what.into(), instead: None }
    }

    fn is_called(&self, word: &str) -> bool {
        let word = word.to_lowercase();
        self.name == word || self.short.contains(&word.as_str())
    }
}

/// What tells rows apart.
#[derive(Debug, Clone, Copy)]
pub enum Keys {
    /// This column grows from row to row.
    Growing(&'static str),
    /// No two rows agree in all of these.
    Distinct(&'static [&'static str]),
}

/// What the command line says of a file's columns: pairs (ours, theirs) and (ours, unit).
#[derive(Debug, Clone, Default)]
pub struct Asked {
    pub map: Vec<(String, String)>,
    pub unit: Vec<(String, String)>,
}

/// The wanted columns of a file, in SI.
#[derive(Debug, Clone)]
pub struct Data {
    pub columns: Vec<(&'static str, Vec<f64>)>,
    /// What was assumed of the file.
    pub said: Vec<String>,
}

impl Data {
    /// A column by name; empty where there is none.
    pub fn of(&self, name: &str) -> &[f64] {
        self.columns.iter().find(|(other, _)| *other == name).map_or(&[], |(_, column)| column)
    }
}

/// Where a wanted column stands, and how its numbers become SI.
struct Found {
    at: usize,
    scale: Scale,
}

/// Times a unit's factor, or a power of ten from the name, times what another quantity is multiplied by.
#[derive(Clone, Copy)]
struct Scale {
    times: f64,
    over: f64,
}

impl Scale {
    fn apply(self, number: f64) -> f64 {
        if self.over == 1.0 { number * self.times } else { number / self.over * self.times }
    }
}

/// A name from a header: what stands before a unit in brackets, and the unit.
fn titled(name: &str) -> (&str, Option<&str>) {
    let cut = |open: char, close: char| {
        let (name, rest) = name.split_once(open)?;
        let unit = rest.trim_end().strip_suffix(close)?;
        (!name.trim().is_empty() && !unit.trim().is_empty()).then(|| (name.trim(), Some(unit.trim())))
    };
    cut('[', ']').or_else(|| cut('(', ')')).unwrap_or((name.trim(), None))
}

/// Reads the wanted columns of a source.
pub fn read(
    file: &str,
    source: &Source,
    wanted: &[Wanted],
    keys: Keys,
    asked: &Asked,
) -> Result<Data, Refusal> {
    check_words(wanted, asked)?;
    let mut said = Vec::new();
    let found: Vec<Found> = match source.header() {
        Some(header) => {
            let find = |one: &Wanted| by_name(file, one, &header, asked, &mut said);
            wanted.iter().map(find).collect::<Result<_, _>>()?
        }
        None => {
            said.push(format!("no header: columns taken as {}", names(wanted)));
            let find = |(at, one): (usize, &Wanted)| by_place(file, one, at, source.width(), wanted, asked);
            wanted.iter().enumerate().map(find).collect::<Result<_, _>>()?
        }
    };
    let mut columns: Vec<Vec<f64>> = vec![Vec::new(); wanted.len()];
    let at: Vec<usize> = found.iter().map(|one| one.at).collect();
    let mut checks = Checks::new(wanted, keys);
    source.rows(&at, |place, cells, numbers| {
        if columns[0].len() == MOST_ROWS {
            return Err(Refusal::new(format!("{place}: more than {MOST_ROWS} rows"))
                .help("report fewer times or places: some hundreds are enough"));
        }
        let mut row = Vec::with_capacity(wanted.len());
        for (index, (one, found)) in wanted.iter().zip(&found).enumerate() {
            let written = match &numbers {
                Some(numbers) => numbers[index],
                None => number(&cells[index]).ok_or_else(|| no_number(&place, one, &cells[index]))?,
            };
            let si = found.scale.apply(written);
            if !si.is_finite() {
                let message = format!("{place}: column {}: {written} is no quantity", one.name);
                return Err(Refusal::new(message).help(
                    "leave out rows that have no value, or mend the run: NaN and infinity are never judged",
                ));
            }
            row.push(si);
        }
        checks.row(&place, &row)?;
        columns.iter_mut().zip(row).for_each(|(column, number)| column.push(number));
        Ok(())
    })?;
    if columns.iter().any(Vec::is_empty) {
        return Err(Refusal::new(format!("{file} has a header and no rows"))
            .help("write a row for every time, place or level"));
    }
    Ok(Data { columns: wanted.iter().map(|one| one.name).zip(columns).collect(), said })
}

/// How many of the wanted columns a file has.
pub fn found(source: &Source, wanted: &[Wanted], asked: &Asked) -> usize {
    if check_words(wanted, asked).is_err() {
        return 0;
    }
    match source.header() {
        Some(header) => {
            wanted.iter().filter(|one| by_name("", one, &header, asked, &mut Vec::new()).is_ok()).count()
        }
        None if source.width() == wanted.len() || !asked.map.is_empty() => wanted.len(),
        None => 0,
    }
}

fn names(wanted: &[Wanted]) -> String {
    wanted.iter().map(|one| one.name).collect::<Vec<_>>().join(", ")
}

/// Refuses words of --map and --unit that name no column.
fn check_words(wanted: &[Wanted], asked: &Asked) -> Result<(), Refusal> {
    for (option, pairs) in [("--map", &asked.map), ("--unit", &asked.unit)] {
        for (index, (ours, theirs)) in pairs.iter().enumerate() {
            let all = || {
                wanted.iter().flat_map(|one| {
                    one.instead
                        .map(|other| other.0)
                        .into_iter()
                        .chain([one.name])
                        .chain(one.short.iter().copied())
                })
            };
            if !all().any(|known| known == ours.to_lowercase()) {
                let near =
                    nearest(ours, all()).map_or(String::new(), |near| format!("did you mean {near}? "));
                return Err(Refusal::new(format!(
                    "{option} {ours}={theirs}: no column is called {ours} here"
                ))
                .help(format!("{near}columns are {}", names(wanted))));
            }
            if pairs[..index].iter().any(|(other, _)| other == ours) {
                return Err(
                    Refusal::new(format!("{option} {ours} is given twice")).help("keep one of the two")
                );
            }
        }
    }
    Ok(())
}

fn asked_of(pairs: &[(String, String)], is: impl Fn(&str) -> bool) -> Option<&str> {
    pairs.iter().find(|(ours, _)| is(ours)).map(|(_, theirs)| theirs.as_str())
}

fn by_name(
    file: &str,
    one: &Wanted,
    header: &[&str],
    asked: &Asked,
    said: &mut Vec<String>,
) -> Result<Found, Refusal> {
    let own = find_in(file, header, asked, (one.name, one.unit), |word| one.is_called(word), 1.0, said)?;
    if let Some(found) = own {
        return Ok(found);
    }
    if let Some((name, unit, times)) = one.instead
        && let Some(found) = find_in(file, header, asked, (name, unit), |word| word == name, times, said)?
    {
        return Ok(found);
    }
    let titles = header.iter().map(|title| titled(title).0);
    let candidates = titles.clone();
    let near = nearest(one.name, candidates)
        .map_or(String::new(), |near| format!("is it \"{near}\"? --map {}={near}; ", one.name));
    let or = one.instead.map_or(String::new(), |(name, ..)| format!(" or {name}"));
    let shown: Vec<&str> = titles.take(20).collect();
    Err(Refusal::new(format!("{file}: no column {}{or} ({})", one.name, one.what)).help(format!(
        "{near}the columns are: {}; name it with --map {}=THEIRS",
        shown.join(", "),
        one.name
    )))
}

/// A column by its own name, by one that it goes by, with another unit as ending, or as --map says.
fn find_in(
    file: &str,
    header: &[&str],
    asked: &Asked,
    (name, unit): (&str, &str),
    is_called: impl Fn(&str) -> bool,
    times: f64,
    said: &mut Vec<String>,
) -> Result<Option<Found>, Refusal> {
    let written_unit = asked_of(&asked.unit, &is_called);
    let (at, over, unit_of_header) = match asked_of(&asked.map, &is_called) {
        Some(theirs) => {
            let by_number = || {
                theirs.parse::<usize>().ok().and_then(|at| at.checked_sub(1)).filter(|at| *at < header.len())
            };
            let found = header.iter().position(|title| *title == theirs || titled(title).0 == theirs);
            let Some(at) = found.or_else(by_number) else {
                let near = nearest(theirs, header.iter().copied())
                    .map_or(String::new(), |near| format!("did you mean \"{near}\"? "));
                return Err(Refusal::new(format!("{file}: no column is called \"{theirs}\""))
                    .help(format!("{near}the columns are: {}", header.join(", "))));
            };
            let unit = titled(header[at]).1;
            if unit.is_none() && written_unit.is_none() {
                said.push(format!("{theirs} taken in SI"));
            }
            (at, None, unit)
        }
        None => {
            let same = |title: &&str| {
                let (title, _) = titled(title);
                is_called(title) || to_si_factor(&title.to_lowercase()).0 == name
            };
            let all: Vec<usize> =
                header.iter().enumerate().filter(|(_, title)| same(title)).map(|(at, _)| at).collect();
            let at = match all[..] {
                [] => return Ok(None),
                [at] => at,
                [first, second, ..] => {
                    let message = format!(
                        "{file}: columns \"{}\" and \"{}\" may both be {name}",
                        header[first], header[second]
                    );
                    return Err(
                        Refusal::new(message).help(format!("say which: --map {name}={}", header[first]))
                    );
                }
            };
            let (title, unit) = titled(header[at]);
            let title = title.to_lowercase();
            (at, (title != name && !is_called(&title)).then(|| to_si_factor(&title).1), unit)
        }
    };
    let scale = match (written_unit.or(unit_of_header), over) {
        (Some(text), _) => Scale { times: times * factor(name, unit, text)?, over: 1.0 },
        (None, Some((up, down))) => Scale { times: times * up, over: down },
        (None, None) => Scale { times, over: 1.0 },
    };
    Ok(Some(Found { at, scale }))
}

fn by_place(
    file: &str,
    one: &Wanted,
    at: usize,
    width: usize,
    wanted: &[Wanted],
    asked: &Asked,
) -> Result<Found, Refusal> {
    let at = match asked_of(&asked.map, |word| one.is_called(word)) {
        None => at,
        Some(theirs) => theirs.parse::<usize>().ok().and_then(|at| at.checked_sub(1)).ok_or_else(|| {
            Refusal::new(format!("{file} has no header, and no column is called \"{theirs}\""))
                .help(format!("give the number of the column: --map {}=2", one.name))
        })?,
    };
    if at >= width {
        let message =
            format!("{file} has {width} columns and no header; {} is wanted in column {}", one.name, at + 1);
        return Err(Refusal::new(message).help(format!("write the columns {}, or a header", names(wanted))));
    }
    let times = match asked_of(&asked.unit, |word| one.is_called(word)) {
        Some(text) => factor(one.name, one.unit, text)?,
        None => 1.0,
    };
    Ok(Found { at, scale: Scale { times, over: 1.0 } })
}

/// What numbers in a unit are multiplied by.
fn factor(name: &str, si: &str, text: &str) -> Result<f64, Refusal> {
    let refuse = |message: String, help: String| {
        Refusal::new(format!("unit \"{text}\" of {name}: {message}")).help(help)
    };
    let unit = Unit::parse(text).map_err(|no| refuse(no.message, no.help))?;
    match Unit::parse(si) {
        Ok(si_unit) if unit.is_like(&si_unit) => Ok(unit.factor / si_unit.factor),
        _ => Err(refuse(
            format!("it is no unit of what is measured in {si}"),
            format!("give a unit such as {si} with --unit {name}=…"),
        )),
    }
}

fn no_number(place: &str, one: &Wanted, cell: &str) -> Refusal {
    let shown: String = cell.chars().take(40).collect();
    let (cause, cure) = match (cell.is_empty(), cell.contains(',')) {
        (true, _) => ("the cell is empty".to_owned(), "leave out rows that have no value"),
        (_, true) => (
            format!("\"{shown}\" is no number"),
            "decimal commas are read where ; tabs or blanks part the columns: --delimiter semicolon",
        ),
        _ => (format!("\"{shown}\" is no number"), "write numbers as 1.5e-3"),
    };
    Refusal::new(format!("{place}: column {}: {cause}", one.name)).help(cure)
}

/// Order and uniqueness of rows.
struct Checks {
    growing: Option<(usize, &'static str)>,
    last: f64,
    distinct: Vec<usize>,
    seen: HashMap<Vec<u64>, String>,
}

impl Checks {
    fn new(wanted: &[Wanted], keys: Keys) -> Self {
        let at = |name: &str| wanted.iter().position(|one| one.name == name).unwrap_or(0);
        let (growing, distinct) = match keys {
            Keys::Growing(name) => (Some((at(name), name)), Vec::new()),
            Keys::Distinct(names) => (None, names.iter().map(|name| at(name)).collect()),
        };
        Self { growing, last: f64::NEG_INFINITY, distinct, seen: HashMap::new() }
    }

    fn row(&mut self, place: &str, row: &[f64]) -> Result<(), Refusal> {
        if let Some((at, name)) = self.growing {
            if row[at] == self.last {
                return Err(Refusal::new(format!("{place}: column {name}: {} stands there twice", row[at]))
                    .help("write each once; rows of restarts that repeat have to go"));
            }
            if row[at] < self.last {
                return Err(Refusal::new(format!(
                    "{place}: column {name}: {} comes after {}",
                    row[at], self.last
                ))
                .help(format!("sort the rows by {name}")));
            }
            self.last = row[at];
            return Ok(());
        }
        // −0 and 0 are one place.
        let key: Vec<u64> = self.distinct.iter().map(|&at| (row[at] + 0.0).to_bits()).collect();
        match self.seen.insert(key, place.to_owned()) {
            None => Ok(()),
            Some(before) => {
                Err(Refusal::new(format!("{place}: the same place stands in {before}"))
                    .help("write each once"))
            }
        }
    }
}
