//! A refusal: what is wrong with the input, where, and what to write instead.

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};
use std::fmt;
use std::ops::Range;

/// Bad input. Ends the program with code 2 before anything is computed or written.
#[derive(Debug)]
pub struct Refusal(Box<Details>);

#[derive(Debug)]
struct Details {
    message: String,
    help: Option<String>,
    place: Option<Range<usize>>,
    source: Option<NamedSource<String>>,
}

impl Refusal {
    /// A refusal without a place in a file.
    pub fn new(message: impl Into<String>) -> Self {
        Self(Box::new(Details { message: message.into(), help: None, place: None, source: None }))
    }

    /// Adds what to do about it.
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.0.help = Some(help.into());
        self
    }

    /// Marks the place in the named text.
    pub fn at(mut self, name: &str, text: &str, place: Option<Range<usize>>) -> Self {
        match place {
            Some(place) if longest_line(text, &place) <= LONGEST_LINE => {
                self.0.source = Some(NamedSource::new(name, text.to_owned()));
                self.0.place = Some(place);
            }
            // A place without its text: nobody reads a line of a thousand words.
            Some(place) => {
                let line = line_of(text, &place);
                self.0.message = format!("{name}:{line}: {}", self.0.message);
            }
            None if self.0.message.contains(name) => {}
            None => self.0.message = format!("{name}: {}", self.0.message),
        }
        self
    }
}

/// Lines longer than this are not shown.
const LONGEST_LINE: usize = 400;

/// The line of a place, counted from 1.
fn line_of(text: &str, place: &Range<usize>) -> usize {
    let before = &text.as_bytes()[..place.start.min(text.len())];
    1 + before.iter().filter(|byte| **byte == b'\n').count()
}

/// The longest of the lines that a message would show: the one of the place and its neighbours.
fn longest_line(text: &str, place: &Range<usize>) -> usize {
    text.lines().skip(line_of(text, place).saturating_sub(2)).take(3).map(str::len).max().unwrap_or(0)
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.message)
    }
}

impl std::error::Error for Refusal {}

impl Diagnostic for Refusal {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.0.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.0.source.as_ref().map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let place = self.0.place.clone()?;
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(Some("here".to_owned()), place))))
    }
}

/// The candidate nearest to a misspelt word, if any is near.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word = word.to_lowercase();
    candidates
        .into_iter()
        .map(|candidate| (strsim::jaro_winkler(&word, &candidate.to_lowercase()), candidate))
        .filter(|(likeness, _)| *likeness > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_word_is_found_and_far_ones_are_not() {
        assert_eq!(nearest("gausian", ["constant", "gaussian"]), Some("gaussian"));
        assert_eq!(nearest("Gaussian", ["constant", "gaussian"]), Some("gaussian"));
        assert_eq!(nearest("xyzzy", ["constant", "gaussian"]), None);
    }
}
