//! The folder of results: written beside under another name, then put in place whole.

use crate::attachment::Attachment;
use crate::input::Refusal;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The file by which a folder is known to be ours, and may be replaced.
pub const MARK: &str = "manifest.json";

/// Files in the root that speak of a run, and how ours can be told from somebody else's.
const ROOT_FILES: [(&str, &str); 5] = [
    ("index.html", "pd-verify"),
    ("summary.md", "# Verification of peridynamics"),
    ("junit.xml", "<testsuites name=\"Verification of peridynamics"),
    ("verdicts.csv", "claim,study,case,quantity,"),
    ("run.json", "\"program\": \"pd-verify\""),
];

/// `--out`.
#[derive(Debug, Clone)]
pub struct Output {
    root: PathBuf,
}

impl Output {
    /// Makes sure that the folder exists and can be written before anything is computed, and that no folder of
    /// somebody else's stands where results will go.
    pub fn open(root: &Path, folders: &[String]) -> Result<Self, Refusal> {
        let refuse = |error: &io::Error| {
            Refusal::new(format!("cannot write to {}: {error}", root.display()))
                .help("choose another folder with --out DIR")
        };
        for folder in folders {
            let path = root.join(folder);
            // A link that leads nowhere is in the way too.
            if path.symlink_metadata().is_ok() && !is_ours(&path) && !is_empty(&path) {
                let message = format!(
                    "{} exists and is not a folder of results: it has no {MARK} of a run",
                    path.display()
                );
                return Err(
                    Refusal::new(message).help("move it away, or choose another folder with --out DIR")
                );
            }
        }
        for (file, sign) in ROOT_FILES {
            let path = root.join(file);
            if path.exists()
                && !fs::read_to_string(&path).is_ok_and(|text| text.is_empty() || text.contains(sign))
            {
                let message = format!("{} exists and is not of a run of this program", path.display());
                return Err(
                    Refusal::new(message).help("move it away, or choose another folder with --out DIR")
                );
            }
        }
        fs::create_dir_all(root).map_err(|error| refuse(&error))?;
        let probe = root.join(format!(".probe-{}", std::process::id()));
        fs::write(&probe, b"").and_then(|()| fs::remove_file(&probe)).map_err(|error| refuse(&error))?;
        let output = Self { root: root.to_owned() };
        folders.iter().for_each(|folder| output.tidy(folder));
        output.tidy_partial();
        ROOT_FILES.iter().for_each(|(file, _)| output.tidy(file));
        Ok(output)
    }

    /// Clears away what runs that were killed left half-written under this name, and puts back what one had just moved aside.
    fn tidy(&self, name: &str) {
        let Ok(entries) = fs::read_dir(&self.root) else { return };
        for entry in entries.flatten() {
            let file = entry.file_name().to_string_lossy().into_owned();
            let left = |kind: &str| file.strip_prefix(&format!(".{name}.{kind}-"))?.parse::<u32>().ok();
            let (old, partial) = (left("old"), left("partial"));
            if !old.or(partial).is_some_and(has_ended) {
                continue;
            }
            let place = self.root.join(name);
            let kept = old.is_some() && !place.exists() && fs::rename(entry.path(), place).is_ok();
            if !kept {
                clear(&entry.path());
            }
        }
    }

    /// Clears away folders that runs which were killed had begun, whatever their name.
    fn tidy_partial(&self) {
        let Ok(entries) = fs::read_dir(&self.root) else { return };
        for entry in entries.flatten() {
            let name = entry.file_name().to_string_lossy().into_owned();
            let process = name.strip_prefix('.').and_then(|name| name.rsplit_once(".partial-"));
            let process = process.and_then(|(_, process)| process.parse().ok());
            if process.is_some_and(has_ended) && is_ours(&entry.path()) {
                clear(&entry.path());
            }
        }
    }

    /// Replaces a folder of results, all files at once.
    pub fn replace_folder(&self, name: &str, files: &[Attachment]) -> io::Result<PathBuf> {
        let partial = self.partial(name)?;
        files.iter().try_for_each(|file| fs::write(partial.path(&file.name), file.bytes()))?;
        partial.commit()
    }

    /// Begins a folder of results beside the place where it will stand.
    pub fn partial(&self, name: &str) -> io::Result<Partial> {
        let beside = |kind: &str| self.root.join(format!(".{name}.{kind}-{}", std::process::id()));
        let partial = Partial { place: self.root.join(name), at: beside("partial"), old: beside("old") };
        let _ = fs::remove_dir_all(&partial.at);
        fs::create_dir_all(&partial.at)?;
        Ok(partial)
    }

    /// Replaces a file in the root.
    pub fn replace_file(&self, name: &str, text: &str) -> io::Result<PathBuf> {
        let place = self.root.join(name);
        let partial = self.root.join(format!(".{name}.partial-{}", std::process::id()));
        // The folder may have been removed since.
        let written = fs::create_dir_all(&self.root)
            .and_then(|()| fs::write(&partial, text))
            .and_then(|()| fs::rename(&partial, &place));
        if written.is_err() {
            let _ = fs::remove_file(&partial);
        }
        written.map(|()| place)
    }
}

/// A folder of results on its way; it is gone unless it is put in place.
#[derive(Debug)]
pub struct Partial {
    place: PathBuf,
    at: PathBuf,
    old: PathBuf,
}

impl Partial {
    /// Where a file of it is written.
    pub fn path(&self, name: &str) -> PathBuf {
        self.at.join(name)
    }

    /// Takes the place of what was there.
    pub fn commit(self) -> io::Result<PathBuf> {
        if self.place.exists() {
            fs::rename(&self.place, &self.old)?;
        }
        if let Err(error) = fs::rename(&self.at, &self.place) {
            let _ = fs::rename(&self.old, &self.place);
            return Err(error);
        }
        clear(&self.old);
        Ok(self.place.clone())
    }
}

impl Drop for Partial {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.at);
    }
}

/// Removes a folder, or a file, or a link and not what it leads to.
fn clear(path: &Path) {
    if fs::remove_dir_all(path).is_err() {
        let _ = fs::remove_file(path);
    }
}

/// Whether no process of this number runs; where that cannot be told, none has ended.
fn has_ended(process: u32) -> bool {
    Path::new("/proc/self").exists() && !Path::new("/proc").join(process.to_string()).exists()
}

/// Whether a folder holds the manifest of a run; other programs have files of that name too.
fn is_ours(path: &Path) -> bool {
    let manifest = fs::read_to_string(path.join(MARK)).ok();
    let manifest = manifest.and_then(|text| serde_json::from_str::<serde_json::Value>(&text).ok());
    manifest.is_some_and(|manifest| manifest["studies"].is_array() && manifest["rustc"].is_string())
}

fn is_empty(path: &Path) -> bool {
    fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_none())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_is_replaced_whole_and_a_foreign_one_is_left_alone() {
        let root = tempfile::tempdir().unwrap();
        let output = Output::open(root.path(), &["a".into()]).unwrap();
        let manifest = r#"{"studies": [], "rustc": ""}"#;
        let (mark, other) = (Attachment::text(MARK, manifest), Attachment::text("x.csv", "1"));
        output.replace_folder("a", &[mark.clone(), other]).unwrap();
        output.replace_folder("a", &[mark]).unwrap();
        assert!(Output::open(root.path(), &["a".into()]).is_ok());
        assert!(!root.path().join("a/x.csv").exists());
        assert_eq!(fs::read_dir(root.path()).unwrap().count(), 1);
        fs::create_dir(root.path().join("b")).unwrap();
        fs::write(root.path().join("b/thesis.tex"), "x").unwrap();
        assert!(Output::open(root.path(), &["b".into()]).is_err());
        assert!(root.path().join("b/thesis.tex").exists());
    }

    #[cfg(unix)]
    #[test]
    fn links_are_replaced_and_what_they_lead_to_is_left_alone() {
        let (root, other) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        fs::write(other.path().join(MARK), r#"{"studies": [], "rustc": ""}"#).unwrap();
        std::os::unix::fs::symlink(other.path(), root.path().join("a")).unwrap();
        std::os::unix::fs::symlink("nowhere", root.path().join("b")).unwrap();
        let output = Output::open(root.path(), &["a".into()]).unwrap();
        output.replace_folder("a", &[Attachment::text("x.csv", "1")]).unwrap();
        assert!(root.path().join("a/x.csv").exists() && other.path().join(MARK).exists());
        assert!(!other.path().join("x.csv").exists());
        let names = fs::read_dir(root.path()).unwrap().map(|entry| entry.unwrap().file_name());
        assert_eq!(names.filter(|name| name.to_string_lossy().starts_with('.')).count(), 0);
        assert!(Output::open(root.path(), &["b".into()]).is_err());
    }

    /// No process has a number as large as 2²²; this one is running.
    #[cfg(target_os = "linux")]
    #[test]
    fn what_killed_runs_left_is_cleared_away_or_put_back() {
        let root = tempfile::tempdir().unwrap();
        let at = |name: &str| root.path().join(name);
        let own = format!(".a.partial-{}", std::process::id());
        for folder in [".a.partial-4194999", ".a.old-4194999", ".other.partial-4194999", &own] {
            fs::create_dir(at(folder)).unwrap();
            fs::write(at(folder).join(MARK), folder).unwrap();
        }
        fs::write(at(".index.html.partial-4194999"), "<!").unwrap();
        Output::open(root.path(), &["a".into()]).unwrap();
        assert_eq!(fs::read_to_string(at("a").join(MARK)).unwrap(), ".a.old-4194999");
        let mut left: Vec<String> = fs::read_dir(root.path())
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        left.sort();
        let mut kept = [".other.partial-4194999".to_owned(), own, "a".to_owned()];
        kept.sort();
        assert_eq!(left, kept);
        // What is in place is newer than what was moved aside.
        fs::create_dir(at(".a.old-4194999")).unwrap();
        Output::open(root.path(), &[]).unwrap();
        assert!(at(".a.old-4194999").exists());
    }
}
