//! Progress on the terminal: a bar where somebody watches, silence in pipes, and the end at Ctrl-C or when asked to end.

use crate::run::Watch;
use crate::study::Case;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag::{register, register_conditional_shutdown};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock};

static INTERRUPTED: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);

/// Lets Ctrl-C, and the signal by which schedulers end a job, end the run after the case at hand; a second one ends it at once.
pub fn listen() {
    for signal in [SIGINT, SIGTERM] {
        // What is refused by the system leaves the default, which ends the program at once.
        let _ = register_conditional_shutdown(signal, 130, INTERRUPTED.clone());
        let _ = register(signal, INTERRUPTED.clone());
    }
}

/// Whether the run is to end.
pub fn interrupted() -> bool {
    INTERRUPTED.load(Ordering::SeqCst)
}

/// The bar.
pub struct Progress {
    bar: ProgressBar,
}

impl Progress {
    pub fn new(cases: usize, wanted: bool) -> Self {
        let shown = wanted && std::io::stderr().is_terminal();
        let target = if shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let style = ProgressStyle::with_template("{bar:24} {pos}/{len} {msg} {elapsed} (left {eta})");
        let bar = ProgressBar::with_draw_target(Some(cases as u64), target);
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
        Self { bar }
    }

    /// What is done now, where it is no case of a study.
    pub fn at(&self, what: &str) {
        self.bar.set_message(what.to_owned());
    }

    /// It is done.
    pub fn step(&self) {
        self.bar.inc(1);
    }

    /// A line that stays.
    pub fn note(&self, text: &str) {
        self.bar.println(text);
    }

    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Watch for Progress {
    fn stop(&self) -> bool {
        interrupted()
    }

    fn begin(&self, case: &Case) {
        self.bar.set_message(format!("{}/{}", case.place.study, case.place.case));
    }

    fn end(&self, _: &Case) {
        self.bar.inc(1);
    }
}

/// A watch that shows nothing and never stops, for tests.
#[cfg(test)]
pub struct Silent;

#[cfg(test)]
impl Watch for Silent {
    fn stop(&self) -> bool {
        false
    }

    fn begin(&self, _: &Case) {}

    fn end(&self, _: &Case) {}
}
