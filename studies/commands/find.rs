//! Studies by name: a shipped one by its id, one of its cases, or the path of a file.

use super::judge::read_text;
use crate::input::{Document, Refusal, Setting, nearest};
use crate::shipped::{SHIPPED, refuse_unused};
use crate::study::Study;
use std::path::Path;

/// The shipped study of this id as text, with its file name.
pub fn shipped_text(id: &str) -> Option<(&'static str, &'static str)> {
    SHIPPED.iter().copied().find(|(file, text)| id_of(file, text) == id)
}

/// As it is written: to plan every shipped study for its name would take seconds.
fn id_of(file: &str, text: &str) -> String {
    let document = Document::parse(file, text).ok();
    document.and_then(|document| Some(document.get("id")?.as_str()?.to_owned())).unwrap_or_default()
}

/// A shipped study by its id, one of its cases (study/case), or a file.
pub fn find(name: &str, settings: &[Setting]) -> Result<Study, Refusal> {
    let (id, case) = name.split_once('/').map_or((name, None), |(id, case)| (id, Some(case)));
    let (mut study, used) = match shipped_text(id) {
        Some((file, text)) => Study::read(file, text, settings)?,
        None => {
            let ids: Vec<String> = SHIPPED.iter().map(|(file, text)| id_of(file, text)).collect();
            let near = nearest(name, ids.iter().map(String::as_str));
            let near = near.map_or(String::new(), |near| format!("did you mean {near}? "));
            let cure = format!("{near}give the path of a study file, or an id from `pd-verify list`");
            return find_file(name, settings, &cure);
        }
    };
    if let Some(case) = case {
        let ids: Vec<String> = study.cases.iter().map(|one| one.place.case.clone()).collect();
        study.cases.retain(|one| one.place.case == case);
        if study.cases.is_empty() {
            let help = match nearest(case, ids.iter().map(String::as_str)) {
                Some(near) => format!("did you mean {id}/{near}?"),
                None => format!("its cases are: {}", ids.join(", ")),
            };
            return Err(Refusal::new(format!("the study {id} has no case {case}")).help(help));
        }
    }
    refuse_unused(settings, &used)?;
    Ok(study)
}

fn find_file(name: &str, settings: &[Setting], cure: &str) -> Result<Study, Refusal> {
    let (study, used) = Study::read(name, &read_text(Path::new(name), cure)?, settings)?;
    refuse_unused(settings, &used)?;
    Ok(study)
}

/// The study of a file.
pub fn file(name: &str) -> Result<Study, Refusal> {
    find_file(name, &[], "give the path of a study file, or an id from `pd-verify list`")
}

/// The text of a study: whole, or its head and one case, which together are a study again.
pub fn text_of(study: &Study, case: Option<usize>) -> String {
    let whole = study.document.text();
    let part = case.and_then(|case| head_and(whole, case, study.cases.len()));
    part.filter(|part| Study::read("part", part, &[]).is_ok()).unwrap_or_else(|| whole.to_owned())
}

/// What stands before the first case, and the case, with the remarks above it.
fn head_and(text: &str, case: usize, cases: usize) -> Option<String> {
    let lines: Vec<&str> = text.lines().collect();
    let begins = |&at: &usize| lines[at].trim_start().starts_with("[[case]]");
    let with_remarks =
        |at: usize| (0..at).rev().take_while(|&above| lines[above].starts_with('#')).last().unwrap_or(at);
    let mut starts: Vec<usize> = (0..lines.len()).filter(begins).map(with_remarks).collect();
    if starts.len() != cases {
        return None;
    }
    starts.push(lines.len());
    let part = [&lines[..starts[0]], &lines[starts[case]..starts[case + 1]]].concat();
    Some(part.join("\n").trim_end().to_owned() + "\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_case_of_every_shipped_study_can_be_copied_alone() {
        for (file, text) in SHIPPED {
            let study = Study::read(file, text, &[]).unwrap().0;
            assert_eq!(text_of(&study, None), *text);
            for (index, case) in study.cases.iter().enumerate() {
                let part = Study::read("part", &text_of(&study, Some(index)), &[]).unwrap().0;
                assert_eq!(part.cases.len(), 1, "{}", case.place.case);
                assert_eq!(part.cases[0].place, case.place);
                assert_eq!(part.cases[0].claims(), case.claims());
            }
        }
    }

    #[test]
    fn remarks_stay_with_their_case() {
        let text =
            "format = 1\n\n# first\n[[case]]\na = 1\n\n# second\n# of two\n[[case]]\na = 2\n[case.t]\n";
        assert_eq!(
            head_and(text, 1, 2).unwrap(),
            "format = 1\n\n# second\n# of two\n[[case]]\na = 2\n[case.t]\n"
        );
        assert_eq!(head_and(text, 0, 2).unwrap(), "format = 1\n\n# first\n[[case]]\na = 1\n");
        assert_eq!(head_and(text, 0, 3), None);
    }
}
