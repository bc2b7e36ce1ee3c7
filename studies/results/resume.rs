//! What a run may take from an earlier one: cases whose inputs are the same to the last bit.

use super::read::Source;
use super::{CaseResults, RESULTS, RUN, Run};
use crate::input::Refusal;
use pd_verify::verdict::Verdict;
use std::collections::HashMap;
use std::fs;
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
    /// Folders that are not what their run wrote.
    changed: Vec<String>,
}

impl Resume {
    /// Reads what is there; changes nothing.
    pub fn open(root: &Path, folders: &[String], take: Take) -> Result<Self, Refusal> {
        let (mut found, mut changed) = (HashMap::new(), Vec::new());
        let run = fs::read(root.join(RUN)).ok().and_then(|bytes| serde_json::from_slice::<Run>(&bytes).ok());
        for folder in folders.iter().filter(|_| take != Take::Nothing) {
            let Some(source) = Source::read(&root.join(folder))? else { continue };
            let recorded = run.iter().flat_map(|run| &run.folders).find(|file| file.name == *folder);
            if recorded.is_some_and(|file| file.sha256 != source.sha256) {
                changed.push(folder.clone());
            } else {
                found.insert(folder.clone(), source);
            }
        }
        Ok(Self { take, folders: found, changed })
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

    /// Why something, or all, cannot be taken over.
    pub fn lacks(&self) -> Option<String> {
        if !self.changed.is_empty() {
            let names = self.changed.join(", ");
            return Some(format!("nothing is taken from {names}: {RESULTS} is not what {RUN} says"));
        }
        let none = self.is_wanted() && self.folders.is_empty();
        none.then(|| format!("no earlier {RESULTS} is there: everything is run"))
    }
}
