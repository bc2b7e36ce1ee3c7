//! A file of another code as bytes: text in columns, or a NumPy array. Capped before it is read.

use super::npy::Npy;
use super::text::Text;
use crate::input::Refusal;
use clap::ValueEnum;
use std::borrow::Cow;
use std::fs;
use std::io::Read;
use std::path::Path;

/// A larger file is not read.
pub const MAX_BYTES: usize = 64 << 20;
/// A table of more columns is no table.
pub const MAX_COLUMNS: usize = 10_000;

/// What parts the columns of a text.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Delimiter {
    Comma,
    Semicolon,
    Tab,
    /// One blank or several
    Blank,
}

/// A table whose cells are not yet numbers.
pub enum Source {
    Text(Text),
    Npy(Npy),
}

impl Source {
    /// Opens and reads a file whole.
    pub fn open(path: &Path, delimiter: Option<Delimiter>) -> Result<(Self, Vec<u8>), Refusal> {
        let name = path.display().to_string();
        let refuse = |error: std::io::Error| {
            Refusal::new(format!("cannot read {name}: {error}"))
                .help("give the path of a CSV or NPY file to --data")
        };
        let mut bytes = Vec::new();
        let opened = fs::File::open(path).map_err(refuse)?;
        opened.take(MAX_BYTES as u64 + 1).read_to_end(&mut bytes).map_err(refuse)?;
        Ok((Self::of(&name, &bytes, delimiter)?, bytes))
    }

    /// Reads bytes; `name` is what messages call the file.
    pub fn of(name: &str, bytes: &[u8], delimiter: Option<Delimiter>) -> Result<Self, Refusal> {
        if bytes.len() > MAX_BYTES {
            return Err(Refusal::new(format!("{name} is larger than {} MiB", MAX_BYTES >> 20))
                .help("report fewer times or places: some hundreds are enough"));
        }
        if bytes.starts_with(b"\x93NUMPY") {
            return Npy::read(name, bytes).map(Self::Npy);
        }
        Text::read(name, bytes, delimiter).map(Self::Text)
    }

    /// Names of the columns, where there are any.
    pub fn header(&self) -> Option<Vec<&str>> {
        match self {
            Self::Text(text) => text.header(),
            Self::Npy(npy) => npy.header(),
        }
    }

    /// How many columns there are.
    pub fn width(&self) -> usize {
        match self {
            Self::Text(text) => text.width(),
            Self::Npy(npy) => npy.width(),
        }
    }

    /// Gives `take` each row: where it is, and its cells of the columns `at`.
    pub fn rows(
        &self,
        at: &[usize],
        mut take: impl FnMut(String, Vec<Cow<'_, str>>, Option<Vec<f64>>) -> Result<(), Refusal>,
    ) -> Result<(), Refusal> {
        match self {
            Self::Text(text) => text.rows(at, |line, cells| take(line, cells, None)),
            Self::Npy(npy) => npy.rows(at, |row, numbers| take(row, Vec::new(), Some(numbers))),
        }
    }
}
