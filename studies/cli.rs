//! The command line: commands and options as users type them.

use crate::foreign::Delimiter;
use crate::question::Profile;
use crate::shard::Shard;
use clap::{Args, Parser, Subcommand, ValueEnum};
use pd_verify::simd::{self, InstructionSet};
use std::path::PathBuf;

/// Verification of peridynamics: exact answers, stated tolerances, verdicts that can fail.
#[derive(Debug, Parser)]
#[command(name = "pd-verify", version, arg_required_else_help = true)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Wave dispersion in one and two dimensions: the shipped studies, or the files given
    Dispersion {
        /// Study files; none means the shipped studies
        files: Vec<PathBuf>,
        #[command(flatten)]
        options: RunOptions,
    },
    /// Bars marched in time against exact answers: the shipped studies, or the files given
    Bar {
        /// Study files; none means the shipped studies
        files: Vec<PathBuf>,
        #[command(flatten)]
        options: RunOptions,
    },
    /// How errors fall with the horizon and the spacing: the shipped studies, or the files given
    Convergence {
        /// Study files; none means the shipped studies
        files: Vec<PathBuf>,
        #[command(flatten)]
        options: RunOptions,
    },
    /// Dynamic stress intensity factors against exact histories: the shipped studies, or the files given
    Dsif {
        /// Study files; none means the shipped studies
        files: Vec<PathBuf>,
        #[command(flatten)]
        options: RunOptions,
    },
    /// Cases that break codes, time steps at and beyond the limit among them: the shipped studies, or the files given
    Stability {
        /// Study files; none means the shipped studies
        files: Vec<PathBuf>,
        #[command(flatten)]
        options: RunOptions,
    },
    /// Every shipped study in one report; or, with --from, the report of results that are there
    Report {
        /// Folder of an earlier run: its report is written again from its results, nothing is computed
        #[arg(
            long,
            value_name = "DIR",
            conflicts_with_all = ["out", "profile", "set", "threads", "isa", "no_progress", "shard", "resume", "rerun_failed"]
        )]
        from: Option<PathBuf>,
        #[command(flatten)]
        options: RunOptions,
    },
    /// Run study files of any kind
    Run {
        /// Study files
        #[arg(required = true)]
        files: Vec<PathBuf>,
        #[command(flatten)]
        options: RunOptions,
    },
    /// The shipped studies: what they claim, their source, what they cost
    List {
        /// Machine-readable
        #[arg(long)]
        json: bool,
    },
    /// What a study, case or claim says, against what, and why its bounds are what they are
    Explain {
        /// Id of a study, of a case (study/case) or of a claim (study/case/claim), or a study file
        id: String,
        /// The publications it rests on, as BibTeX
        #[arg(long)]
        bibtex: bool,
        /// The study file itself, to copy; of a case: a study of this case alone
        #[arg(long, conflicts_with = "bibtex")]
        toml: bool,
        /// Of a case: write the problem for the user of any solver, templates and references into a folder
        #[arg(long, value_name = "DIR", conflicts_with_all = ["bibtex", "toml"])]
        export: Option<PathBuf>,
    },
    /// Judge results that another code produced, by the reference and the bounds of a case
    Check(CheckOptions),
    /// Results that are known to be wrong must be rejected, each with its cause, and right ones accepted
    Selftest,
    /// What a study will do and what it costs; runs nothing
    Plan {
        /// Id of a shipped study or of one of its cases (study/case), or a study file
        study: String,
        /// Machine-readable
        #[arg(long)]
        json: bool,
        /// How much would be run
        #[arg(long, value_enum, default_value_t)]
        profile: Profile,
        /// Change one value of the study: dotted.path=value
        #[arg(long, value_name = "PATH=VALUE")]
        set: Vec<String>,
        /// Folder of results: what `bench` left there says how long the study will take
        #[arg(long, value_name = "DIR", default_value = "reports")]
        out: PathBuf,
    },
    /// How fast bodies are marched, beside what the machine can do: the whole suite, or one plate
    Bench(BenchOptions),
    /// What accuracy costs: the shipped studies, or the files given; with --advise the cheapest settings for an error, with --error or --budget a scene of your own
    Cost(CostOptions),
    /// Put together the parts of a run that were made with --shard
    Merge(MergeOptions),
    /// Keep what a run found, to hold later runs against
    Baseline {
        #[command(subcommand)]
        command: BaselineCommand,
    },
    /// Hold a run against a baseline: what drifted, what is judged otherwise, what is gone
    Compare {
        /// Name of the baseline, or a path that ends in .json
        name: String,
        /// Folder of the run
        #[arg(long, value_name = "DIR", default_value = "reports")]
        from: PathBuf,
        /// Claims that took more than so many times as long have drifted too; the baseline must have been saved with --seconds
        #[arg(long, value_name = "FACTOR", allow_negative_numbers = true)]
        slower: Option<f64>,
    },
    /// The JSON schema of study files, or of the results that runs leave
    Schema {
        /// Of which files
        #[arg(value_enum, default_value_t)]
        of: SchemaOf,
    },
    /// A completion script for your shell
    Completions {
        #[arg(value_enum)]
        shell: clap_complete::Shell,
    },
}

/// Options of every command that computes.
#[derive(Debug, Clone, Args)]
pub struct RunOptions {
    /// Folder of the results
    #[arg(long, value_name = "DIR", default_value = "reports")]
    pub out: PathBuf,
    /// How much is run; never changes a bound
    #[arg(long, value_enum, default_value_t)]
    pub profile: Profile,
    /// Change one value of the study: dotted.path=value
    #[arg(long, value_name = "PATH=VALUE")]
    pub set: Vec<String>,
    /// Threads to use; results do not depend on it
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Instruction set of the solver; the best here if not given (waves have one code for all)
    #[arg(long, value_enum)]
    pub isa: Option<Isa>,
    /// Inconclusive counts as failing
    #[arg(long)]
    pub strict: bool,
    /// Print nothing but what fails
    #[arg(long)]
    pub quiet: bool,
    /// No progress on the terminal
    #[arg(long)]
    pub no_progress: bool,
    /// Run part k of n; cases are dealt by their names, and `merge` puts the parts together
    #[arg(long, value_name = "K/N")]
    pub shard: Option<Shard>,
    /// Take over from the folder of the results what an earlier run found, where study, program and instruction set are unchanged
    #[arg(long)]
    pub resume: bool,
    /// The same, but run again what failed, broke off or could not be judged
    #[arg(long)]
    pub rerun_failed: bool,
}

/// Options of `merge`.
#[derive(Debug, Clone, Args)]
pub struct MergeOptions {
    /// Folders of all parts
    #[arg(required = true, value_name = "DIR")]
    pub parts: Vec<PathBuf>,
    /// Folder of the whole
    #[arg(long, value_name = "DIR", default_value = "reports")]
    pub out: PathBuf,
    /// Inconclusive counts as failing
    #[arg(long)]
    pub strict: bool,
    /// Print nothing but what fails
    #[arg(long)]
    pub quiet: bool,
}

#[derive(Debug, Clone, Subcommand)]
pub enum BaselineCommand {
    /// Verdicts and quantities of the run, in a small file with a line for each claim
    Save {
        /// Its name below baselines/ in the folder of the run, or a path that ends in .json
        name: String,
        /// Folder of the run
        #[arg(long, value_name = "DIR", default_value = "reports")]
        from: PathBuf,
        /// With the seconds that each claim took, which differ from run to run
        #[arg(long)]
        seconds: bool,
    },
}

/// Files that have a schema.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum SchemaOf {
    /// Study files
    #[default]
    Study,
    /// results.json, in every folder of results
    Results,
    /// run.json, beside these folders
    Run,
}

/// Options of `check`.
#[derive(Debug, Clone, Args)]
pub struct CheckOptions {
    /// Id of a shipped case (study/case), or a study file of one case
    pub case: String,
    /// CSV (any usual delimiter, with or without header) or NPY
    #[arg(long, value_name = "FILE")]
    pub data: PathBuf,
    /// Name of a column in the file, or its number: --map t=time
    #[arg(long, value_name = "COLUMN=THEIRS")]
    pub map: Vec<String>,
    /// Unit of a column, if it is not SI: --unit 'k=MPa*sqrt(mm)'
    #[arg(long, value_name = "COLUMN=UNIT")]
    pub unit: Vec<String>,
    /// What parts the columns; found out if not given
    #[arg(long, value_enum)]
    pub delimiter: Option<Delimiter>,
    /// Which of the kinds of data that the case judges, where the columns do not tell
    #[arg(long = "as", value_name = "KIND")]
    pub form: Option<String>,
    #[command(flatten)]
    pub run: RunOptions,
}

/// Options of `bench`.
#[derive(Debug, Clone, Args)]
pub struct BenchOptions {
    /// One plate of N × N nodes in place of the suite; 1024 if only others of its options are given
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=16_384))]
    pub nodes: Option<u32>,
    /// Its horizon over its spacing; 3 if not given
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    pub m: Option<f64>,
    /// Steps to march, once; if not given as many as take a tenth of a second, fifteen times
    #[arg(long, value_name = "S", value_parser = clap::value_parser!(u64).range(1..=1_000_000_000_000))]
    pub steps: Option<u64>,
    /// What serves its bonds; a stencil if not given
    #[arg(long, value_enum)]
    pub operator: Option<BondOperator>,
    /// Threads to use; all if not given
    #[arg(long, value_name = "T", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Instruction set; the best here if not given
    #[arg(long, value_enum)]
    pub isa: Option<Isa>,
    /// Machine-readable
    #[arg(long)]
    pub json: bool,
    /// Folder of the results; the suite writes bench/ there, one plate is only printed
    #[arg(long, value_name = "DIR", default_value = "reports")]
    pub out: PathBuf,
    /// No progress on the terminal
    #[arg(long)]
    pub no_progress: bool,
}

/// Options of `cost`.
#[derive(Debug, Clone, Args)]
pub struct CostOptions {
    /// Study files; none means the shipped studies
    pub files: Vec<PathBuf>,
    /// Search kernels, m, volume rules and calibrations of plates; the answer goes to advice/
    #[arg(long, requires_all = ["error", "wavelength"], conflicts_with_all = ["files", "profile", "set", "budget", "case", "shard", "resume", "rerun_failed"])]
    pub advise: bool,
    /// Largest phase error, worst over directions and both branches, 0.01 is one per cent; with a study of kind "scene" in place of
    /// --advise: the coarsest spacing at which what its probes see is as accurate, root mean square over time over the largest size
    #[arg(long, value_name = "E", conflicts_with_all = ["profile", "set", "shard", "resume", "rerun_failed"], allow_negative_numbers = true)]
    pub error: Option<f64>,
    /// With a study of kind "scene": the finest spacing that so many seconds afford
    #[arg(
        long,
        value_name = "SECONDS",
        conflicts_with_all = ["error", "profile", "set", "shard", "resume", "rerun_failed"],
        allow_negative_numbers = true
    )]
    pub budget: Option<f64>,
    /// Which case of the scene study, if it has several
    #[arg(long, value_name = "ID")]
    pub case: Option<String>,
    /// Length of the shortest waves that matter, in m
    #[arg(
        long,
        value_name = "L",
        requires = "advise",
        conflicts_with_all = ["files", "budget"],
        allow_negative_numbers = true
    )]
    pub wavelength: Option<f64>,
    /// Settings of at least this m only
    #[arg(
        long,
        value_name = "M",
        requires = "advise",
        conflicts_with = "horizon",
        allow_negative_numbers = true
    )]
    pub min_m: Option<f64>,
    /// Settings of this horizon only, in m
    #[arg(long, value_name = "H", requires = "advise", allow_negative_numbers = true)]
    pub horizon: Option<f64>,
    /// Dilatational speed of the plate in m/s; that of steel in plane stress if not given
    #[arg(long, value_name = "C", requires = "advise", allow_negative_numbers = true)]
    pub speed: Option<f64>,
    /// Machine-readable, with --advise, --error or --budget
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub run: RunOptions,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum BondOperator {
    /// One family for all nodes
    Stencil,
    /// Every bond stored
    Bonds,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Isa {
    Baseline,
    Avx2,
    Avx512,
}

impl Isa {
    /// The word on the command line.
    pub fn word(self) -> &'static str {
        match self {
            Self::Baseline => "baseline",
            Self::Avx2 => "avx2",
            Self::Avx512 => "avx512",
        }
    }

    /// The same to the solver.
    pub fn set(self) -> InstructionSet {
        match self {
            Self::Baseline => InstructionSet::Baseline,
            Self::Avx2 => InstructionSet::Avx2,
            Self::Avx512 => InstructionSet::Avx512,
        }
    }

    /// The best that this processor has.
    pub fn best() -> Self {
        [Self::Avx512, Self::Avx2].into_iter().find(|isa| isa.is_here()).unwrap_or(Self::Baseline)
    }

    /// Whether this processor has it.
    pub fn is_here(self) -> bool {
        self.set().is_here()
    }

    /// Makes it the one of all models of this process.
    pub fn pin(self) {
        if let Some(isa) = simd::Isa::of(self.set()) {
            isa.pin();
        }
    }
}
