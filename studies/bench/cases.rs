//! What is marched to be measured: plain bodies by size and family, and one with each operator and effect.

use super::bodies::{
    bar, body_force, cut_from_below, cut_from_left, damping, hole, plate, slanted, strips, traction,
};
use pd_verify::constraints::{Edge, Edges};
use pd_verify::forces::surface::Correction;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::scene::{Operator, Probe, Rotations, Scene, Watch, Wrong};

/// A body of either dimension.
#[derive(Debug, Clone)]
pub enum Body {
    Bar(Box<Scene<1>>),
    Plate(Box<Scene<2>>),
}

impl Body {
    pub fn plan(&self) -> Result<Plan, Wrong> {
        match self {
            Self::Bar(scene) => super::bodies::plan(scene),
            Self::Plate(scene) => super::bodies::plan(scene),
        }
    }

    /// Cells along each axis.
    pub fn nodes(&self) -> Vec<usize> {
        match self {
            Self::Bar(scene) => scene.nodes.to_vec(),
            Self::Plate(scene) => scene.nodes.to_vec(),
        }
    }

    pub fn m(&self) -> f64 {
        match self {
            Self::Bar(scene) => scene.lattice.m,
            Self::Plate(scene) => scene.lattice.m,
        }
    }

    /// The word of its operator on the command line.
    pub fn operator(&self) -> &'static str {
        let operator = match self {
            Self::Bar(scene) => scene.operator,
            Self::Plate(scene) => scene.operator,
        };
        match operator {
            Operator::Stencil => "stencil",
            Operator::Bonds => "bonds",
        }
    }
}

impl From<Scene<1>> for Body {
    fn from(scene: Scene<1>) -> Self {
        Self::Bar(Box::new(scene))
    }
}

impl From<Scene<2>> for Body {
    fn from(scene: Scene<2>) -> Self {
        Self::Plate(Box::new(scene))
    }
}

/// A body, and on how many threads it is marched.
#[derive(Debug, Clone)]
pub struct Case {
    pub name: String,
    pub body: Body,
    /// On one thread; else on all that are given.
    pub alone: bool,
}

impl Case {
    pub fn new(name: impl Into<String>, body: impl Into<Body>) -> Self {
        Self { name: name.into(), body: body.into(), alone: false }
    }

    fn alone(self) -> Self {
        Self { alone: true, ..self }
    }
}

/// Cases that take turns; the first is what the others are held against.
#[derive(Debug, Clone)]
pub struct Group {
    pub name: &'static str,
    pub cases: Vec<Case>,
}

/// Side of the plate of reference, in nodes, and its m.
pub const SIDE: usize = 1024;
pub const M: f64 = 3.0;

/// Nodes of the bar of reference.
const LENGTH: usize = 1_000_000;

/// The plate of reference.
pub fn plain() -> Scene<2> {
    plate([SIDE; 2], M)
}

/// All cases; speed-ups only where there are threads.
pub fn suite(threads: usize) -> Vec<Group> {
    let mut groups = vec![sizes(), effects(), families()];
    if threads > 1 {
        groups.extend([speed_up("threads, 1024²", SIDE), speed_up("threads, 256²", 256)]);
    }
    groups.push(bars());
    groups
}

/// The least of which costs can be taken: sizes, families, nodes that lack bonds, lists, loads, bars.
pub fn short_suite() -> Vec<Group> {
    let kept = |group: Group, names: &[&str]| {
        let kept = |case: &Case| names.contains(&case.name.as_str());
        let cases = group.cases.iter().enumerate().filter(|(at, case)| *at == 0 || kept(case));
        Group { cases: cases.map(|(_, case)| case.clone()).collect(), ..group }
    };
    vec![
        kept(sizes(), &["16²", "64²", "256²"]),
        kept(families(), &["m = 2", "m = 5", "m = 10"]),
        kept(effects(), &["all masked, strips", "damping", "body force", "bonds as a list"]),
        kept(bars(), &["100", "4000", "10⁵", "m = 10", "body force"]),
    ]
}

fn reference() -> Case {
    Case::new(format!("{SIDE}², m = {M}"), plain())
}

fn sizes() -> Group {
    let others = [16, 64, 128, 256, 512, 2048, 4096];
    let of = |&side: &usize| Case::new(format!("{side}²"), plate([side; 2], M));
    Group {
        name: "plates by size",
        cases: std::iter::once(reference()).chain(others.iter().map(of)).collect(),
    }
}

fn families() -> Group {
    let others = [2.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0];
    let of = |&m: &f64| Case::new(format!("m = {m}"), plate([SIDE; 2], m));
    Group {
        name: "plates by family",
        cases: std::iter::once(reference()).chain(others.iter().map(of)).collect(),
    }
}

fn effects() -> Group {
    let free = || Scene { edges: Edges::default(), ..plain() };
    let full = {
        let scene = plain();
        let lattice = pd_verify::lattice::Lattice { volume_rule: VolumeRule::Full, ..scene.lattice };
        Scene { lattice, ..scene }
    };
    let ledger = Probe { name: "energies".into(), watch: Watch::Energies, every: 1 };
    let cases = vec![
        reference(),
        Case::new("periodic edges", Scene { edges: Edges([[Edge::Periodic; 2]; 2]), ..plain() }),
        Case::new("free edges", free()),
        Case::new("notch along x", cut_from_left(plain())),
        Case::new("notch along y", cut_from_below(plain())),
        Case::new("hole", hole(plain())),
        Case::new("all masked, strips", strips(M)),
        Case::new("all masked, slanted cuts", slanted(256, M)),
        Case::new("volumes full", full),
        Case::new("finite rotations", Scene { rotations: Rotations::Finite, ..plain() }),
        Case::new("damping", Scene { effects: vec![damping()], ..plain() }),
        Case::new("traction", Scene { effects: vec![traction()], ..free() }),
        Case::new("body force", Scene { effects: vec![body_force()], ..plain() }),
        Case::new("surface correction", Scene { surface: Correction::Energy, ..free() }),
        Case::new("energy ledger", Scene { probes: vec![ledger], ..plain() }),
        Case::new("bonds as a list", Scene { operator: Operator::Bonds, ..plain() }),
    ];
    Group { name: "operators and effects", cases }
}

/// One thread, then all.
fn speed_up(name: &'static str, side: usize) -> Group {
    let case = |name: &str| Case::new(name, plate([side; 2], M));
    Group { name, cases: vec![case("one thread").alone(), case("all threads")] }
}

fn bars() -> Group {
    let plain = || bar(LENGTH, M);
    let ledger = Probe { name: "energies".into(), watch: Watch::Energies, every: 1 };
    let cases = vec![
        Case::new("10⁶, m = 3", plain()),
        Case::new("100", bar(100, M)),
        Case::new("4000", bar(4000, M)),
        Case::new("2·10⁴", bar(20_000, M)),
        Case::new("10⁵", bar(100_000, M)),
        Case::new("m = 10", bar(LENGTH, 10.0)),
        Case::new("free ends", Scene { edges: Edges::default(), ..plain() }),
        Case::new("finite rotations", Scene { rotations: Rotations::Finite, ..plain() }),
        Case::new("damping", Scene { effects: vec![damping()], ..plain() }),
        Case::new("body force", Scene { effects: vec![body_force()], ..plain() }),
        Case::new("energy ledger", Scene { probes: vec![ledger], ..plain() }),
        Case::new("bonds as a list", Scene { operator: Operator::Bonds, ..plain() }),
    ];
    Group { name: "bars", cases }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Small bodies of the same making: what each case is called is what it is.
    #[test]
    fn cases_are_what_they_are_called() {
        let kinds = |scene: &Scene<2>| super::super::bodies::plan(scene).unwrap().work.kinds;
        let small = || plate([64; 2], M);
        assert_eq!(kinds(&small()).whole_nodes, 64 * 64);
        let masked = |scene: Scene<2>| {
            let kinds = kinds(&scene);
            kinds.masked_nodes as f64 / kinds.nodes() as f64
        };
        assert_eq!(masked(slanted(64, M)), 1.0);
        assert!((0.01..0.2).contains(&masked(cut_from_left(small()))));
        assert!((0.01..0.2).contains(&masked(cut_from_below(small()))));
        assert!((0.01..0.2).contains(&masked(hole(small()))));
        assert!((0.1..0.3).contains(&masked(Scene { edges: Edges::default(), ..small() })));
    }

    #[test]
    fn groups_have_a_reference_and_names_that_tell_cases_apart() {
        for group in suite(2) {
            let names: std::collections::BTreeSet<&str> =
                group.cases.iter().map(|case| case.name.as_str()).collect();
            assert!(names.len() == group.cases.len() && names.len() > 1, "{}", group.name);
        }
        assert_eq!(suite(1).len() + 2, suite(2).len());
        let counts: Vec<usize> = short_suite().iter().map(|group| group.cases.len()).collect();
        assert_eq!(counts, [4, 4, 5, 6]);
    }
}
