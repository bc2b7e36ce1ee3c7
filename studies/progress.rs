//! Progress on the terminal: a bar where somebody watches, silence in pipes, and the end at Ctrl-C.

use crate::run::Watch;
use crate::study::Case;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::atomic::{AtomicBool, Ordering};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Lets Ctrl-C end the run after the case at hand; a second one ends it at once.
pub fn listen() {
    let handler = || {
        if INTERRUPTED.swap(true, Ordering::SeqCst) {
            std::process::exit(130);
        }
    };
    // A second handler is refused by the system; the default then ends the program, which is no worse.
    let _ = ctrlc::set_handler(handler);
}

/// Whether Ctrl-C was pressed.
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
