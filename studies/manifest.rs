//! Under which circumstances a result was made: version, commit, compiler, machine, command line, study files.

use pd_verify::simd::Isa;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::time::SystemTime;

/// `manifest.json`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    pub version: String,
    /// The version of the exact answers.
    pub reference_version: String,
    pub git_commit: Option<String>,
    pub git_modified: Option<bool>,
    pub rustc: String,
    pub target: String,
    /// The instruction set in use.
    pub instruction_set: String,
    pub instruction_set_asked: Option<String>,
    pub cpu: String,
    pub threads: usize,
    /// Processors and threads of a run whose parts ran on several; else empty.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub machines: Vec<String>,
    pub command_line: Vec<String>,
    pub profile: String,
    pub settings: Vec<String>,
    pub start: String,
    pub studies: Vec<StudyHash>,
}

/// A study file and the SHA-256 of its bytes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StudyHash {
    pub id: String,
    pub file: String,
    pub sha256: String,
}

impl StudyHash {
    pub fn new(id: &str, file: &str, text: &str) -> Self {
        Self::of_bytes(id, file, text.as_bytes())
    }

    /// Of any file that a result rests on.
    pub fn of_bytes(id: &str, file: &str, bytes: &[u8]) -> Self {
        let sha256 = Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect();
        Self { id: id.to_owned(), file: file.to_owned(), sha256 }
    }
}

impl Manifest {
    /// The circumstances of this process.
    pub fn of_this_run(
        profile: String,
        settings: Vec<String>,
        isa: Option<String>,
        studies: Vec<StudyHash>,
    ) -> Self {
        let known = |text: &'static str| (!text.is_empty()).then_some(text);
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            reference_version: pd_verify_reference::VERSION.to_owned(),
            git_commit: known(env!("PD_VERIFY_COMMIT")).map(str::to_owned),
            git_modified: known(env!("PD_VERIFY_MODIFIED")).map(|text| text == "true"),
            rustc: env!("PD_VERIFY_RUSTC").to_owned(),
            target: env!("PD_VERIFY_TARGET").to_owned(),
            instruction_set: Isa::chosen().set().name().to_owned(),
            instruction_set_asked: isa,
            cpu: cpu_model(),
            threads: rayon::current_num_threads(),
            machines: Vec::new(),
            command_line: std::env::args().collect(),
            profile,
            settings,
            start: humantime::format_rfc3339_seconds(SystemTime::now()).to_string(),
            studies,
        }
    }

    /// The bytes of `manifest.json`.
    pub fn json(&self) -> String {
        serde_json::to_string_pretty(self).expect("a manifest is plain data") + "\n"
    }

    /// Name and value pairs for a page.
    pub fn pairs(&self) -> Vec<(String, String)> {
        let commit = match (&self.git_commit, self.git_modified) {
            (Some(commit), Some(true)) => format!("{commit}, modified"),
            (Some(commit), _) => commit.clone(),
            (None, _) => "unknown".into(),
        };
        let mut pairs = vec![
            ("version".to_owned(), self.version.clone()),
            ("commit".into(), commit),
            ("compiler".into(), format!("{}, {}", self.rustc, self.target)),
            ("instruction set".into(), self.instruction_set.clone()),
            ("processor".into(), self.cpu.clone()),
            ("threads".into(), self.threads.to_string()),
            ("profile".into(), self.profile.clone()),
            ("start".into(), self.start.clone()),
        ];
        if !self.machines.is_empty() {
            pairs.retain(|(name, _)| name != "processor" && name != "threads");
            pairs.push(("machines".into(), self.machines.join("; ")));
        }
        if !self.settings.is_empty() {
            pairs.push(("changed by --set".into(), self.settings.join(", ")));
        }
        pairs.extend(
            self.studies
                .iter()
                .map(|study| (format!("study {}", study.id), format!("sha256 {}", study.sha256))),
        );
        pairs
    }

    /// The command line as one would type it.
    pub fn command(&self) -> String {
        let quoted = |word: &String| {
            let plain =
                word.chars().all(|c| c.is_ascii_alphanumeric() || "-_./=,:".contains(c)) && !word.is_empty();
            if plain { word.clone() } else { format!("'{}'", word.replace('\'', "'\\''")) }
        };
        let arguments = self.command_line.iter().skip(1).map(quoted);
        std::iter::once("pd-verify".to_owned()).chain(arguments).collect::<Vec<_>>().join(" ")
    }
}

/// The processor, as the system names it.
pub fn cpu_model() -> String {
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = info
        .lines()
        .find_map(|line| line.strip_prefix("model name")?.split_once(':').map(|(_, name)| name.trim()));
    model.map_or_else(|| std::env::consts::ARCH.to_owned(), str::to_owned)
}
