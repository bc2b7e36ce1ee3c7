//! What each kernel costs over m, in its cheapest way.

use super::advice::{Advice, KERNELS, MS};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::Lattice;
use pd_verify::report::plot::{Axis, Figure, Lines, Series};

/// Bond updates over m, by kernel: the cheapest volume rule, calibrated or not.
pub fn figure(advice: &Advice) -> Figure {
    let cheapest = |kernel: Kernel, m: f64| {
        let is = |lattice: &Lattice| lattice.kernel == kernel && lattice.m == m;
        let cheapest = advice.settings.iter().find(|one| is(&one.lattice) || one.alike.iter().any(is));
        cheapest.map(|setting| (m, setting.bond_updates))
    };
    let series = KERNELS.into_iter().filter_map(|kernel| {
        let points: Vec<(f64, f64)> = MS.into_iter().filter_map(|m| cheapest(kernel, m)).collect();
        (!points.is_empty()).then(|| Series::both(kernel.to_string(), points))
    });
    let lines = Lines::new(Axis::linear("m"), Axis::log("bond updates per m² and second"), series.collect());
    let caption = format!(
        "Cheapest volume rule, calibrated or not, for waves of {} m with a phase error of at most {}; where there is no \
         point no lattice of this m is as accurate as asked.",
        advice.asked.wavelength, advice.asked.error
    );
    Figure::new("advice_by_m", "What a wave costs", caption, lines)
}
