//! Kinds of study: what the cases of each may ask, and the tables that its cases share.

use crate::input::{Refusal, nearest};
use crate::question::Question;
use crate::written::{Word, Written};
use crate::{bar, convergence, cost, dispersion, dsif, scene, stability};
use schemars::JsonSchema;
use serde::Deserialize;

/// Kinds of study that this program runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// How waves travel, evaluated from the lattice's sums.
    Dispersion,
    /// Bars marched in time, held against exact answers.
    Bar,
    /// How errors fall with the horizon, the spacing, or both.
    Convergence,
    /// Dynamic stress intensity factors of cracks in plates.
    Dsif,
    /// Cases that break codes: time steps at and beyond the limit.
    Stability,
    /// Errors against work and time.
    Cost,
    /// A scene of one's own, marched in time.
    Scene,
}

impl Kind {
    pub const ALL: [Self; 7] = [
        Self::Dispersion,
        Self::Bar,
        Self::Convergence,
        Self::Dsif,
        Self::Stability,
        Self::Cost,
        Self::Scene,
    ];

    /// The word in study files; also the command and the folder of the shipped studies.
    pub fn word(self) -> &'static str {
        match self {
            Self::Dispersion => "dispersion",
            Self::Bar => "bar",
            Self::Convergence => "convergence",
            Self::Dsif => "dsif",
            Self::Stability => "stability",
            Self::Cost => "cost",
            Self::Scene => "scene",
        }
    }

    /// What a case of this kind may ask.
    pub fn words(self) -> &'static [Word] {
        match self {
            Self::Dispersion => dispersion::WORDS,
            Self::Bar => bar::WORDS,
            Self::Convergence => convergence::WORDS,
            Self::Dsif => dsif::WORDS,
            Self::Stability => stability::WORDS,
            Self::Cost => cost::WORDS,
            Self::Scene => scene::WORDS,
        }
    }

    /// Files that cases share; no figure may take their names.
    pub fn tables(self) -> &'static [&'static str] {
        match self {
            Self::Dispersion => dispersion::TABLES,
            Self::Bar => bar::TABLES,
            Self::Convergence => convergence::TABLES,
            Self::Dsif => dsif::TABLES,
            Self::Stability => stability::TABLES,
            Self::Cost => cost::TABLES,
            Self::Scene => scene::TABLES,
        }
    }

    /// Ends of the names of figures beside the one that is called like its case.
    pub fn suffixes(self) -> &'static [&'static str] {
        match self {
            Self::Dispersion => dispersion::SUFFIXES,
            Self::Bar => bar::SUFFIXES,
            Self::Convergence => convergence::SUFFIXES,
            Self::Dsif => dsif::SUFFIXES,
            Self::Stability => stability::SUFFIXES,
            Self::Cost => cost::SUFFIXES,
            Self::Scene => &[],
        }
    }

    /// Whether no figure of a case that asks this is called like the case alone.
    pub fn suffixes_all_figures(self, asks: &str) -> bool {
        self.words().iter().any(|word| word.name == asks && word.suffixes_all_figures)
    }

    /// Turns a case into the question that it asks, or says what is wrong with it.
    pub fn read_case(self, asks: &str, written: &Written<'_>) -> Result<Box<dyn Question>, Refusal> {
        match self.words().iter().find(|word| word.name == asks) {
            Some(word) => word.read(written),
            None => {
                let (message, help) = self.unknown(asks);
                Err(written.document.refuse(&format!("{}.asks", written.path), message).help(help))
            }
        }
    }

    /// Message and help for a word that no case of this kind asks.
    fn unknown(self, asks: &str) -> (String, String) {
        let kind = self.word();
        let offered: Vec<&str> =
            self.words().iter().filter(|word| word.offered).map(|word| word.name).collect();
        let listed = format!("a {kind} case asks one of: {}", offered.join(", "));
        let other = Self::ALL.into_iter().find(|other| other.words().iter().any(|word| word.name == asks));
        if let Some(other) = other {
            let message = format!("no {kind} case asks \"{asks}\"");
            return (
                message,
                format!("\"{asks}\" is asked in a study of kind = \"{}\"; {listed}", other.word()),
            );
        }
        let help = match nearest(asks, offered) {
            Some(word) => format!("did you mean \"{word}\"? {listed}"),
            None => listed,
        };
        (format!("no case asks \"{asks}\""), help)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_word_is_the_one_that_files_write() {
        for kind in Kind::ALL {
            assert_eq!(serde_json::from_value::<Kind>(kind.word().into()).unwrap(), kind);
        }
    }

    #[test]
    fn no_kind_has_a_word_twice_and_all_share_the_verdicts() {
        for kind in Kind::ALL {
            let mut names: Vec<&str> = kind.words().iter().map(|word| word.name).collect();
            names.sort_unstable();
            assert!(names.windows(2).all(|pair| pair[0] != pair[1]), "{names:?}");
            assert!(kind.tables().contains(&"verdicts"), "{kind:?}");
        }
    }

    #[test]
    fn a_word_of_another_kind_is_sent_there() {
        let (message, help) = Kind::Scene.unknown("curves");
        assert_eq!(message, "no scene case asks \"curves\"");
        assert!(
            help.starts_with("\"curves\" is asked in a study of kind = \"dispersion\"; a scene case"),
            "{help}"
        );
    }

    #[test]
    fn what_is_not_offered_is_not_in_messages() {
        let (message, help) = Kind::Dispersion.unknown("misprint");
        assert_eq!(message, "no case asks \"misprint\"");
        assert!(help.ends_with("polar, heat_map"), "{help}");
    }
}
