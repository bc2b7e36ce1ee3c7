//! Arrays of NumPy: two dimensions of f4 or f8, either byte order, C or Fortran order; or a structured array of such fields.

use super::source::MAX_COLUMNS;
use crate::input::Refusal;

/// An array as rows of numbers.
pub struct Npy {
    name: String,
    header: Option<Vec<String>>,
    rows: usize,
    /// By column: where its first number is, how far the next, how it is written.
    columns: Vec<Column>,
    bytes: Vec<u8>,
}

struct Column {
    first: usize,
    stride: usize,
    kind: Kind,
}

#[derive(Clone, Copy)]
struct Kind {
    size: usize,
    little: bool,
}

impl Kind {
    fn of(text: &str) -> Option<Self> {
        let (order, rest) = text.split_at_checked(1)?;
        let size = match rest {
            "f4" => 4,
            "f8" => 8,
            _ => return None,
        };
        match order {
            "<" | "=" => Some(Self { size, little: true }),
            ">" => Some(Self { size, little: false }),
            _ => None,
        }
    }

    fn read(self, bytes: &[u8]) -> Option<f64> {
        Some(match (self.size, self.little) {
            (4, true) => f64::from(f32::from_le_bytes(bytes.try_into().ok()?)),
            (4, false) => f64::from(f32::from_be_bytes(bytes.try_into().ok()?)),
            (_, true) => f64::from_le_bytes(bytes.try_into().ok()?),
            (_, false) => f64::from_be_bytes(bytes.try_into().ok()?),
        })
    }
}

impl Npy {
    /// Reads the head and checks that all numbers it announces are there.
    pub fn read(name: &str, bytes: &[u8]) -> Result<Self, Refusal> {
        let refuse = |what: &str| {
            Refusal::new(format!("{name}: {what}"))
                .help("write a two-dimensional array of floats, a column for each quantity: numpy.save(file, numpy.column_stack([t, k]))")
        };
        let (head, start) =
            head(bytes).ok_or_else(|| refuse("the head of this NPY file is cut off or broken"))?;
        let fortran = match value(head, "fortran_order") {
            Some(text) if text.starts_with("True") => true,
            Some(text) if text.starts_with("False") => false,
            _ => return Err(refuse("the head of this NPY file does not say its order")),
        };
        let shape = shape(head).ok_or_else(|| refuse("the head of this NPY file has no shape"))?;
        let body = &bytes[start..];
        let descr = value(head, "descr").ok_or_else(|| refuse("the head of this NPY file has no type"))?;
        let fields =
            fields(descr).ok_or_else(|| refuse("numbers of this type are not read, only f4 and f8"))?;
        let (rows, columns, width) = match (&fields[..], &shape[..]) {
            ([(None, kind)], &[rows, width]) if (1..=MAX_COLUMNS).contains(&width) => {
                let column = |at: usize| match fortran {
                    true => Some(Column {
                        first: at.checked_mul(rows)?.checked_mul(kind.size)?,
                        stride: kind.size,
                        kind: *kind,
                    }),
                    false => Some(Column { first: at * kind.size, stride: width * kind.size, kind: *kind }),
                };
                let columns: Option<Vec<Column>> = (0..width).map(column).collect();
                (rows, columns, width.checked_mul(kind.size))
            }
            ([(Some(_), _), ..], &[rows]) => {
                let stride: usize = fields.iter().map(|(_, kind)| kind.size).sum();
                let mut first = 0;
                let columns = fields.iter().map(|(_, kind)| {
                    let column = Column { first, stride, kind: *kind };
                    first += kind.size;
                    column
                });
                (rows, Some(columns.collect()), Some(stride))
            }
            _ => return Err(refuse(&format!("an array of shape {shape:?} is no table"))),
        };
        let needed = width.and_then(|width| width.checked_mul(rows));
        match (columns, needed) {
            (Some(columns), Some(needed)) if needed == body.len() => {
                let header: Option<Vec<String>> = fields.into_iter().map(|(name, _)| name).collect();
                Ok(Self { name: name.to_owned(), header, rows, columns, bytes: body.to_vec() })
            }
            _ => Err(refuse(&format!(
                "its head announces other numbers than the {} bytes that follow",
                body.len()
            ))),
        }
    }

    pub fn header(&self) -> Option<Vec<&str>> {
        self.header.as_ref().map(|names| names.iter().map(String::as_str).collect())
    }

    pub fn width(&self) -> usize {
        self.columns.len()
    }

    /// Each row: its number and its values of the columns `at`.
    pub fn rows(
        &self,
        at: &[usize],
        mut take: impl FnMut(String, Vec<f64>) -> Result<(), Refusal>,
    ) -> Result<(), Refusal> {
        for row in 0..self.rows {
            let of = |&column: &usize| {
                let Column { first, stride, kind } = &self.columns[column];
                let from = first + row * stride;
                self.bytes.get(from..from + kind.size).and_then(|bytes| kind.read(bytes)).unwrap_or(f64::NAN)
            };
            take(format!("{}: row {}", self.name, row + 1), at.iter().map(of).collect())?;
        }
        Ok(())
    }
}

/// The text of the head, and where the numbers begin.
fn head(bytes: &[u8]) -> Option<(&str, usize)> {
    let (length, from): (usize, usize) = match bytes.get(6)? {
        1 => (usize::from(u16::from_le_bytes(bytes.get(8..10)?.try_into().ok()?)), 10),
        2 | 3 => (usize::try_from(u32::from_le_bytes(bytes.get(8..12)?.try_into().ok()?)).ok()?, 12),
        _ => return None,
    };
    let start = from.checked_add(length)?;
    Some((std::str::from_utf8(bytes.get(from..start)?).ok()?, start))
}

/// What stands behind a key of the head.
fn value<'a>(head: &'a str, key: &str) -> Option<&'a str> {
    let (_, rest) = head.split_once(&format!("'{key}'"))?;
    Some(rest.trim_start().strip_prefix(':')?.trim_start())
}

fn shape(head: &str) -> Option<Vec<usize>> {
    let (inner, _) = value(head, "shape")?.strip_prefix('(')?.split_once(')')?;
    inner.split(',').map(str::trim).filter(|part| !part.is_empty()).map(|part| part.parse().ok()).collect()
}

/// One type without a name, or fields with names.
fn fields(descr: &str) -> Option<Vec<(Option<String>, Kind)>> {
    let Some(list) = descr.strip_prefix('[') else {
        let (kind, _) = descr.strip_prefix('\'')?.split_once('\'')?;
        return Some(vec![(None, Kind::of(kind)?)]);
    };
    let (list, _) = list.split_once(']')?;
    let words: Vec<&str> = list.split('\'').skip(1).step_by(2).collect();
    if words.is_empty() || !words.len().is_multiple_of(2) || words.len() > 2 * MAX_COLUMNS {
        return None;
    }
    words.chunks_exact(2).map(|pair| Some((Some(pair[0].to_owned()), Kind::of(pair[1])?))).collect()
}
