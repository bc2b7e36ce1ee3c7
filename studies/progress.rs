//! Progress on the terminal: a bar where somebody watches, silence in pipes, and the end at Ctrl-C or when asked to end.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag::{register, register_conditional_shutdown};
use std::fmt::Write;
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

/// The bar, as long as the seconds that the work may take.
pub struct Progress {
    bar: ProgressBar,
}

/// Steps of the bar in a second.
const FINENESS: f64 = 1e3;

impl Progress {
    /// A bar of equal steps.
    pub fn new(steps: usize, wanted: bool) -> Self {
        Self::of(steps as f64, wanted)
    }

    /// A bar of steps that count as much as [`Self::advance`] says.
    pub fn of(length: f64, wanted: bool) -> Self {
        let shown = wanted && std::io::stderr().is_terminal();
        let target = if shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let style = ProgressStyle::with_template("{bar:24} {percent:>3} % {msg} {elapsed} (left {left})");
        let bar = ProgressBar::with_draw_target(Some((length * FINENESS) as u64), target);
        bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()).with_key("left", left));
        Self { bar }
    }

    /// What is done now.
    pub fn at(&self, what: &str) {
        self.bar.set_message(what.to_owned());
    }

    /// A step is done.
    pub fn step(&self) {
        self.advance(1.0);
    }

    /// So much is done.
    pub fn advance(&self, by: f64) {
        self.bar.inc((by * FINENESS) as u64);
    }

    /// A line that stays.
    pub fn note(&self, text: &str) {
        self.bar.println(text);
    }

    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// The rest takes as long for its length as what is done took for its own.
fn left(state: &ProgressState, text: &mut dyn Write) {
    let (done, elapsed) = (f64::from(state.fraction()), state.elapsed().as_secs_f64());
    let _ = match done > 0.01 {
        true => write!(text, "{:.0} s", elapsed * (1.0 - done) / done),
        false => write!(text, "unknown"),
    };
}
