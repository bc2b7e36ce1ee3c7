//! The threads that a command computes on.

use crate::bench::measure::Pools;
use crate::input::Refusal;

/// The threads that were asked for, all if none were.
pub fn pool(count: Option<u16>) -> Result<rayon::ThreadPool, Refusal> {
    let count = count.map_or(0, usize::from);
    rayon::ThreadPoolBuilder::new().num_threads(count).build().map_err(|error| {
        Refusal::new(format!("cannot start threads: {error}")).help("take fewer with --threads")
    })
}

/// The same, and one alone, for what is measured.
pub fn pools(count: Option<u16>) -> Result<Pools, Refusal> {
    Ok(Pools { all: pool(count)?, one: pool(Some(1))? })
}
