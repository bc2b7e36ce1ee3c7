//! How long steps take: what each kind of node costs on a machine, measured, and what a scene adds up to.
//!
//! A step takes a fixed time, and a time for each node, end of a bond or loaded place by its kind. What a node with all
//! its bonds costs is a function of the pairs of its family, measured on a body of one size, times a function of the number
//! of nodes, measured with one family: a small body stays in a cache, a large one does not. Beside its steps a march
//! begins, stops to be looked at, and asks for forces at some looks. Motions of driven nodes are not counted.

use super::Plan;
use super::work::Work;
use serde::{Deserialize, Serialize};

/// Costs on one machine, by one instruction set and number of threads.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Costs {
    pub bar: BodyCosts,
    pub plate: BodyCosts,
}

/// Costs in one dimension, in s.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct BodyCosts {
    /// Of a step on hardly any nodes.
    pub step_s: f64,
    /// Of a node with all its bonds: pairs of its family, and s; by growing pairs, all on a body of one size.
    pub whole_by_pairs: Vec<(f64, f64)>,
    /// What to multiply this by: nodes of the body, and a factor; by growing nodes. 1 at the size above.
    pub by_nodes: Vec<(f64, f64)>,
    /// Of a pair of such a node, by the law of finite rotations.
    pub finite_pair_s: f64,
    /// Of an end of a bond at a node from which some are missing.
    pub masked_end_s: f64,
    /// Of an end of a listed bond.
    pub listed_end_s: f64,
    /// Of a node, for damping; like those below on a body of the size above, elsewhere times the same factor.
    pub damped_node_s: f64,
    /// Of a component of a node, for a load.
    pub loaded_place_s: f64,
    /// Of a node, for booking its energies.
    pub booked_node_s: f64,
    /// Of a beginning and of a look for growth, beside the forces of a step.
    pub begin: BySize,
    pub growth: BySize,
    /// Of a stop, and of a snapshot with what is kept for it.
    pub stop: BySize,
    pub snapshot: BySize,
    /// Of a step of a body whose first rows follow its last, beside that of one where they do not.
    pub repeat: BySize,
    /// Of a node whose force a patch asks for, and of a number that a probe keeps.
    pub patch_node_s: f64,
    pub value_s: f64,
}

/// What happens now and then: nodes of the body, and s; by growing nodes.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct BySize(pub Vec<(f64, f64)>);

impl BySize {
    /// Beyond the largest body in proportion to its nodes.
    fn on(&self, nodes: f64) -> f64 {
        match self.0.last() {
            Some(&(most, seconds)) if nodes > most => seconds * nodes / most,
            _ => between(&self.0, |x| x, nodes).unwrap_or(0.0),
        }
    }
}

impl Costs {
    /// Seconds of a march from its first field to its last look; `None` where nothing was measured.
    pub fn of_march(&self, plan: &Plan) -> Option<f64> {
        let step = self.of_step(&plan.work)?;
        let body = if plan.work.dimension == 1 { &self.bar } else { &self.plate };
        let (nodes, looks) = (plan.nodes as f64, &plan.looks);
        let forces = (plan.steps + 1 + looks.growth) as f64 * step;
        let beside = body.begin.on(nodes)
            + looks.growth as f64 * body.growth.on(nodes)
            + looks.stops as f64 * body.stop.on(nodes)
            + looks.snapshots as f64 * body.snapshot.on(nodes);
        let probes = looks.patch_nodes as f64 * body.patch_node_s + looks.values as f64 * body.value_s;
        Some(forces + beside + probes)
    }

    /// Seconds of a step; `None` where nothing was measured.
    pub fn of_step(&self, work: &Work) -> Option<f64> {
        if work.dimension == 1 { self.bar.of_step(work) } else { self.plate.of_step(work) }
    }
}

impl BodyCosts {
    fn of_step(&self, work: &Work) -> Option<f64> {
        let (kinds, pairs) = (work.kinds, work.pairs as f64);
        let size = between(&self.by_nodes, f64::ln, kinds.nodes() as f64)?;
        let whole =
            if work.finite_rotations { pairs * self.finite_pair_s } else { size * self.whole(pairs)? };
        // Bonds that may break are kept as masks or as lists; a bit more is asked of each.
        let breaking = if kinds.listed_ends > 0 { self.listed_end_s } else { self.masked_end_s };
        let booked = if work.booked { size * self.booked_node_s } else { 0.0 };
        let terms = [
            (1, self.step_s),
            (kinds.whole_nodes, whole),
            (kinds.masked_ends, self.masked_end_s),
            (kinds.listed_ends, self.listed_end_s),
            (kinds.breaking_ends, breaking),
            (work.damped_nodes, size * self.damped_node_s),
            (work.loaded_places, size * self.loaded_place_s),
            (kinds.nodes(), booked),
            (u64::from(work.repeats), self.repeat.on(kinds.nodes() as f64)),
        ];
        let seconds: f64 =
            terms.iter().filter(|(count, _)| *count > 0).map(|&(count, cost)| count as f64 * cost).sum();
        (seconds.is_finite() && seconds > 0.0).then_some(seconds)
    }

    /// Of a node with all its bonds at the size of reference: beyond the largest family in proportion to its pairs.
    fn whole(&self, pairs: f64) -> Option<f64> {
        let &(most, seconds) = self.whole_by_pairs.last()?;
        if pairs > most { Some(seconds * pairs / most) } else { between(&self.whole_by_pairs, |x| x, pairs) }
    }
}

/// Between the points by straight lines over `scale` of their places; beyond them the value of the nearest.
fn between(points: &[(f64, f64)], scale: impl Fn(f64) -> f64, at: f64) -> Option<f64> {
    let after = points.partition_point(|(place, _)| *place <= at);
    let (before, next) = (after.checked_sub(1).map(|n| points[n]), points.get(after).copied());
    match (before, next) {
        (Some((x0, y0)), Some((x1, y1))) => {
            let share = (scale(at) - scale(x0)) / (scale(x1) - scale(x0));
            Some(y0 + (y1 - y0) * share)
        }
        (one, other) => one.or(other).map(|(_, value)| value),
    }
}

#[cfg(test)]
mod tests {
    use super::super::Looks;
    use super::super::work::Kinds;
    use super::*;
    use crate::scene::Scene;

    fn costs() -> Costs {
        let plate = BodyCosts {
            step_s: 100.0,
            whole_by_pairs: vec![(10.0, 2.0), (20.0, 3.0)],
            by_nodes: vec![(1e2, 0.5), (1e4, 1.0), (1e6, 2.0)],
            finite_pair_s: 0.25,
            masked_end_s: 0.125,
            listed_end_s: 7.0,
            damped_node_s: 0.5,
            loaded_place_s: 0.75,
            booked_node_s: 5.0,
            begin: BySize(vec![(1e2, 3.0), (1e3, 12.0)]),
            growth: BySize(vec![(1e4, 2505.0)]),
            stop: BySize(vec![(1e3, 9.0), (1e5, 207.0)]),
            snapshot: BySize(vec![(1e5, 230.0)]),
            repeat: BySize(vec![(1e2, 2.0), (1e4, 8.0)]),
            patch_node_s: 11.0,
            value_s: 13.0,
        };
        Costs { bar: BodyCosts::default(), plate }
    }

    fn work(whole_nodes: u64, pairs: u64) -> Work {
        let kinds = Kinds { whole_nodes, ..Kinds::default() };
        Work { dimension: 2, pairs, kinds, ..Work::default() }
    }

    #[test]
    fn whole_nodes_by_hand() {
        let seconds = |nodes, pairs| costs().of_step(&work(nodes, pairs)).unwrap();
        assert_eq!(seconds(10_000, 10), 100.0 + 1e4 * 2.0);
        assert_eq!(seconds(10_000, 15), 100.0 + 1e4 * 2.5);
        // Beyond the largest family by pairs, below the smallest as that.
        assert_eq!(seconds(10_000, 40), 100.0 + 1e4 * 6.0);
        assert_eq!(seconds(10_000, 5), 100.0 + 1e4 * 2.0);
        // Half way between 10² and 10⁴ in the logarithm, and beyond both ends.
        assert!((seconds(1_000, 10) - (100.0 + 1e3 * 0.75 * 2.0)).abs() < 1e-9);
        assert_eq!(seconds(10, 10), 100.0 + 10.0 * 0.5 * 2.0);
        assert_eq!(seconds(100_000_000, 10), 100.0 + 1e8 * 2.0 * 2.0);
    }

    #[test]
    fn other_kinds_add_up_by_hand() {
        let kinds = Kinds {
            whole_nodes: 9_990,
            masked_nodes: 4,
            masked_ends: 40,
            listed_nodes: 6,
            listed_ends: 60,
            ..Kinds::default()
        };
        let plain = Work { kinds, ..work(0, 10) };
        let of = |work: Work| costs().of_step(&work).unwrap();
        let bonds = 100.0 + 9_990.0 * 2.0 + 40.0 * 0.125 + 60.0 * 7.0;
        assert_eq!(of(plain), bonds);
        assert_eq!(of(Work { damped_nodes: 10, loaded_places: 8, ..plain }), bonds + 5.0 + 6.0);
        assert_eq!(of(Work { repeats: true, ..plain }), bonds + 8.0);
        assert_eq!(of(Work { booked: true, ..plain }), bonds + 10_000.0 * 5.0);
        // 10⁶ nodes cost twice as much each.
        let large = Work { damped_nodes: 1_000_000, loaded_places: 4, ..work(1_000_000, 10) };
        assert_eq!(of(large), 100.0 + 1e6 * 2.0 * (2.0 + 0.5) + 4.0 * 2.0 * 0.75);
        let finite = Work { finite_rotations: true, ..work(10_000, 10) };
        assert_eq!(of(finite), 100.0 + 1e4 * 10.0 * 0.25);
        let breaking = Kinds { breaking_nodes: 1, breaking_ends: 8, whole_nodes: 9_999, ..Kinds::default() };
        assert_eq!(of(Work { kinds: breaking, ..work(0, 10) }), 100.0 + 9_999.0 * 2.0 + 1.0);
    }

    /// 200 of a step of 10⁴ nodes for each of 64 steps, the first field and 6 looks for growth; what is beside by hand.
    #[test]
    fn a_march_is_its_steps_and_what_is_beside_them() {
        use crate::lattice::Lattice;
        use crate::scene::{StepRule, Time};
        let lattice = Lattice {
            kernel: crate::kernel::Kernel::Constant,
            m: 3.0,
            volume_rule: crate::partial_volume::VolumeRule::Linear,
            calibrated: false,
        };
        let material = crate::material::Material { youngs_modulus: 1.0, density: 1.0 };
        let time = Time { duration: 1.0, step: StepRule::OfLimit(0.5) };
        let scene = Scene::bare(material, crate::material::Body::PlaneStress, lattice, [8; 2], 0.1, time);
        let looks = Looks { stops: 9, growth: 6, snapshots: 2, patch_nodes: 17, values: 19 };
        let plan =
            Plan { steps: 64, nodes: 10_000, work: work(10_000, 10), looks, ..Plan::of(&scene).unwrap() };
        let step = 100.0 + 1e4 * 2.0;
        // Ten times the largest, the size itself, a tenth of the way between two, below the smallest.
        let beside = 120.0 + 6.0 * 2505.0 + 9.0 * 27.0 + 2.0 * 230.0 + 17.0 * 11.0 + 19.0 * 13.0;
        assert_eq!(costs().of_march(&plan), Some((64 + 1 + 6) as f64 * step + beside));
        assert_eq!(Costs::default().of_march(&plan), None);
    }

    #[test]
    fn what_was_not_measured_is_not_predicted() {
        assert_eq!(costs().of_step(&Work { dimension: 1, ..work(10, 3) }), None);
        let nothing = Costs { plate: BodyCosts { masked_end_s: f64::NAN, ..costs().plate }, ..costs() };
        let kinds = Kinds { masked_nodes: 1, masked_ends: 3, ..Kinds::default() };
        assert_eq!(nothing.of_step(&Work { kinds, ..work(0, 10) }), None);
        assert!(nothing.of_step(&work(10, 10)).is_some());
    }
}
