//! Costs of nodes where no `bench` has left any: a few bodies, measured in seconds.

use super::beside::beside;
use super::cases::short_suite;
use super::costs;
use super::kept;
use super::limits::Limits;
use super::measure::{Failure, Measured, Pace, Pools, measure};
use super::rates::Rates;
use crate::cli::{Isa, RunOptions};
use crate::input::Refusal;
use crate::progress::interrupted;
use pd_verify::plan::time::Costs;

/// Rounds and seconds of a body in each.
const PACE: Pace = Pace { rounds: 3, seconds: 0.02, steps: None };

/// What `bench` left below `--out`, if it speaks of these threads and this instruction set; else measured now.
pub fn costs(options: &RunOptions, pools: &Pools) -> Result<Costs, Refusal> {
    let isa = options.isa.unwrap_or_else(Isa::best);
    let threads = pools.all.current_num_threads();
    let same = |kept: &kept::Kept| kept.isa == isa.word() && kept.threads == threads;
    if let Some(kept) = kept::read(&options.out)?.filter(same) {
        return Ok(kept.costs);
    }
    let mut cases: Vec<Rates> = Vec::new();
    for group in short_suite() {
        let measured: Vec<Measured> = match measure(&group, pools, PACE, &interrupted) {
            Ok(measured) => measured,
            // Nothing is predicted; the run itself ends as it must.
            Err(Failure::Interrupted) => return Ok(Costs::default()),
            Err(Failure::Wrong(wrong)) => return Err(Refusal::new(wrong.message).help(wrong.help)),
            Err(Failure::Diverged(case)) => {
                return Err(Refusal::new(format!("\"{case}\" grew without bound")).help("try another --isa"));
            }
        };
        let limits = Limits::unknown(threads);
        cases.extend(measured.iter().map(|one| Rates::of(group.name, isa, one, &measured[0], &limits)));
    }
    beside(costs::costs(&cases, threads), pools).map_err(|wrong| Refusal::new(wrong.message).help(wrong.help))
}
