//! What a run may take from an earlier one: cases whose inputs are the same to the last bit.

use super::read::Source;
use super::{CaseResults, RESULTS};
use crate::input::Refusal;
use pd_verify::verdict::Verdict;
use std::collections::HashMap;
use std::path::Path;

/// Which of the earlier cases are taken over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Take {
    Nothing,
    Finished,
    /// Those that failed, broke off or could not be judged are run again.
    Sound,
}

/// Results of earlier runs by the name of their folder.
#[derive(Debug)]
pub struct Resume {
    take: Take,
    folders: HashMap<String, Source>,
}

impl Resume {
    /// Reads what is there; changes nothing.
    pub fn open(root: &Path, folders: &[String], take: Take) -> Result<Self, Refusal> {
        let mut found = HashMap::new();
        for folder in folders.iter().filter(|_| take != Take::Nothing) {
            if let Some(source) = Source::read(&root.join(folder))? {
                found.insert(folder.clone(), source);
            }
        }
        Ok(Self { take, folders: found })
    }

    /// A case of an earlier run with the same inputs.
    pub fn case(
        &self,
        folder: &str,
        study: &str,
        case: &str,
        inputs: &str,
    ) -> Option<(&Source, &CaseResults)> {
        let source = self.folders.get(folder)?;
        let found = source.case(study, case).filter(|found| found.inputs == inputs)?;
        let any = |wanted: &[Verdict]| found.judged.iter().any(|one| wanted.contains(&one.verdict));
        // A profile left it out: nothing was found.
        let left_out = found.judged.iter().all(|one| one.verdict == Verdict::Skipped);
        let unsound = any(&[Verdict::Fail, Verdict::Xpass, Verdict::Error, Verdict::Inconclusive]);
        let again = left_out || (unsound && self.take == Take::Sound);
        (!again).then_some((source, found))
    }

    /// Whether anything is looked for.
    pub fn is_wanted(&self) -> bool {
        self.take != Take::Nothing
    }

    /// Why nothing can be taken over.
    pub fn nothing(&self) -> Option<String> {
        let none = self.is_wanted() && self.folders.is_empty();
        none.then(|| format!("no earlier {RESULTS} is there: everything is run"))
    }
}
