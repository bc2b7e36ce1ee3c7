//! Text in columns: commas, semicolons, tabs or blanks; with a header or without; comments, BOM, CRLF, decimal commas.

use super::source::{Delimiter, MAX_COLUMNS};
use crate::input::Refusal;
use std::borrow::Cow;

/// A table as text.
pub struct Text {
    name: String,
    text: String,
    delimiter: Delimiter,
    header: Option<Vec<String>>,
    width: usize,
    /// Index of the first line of numbers.
    first: usize,
}

impl Text {
    /// Finds delimiter and header.
    pub fn read(name: &str, bytes: &[u8], delimiter: Option<Delimiter>) -> Result<Self, Refusal> {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let text = String::from_utf8(bytes.to_vec()).map_err(|error| {
            let line =
                1 + bytes[..error.utf8_error().valid_up_to()].iter().filter(|byte| **byte == b'\n').count();
            Refusal::new(format!("{name}:{line}: this is not text in UTF-8"))
                .help("write CSV as plain text, or a NumPy array with numpy.save")
        })?;
        let Head { delimiter, header, width, first } = Head::of(name, &text, delimiter)?;
        Ok(Self { name: name.to_owned(), header, width, delimiter, first, text })
    }

    pub fn header(&self) -> Option<Vec<&str>> {
        self.header.as_ref().map(|names| names.iter().map(String::as_str).collect())
    }

    pub fn width(&self) -> usize {
        self.width
    }

    /// Each row: its line and its cells of the columns `at`.
    pub fn rows(
        &self,
        at: &[usize],
        mut take: impl FnMut(String, Vec<Cow<'_, str>>) -> Result<(), Refusal>,
    ) -> Result<(), Refusal> {
        for (index, line) in lines_of(&self.text).enumerate().skip(self.first) {
            if line.trim().is_empty() || line.trim_start().starts_with('#') {
                continue;
            }
            let cells = split(line, self.delimiter);
            let place = format!("{}:{}", self.name, index + 1);
            if cells.len() != self.width {
                return Err(Refusal::new(format!(
                    "{place}: this row has {} columns, the first has {}",
                    cells.len(),
                    self.width
                ))
                .help("write as many in every row; --delimiter says what parts them"));
            }
            take(place, at.iter().map(|&column| cells[column].clone()).collect())?;
        }
        Ok(())
    }
}

/// What the first lines say.
struct Head {
    delimiter: Delimiter,
    header: Option<Vec<String>>,
    width: usize,
    first: usize,
}

impl Head {
    /// Finds the first row, and the names of its columns.
    fn of(name: &str, text: &str, delimiter: Option<Delimiter>) -> Result<Self, Refusal> {
        let mut comment = None;
        let mut lines = lines_of(text).enumerate();
        let (at, first) = loop {
            match lines.next() {
                None => {
                    return Err(Refusal::new(format!("{name} holds no data"))
                        .help("write a header, and a row for every time, place or level"));
                }
                Some((_, line)) if line.trim().is_empty() => {}
                Some((_, line)) if line.trim_start().starts_with('#') => {
                    comment = Some(line.trim_start().trim_start_matches('#').trim());
                }
                Some(found) => break found,
            }
        };
        let delimiter = delimiter.unwrap_or_else(|| guessed(first));
        let cells = split(first, delimiter);
        let width = cells.len();
        if width > MAX_COLUMNS {
            return Err(Refusal::new(format!("{name}:{}: {width} columns are no table", at + 1))
                .help(format!("write one row a line; at most {MAX_COLUMNS} columns are read")));
        }
        let titled = cells.iter().any(|cell| number(cell).is_none() && !cell.is_empty());
        let names = |cells: Vec<Cow<'_, str>>| cells.into_iter().map(Cow::into_owned).collect::<Vec<_>>();
        let (header, first) = if titled {
            (Some(names(cells)), at + 1)
        } else {
            // numpy.savetxt writes its header as a comment.
            let said = comment.map(|line| split(line, delimiter));
            let said =
                said.filter(|said| said.len() == width && said.iter().all(|cell| number(cell).is_none()));
            (said.map(names), at)
        };
        Ok(Self { delimiter, header, width, first })
    }
}

/// Lines that end with LF, CRLF or CR.
fn lines_of(text: &str) -> impl Iterator<Item = &str> {
    text.split('\n').flat_map(|line| line.strip_suffix('\r').unwrap_or(line).split('\r'))
}

/// What parts the columns of a line.
fn guessed(line: &str) -> Delimiter {
    let has = |letter: char| line.contains(letter);
    match (has(';'), has('\t'), has(',')) {
        (true, ..) => Delimiter::Semicolon,
        (_, true, _) => Delimiter::Tab,
        (.., true) => Delimiter::Comma,
        _ => Delimiter::Blank,
    }
}

/// The cells of a line without the blanks and quotes around them.
fn split(line: &str, delimiter: Delimiter) -> Vec<Cow<'_, str>> {
    let by = match delimiter {
        Delimiter::Blank => return line.split_whitespace().map(unquoted).collect(),
        Delimiter::Comma => ',',
        Delimiter::Semicolon => ';',
        Delimiter::Tab => '\t',
    };
    let mut quoted = false;
    let parts = line.split(move |letter: char| {
        quoted ^= letter == '"';
        letter == by && !quoted
    });
    let decimal_commas = by != ',';
    let cell = |part| match unquoted(part) {
        cell if decimal_commas && cell.matches(',').count() == 1 && !cell.contains('.') => {
            let point = cell.replace(',', ".");
            if number(&point).is_some() { Cow::Owned(point) } else { cell }
        }
        cell => cell,
    };
    parts.map(cell).collect()
}

fn unquoted(cell: &str) -> Cow<'_, str> {
    let cell = cell.trim();
    let inner = cell.strip_prefix('"').and_then(|cell| cell.strip_suffix('"'));
    Cow::Borrowed(inner.unwrap_or(cell).trim())
}

/// A number as codes write it: 1e-3, 1.D-03, .5, NaN.
pub fn number(cell: &str) -> Option<f64> {
    if let Ok(number) = cell.parse() {
        return Some(number);
    }
    let fortran =
        cell.len() < 64 && cell.contains(['d', 'D']) && !cell.contains(['e', 'E', 'n', 'N', 'i', 'I']);
    if fortran { cell.replace(['d', 'D'], "e").parse().ok() } else { None }
}
