//! Results of an earlier run, read back; what is half-written, edited or of another version is refused.

use super::{CaseResults, FORMAT, File, Folder, RESULTS, RUN, Run, sha256};
use crate::input::Refusal;
use crate::manifest::Manifest;
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::collections::HashMap;
use std::fs;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// A folder of results, and where it is.
#[derive(Debug)]
pub struct Source {
    pub place: PathBuf,
    pub folder: Folder,
    /// SHA-256 of `results.json`.
    pub sha256: String,
    /// By study, case and data file: where the case's rows begin, and how many bytes they are.
    rows: HashMap<(String, String, String), (u64, u64)>,
    /// By study and case: their indices.
    cases: HashMap<(String, String), (usize, usize)>,
}

/// An earlier run.
#[derive(Debug)]
pub struct Earlier {
    pub run: Run,
    pub folders: Vec<Source>,
    /// Folders beside those of the run: results of other runs.
    pub stale: Vec<String>,
}

/// The run whose results are in `dir`, every file of which is looked at.
pub fn earlier(dir: &Path) -> Result<Earlier, Refusal> {
    let place = dir.join(RUN);
    let bytes = fs::read(&place).map_err(|error| {
        Refusal::new(format!("{} holds no run: cannot read {}: {error}", dir.display(), place.display()))
            .help("give the folder that a run wrote to with --out; runs of versions before run.json must be run again")
    })?;
    let run: Run = parsed(&place, &bytes)?;
    same_version(&place, &run.manifest)?;
    let mut folders = Vec::new();
    for recorded in &run.folders {
        let source = Source::read(&dir.join(&recorded.name))?;
        let Some(source) = source else {
            let message = format!("{} is missing from {}", recorded.name, dir.display());
            return Err(Refusal::new(message).help("run it again, or take the folder of a whole run"));
        };
        if source.sha256 != recorded.sha256 {
            let message =
                format!("{} is not what this run wrote: {} has other bytes", recorded.name, RESULTS);
            return Err(Refusal::new(message)
                .help("it was edited, or written by another run or one that was killed: run again"));
        }
        if let Some(what) = differs(&run.manifest, &source.folder.manifest) {
            let message = format!("{} was made with another {what} than the run", source.place.display());
            return Err(Refusal::new(message).help("run all of it again"));
        }
        source.intact()?;
        folders.push(source);
    }
    let stale = stale(dir, &run);
    Ok(Earlier { run, folders, stale })
}

/// Names of folders with results that this run did not write.
fn stale(dir: &Path, run: &Run) -> Vec<String> {
    let entries = fs::read_dir(dir).into_iter().flatten().flatten();
    let mut names: Vec<String> = entries
        .filter(|entry| entry.path().join(RESULTS).is_file())
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .filter(|name| !name.starts_with('.') && !run.folders.iter().any(|folder| folder.name == *name))
        .collect();
    names.sort();
    names
}

/// The first circumstance by which results of two runs are not of one piece.
pub fn differs(a: &Manifest, b: &Manifest) -> Option<&'static str> {
    let pairs = [
        ("version", a.version == b.version && a.reference_version == b.reference_version),
        ("commit", a.git_commit == b.git_commit && a.git_modified == b.git_modified),
        ("compiler", a.rustc == b.rustc && a.target == b.target),
        ("instruction set", a.instruction_set == b.instruction_set),
        ("profile", a.profile == b.profile),
    ];
    pairs.into_iter().find(|(_, same)| !same).map(|(what, _)| what)
}

fn same_version(place: &Path, manifest: &Manifest) -> Result<(), Refusal> {
    let own = env!("CARGO_PKG_VERSION");
    if manifest.version == own {
        return Ok(());
    }
    let message = format!("{} was written by version {}, this is {own}", place.display(), manifest.version);
    Err(Refusal::new(message).help("run again with this version, or use the version that wrote it"))
}

/// What a file of ours holds; the version of its format is looked at first.
fn parsed<T: DeserializeOwned>(place: &Path, bytes: &[u8]) -> Result<T, Refusal> {
    let refuse = |error: &serde_json::Error| {
        let what = if error.is_eof() { "is cut off".to_owned() } else { format!("cannot be read: {error}") };
        Refusal::new(format!("{} {what}", place.display()))
            .help("it was edited or half-written: remove the folder, and run again")
    };
    let direct = serde_json::from_slice::<T>(bytes);
    direct.map_err(|error| {
        match serde_json::from_slice::<Value>(bytes).map(|value| value["format"].clone()) {
            Ok(Value::Number(format)) if format.as_u64() != Some(FORMAT) => {
                let message = format!("{} has format {format}, this version reads {FORMAT}", place.display());
                Refusal::new(message).help("run again with this version, or use the version that wrote it")
            }
            _ => refuse(&error),
        }
    })
}

impl Source {
    /// The results in a folder; `None` where there are none.
    pub fn read(place: &Path) -> Result<Option<Self>, Refusal> {
        let file = place.join(RESULTS);
        let bytes = match fs::read(&file) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => {
                return Err(Refusal::new(format!("cannot read {}: {error}", file.display()))
                    .help("make it readable, or remove the folder and run again"));
            }
        };
        let folder: Folder = parsed(&file, &bytes)?;
        let (rows, cases) = (rows(&folder), cases(&folder));
        Ok(Some(Self { place: place.to_owned(), sha256: sha256(&bytes), folder, rows, cases }))
    }

    /// Refuses a folder of which a file is missing or not what was written.
    pub fn intact(&self) -> Result<(), Refusal> {
        for file in self.folder.files() {
            self.file(file).map_err(|error| {
                Refusal::new(format!("{}: {error}", self.place.join(&file.name).display()))
                    .help("the folder was changed after the run: run again")
            })?;
        }
        Ok(())
    }

    /// A file's bytes, if they are what was written.
    pub fn file(&self, file: &File) -> io::Result<Vec<u8>> {
        let bytes = fs::read(self.place.join(&file.name))?;
        if sha256(&bytes) == file.sha256 {
            return Ok(bytes);
        }
        Err(io::Error::new(io::ErrorKind::InvalidData, "the file is not what the run wrote"))
    }

    /// The first line of a data file.
    pub fn columns(&self, name: &str) -> io::Result<String> {
        let table = self.folder.tables.iter().find(|table| table.file.name == name);
        table.map(|table| table.columns.clone()).ok_or_else(|| unknown(name))
    }

    /// A case's rows of a data file.
    pub fn rows(&self, study: &str, case: &str, name: &str) -> io::Result<Vec<u8>> {
        let key = (study.to_owned(), case.to_owned(), name.to_owned());
        let &(begin, count) = self.rows.get(&key).ok_or_else(|| unknown(name))?;
        let mut file = fs::File::open(self.place.join(name))?;
        file.seek(SeekFrom::Start(begin))?;
        let mut bytes = Vec::new();
        file.take(count).read_to_end(&mut bytes)?;
        if bytes.len() as u64 == count { Ok(bytes) } else { Err(unknown(name)) }
    }

    /// A case of a study.
    pub fn case(&self, study: &str, case: &str) -> Option<&CaseResults> {
        let &(study, case) = self.cases.get(&(study.to_owned(), case.to_owned()))?;
        Some(&self.folder.studies[study].cases[case])
    }
}

fn unknown(name: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, format!("{name} lacks rows of the case"))
}

fn cases(folder: &Folder) -> HashMap<(String, String), (usize, usize)> {
    let mut found = HashMap::new();
    for (at, study) in folder.studies.iter().enumerate() {
        let cases = study.cases.iter().enumerate();
        found.extend(cases.map(|(index, case)| ((study.id.clone(), case.id.clone()), (at, index))));
    }
    found
}

fn rows(folder: &Folder) -> HashMap<(String, String, String), (u64, u64)> {
    let mut ends: HashMap<&str, u64> = folder
        .tables
        .iter()
        .map(|table| (table.file.name.as_str(), table.columns.len() as u64 + 1))
        .collect();
    let mut found = HashMap::new();
    for study in &folder.studies {
        for case in &study.cases {
            for rows in &case.rows {
                let end = ends.entry(rows.file.as_str()).or_default();
                found.insert((study.id.clone(), case.id.clone(), rows.file.clone()), (*end, rows.bytes));
                *end += rows.bytes;
            }
        }
    }
    found
}
