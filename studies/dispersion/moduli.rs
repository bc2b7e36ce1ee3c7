//! `asks = "moduli"`: the moduli a lattice really has, before and after calibration, and their anisotropy.

use super::curve::reference_lattice;
use super::lattice_table::{lattice_row, lattice_table};
use super::sweep::{LatticeSweep, check_sizes, distinct, unusable};
use super::words::BodyName;
use crate::input::OneOrMany;
use crate::question::{Answer, Claiming, Effort, Place, Question, claim, error_of};
use crate::subject::Subject;
use crate::written::{Asked, Written};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::compare::largest;
use pd_verify::kernel::Kernel;
use pd_verify::lattice::{Calibration, Lattice, Moduli as LatticeModuli, Stencil, Unusable};
use pd_verify::material::Body;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::report::plot::{Axis, Category, Dots, Figure};
use pd_verify::scene::Wrong;
use pd_verify::table::{Cell, Table};
use pd_verify_reference as reference;
use schemars::JsonSchema;
use serde::Deserialize;

/// The case as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ModuliAsked {
    pub body: OneOrMany<BodyName>,
    pub lattice: LatticeSweep,
}

/// The case, checked. Unusable lattices stay in the table, named as such.
pub struct Moduli {
    title: String,
    asked: Vec<(Body, Lattice)>,
}

impl Asked for ModuliAsked {
    type Question = Moduli;

    fn check(&self, written: &Written<'_>) -> Result<Moduli, Wrong> {
        let lattices = self.lattice.lattices().map_err(|wrong| wrong.inside("lattice"))?;
        let mut asked = Vec::new();
        for &body in &self.body.0 {
            check_sizes(body.into(), &lattices).map_err(|wrong| wrong.inside("lattice"))?;
            for &lattice in &lattices {
                asked.push((body.into(), lattice));
            }
        }
        if asked.iter().all(|&(body, lattice)| unusable(body, lattice).is_some()) {
            let (body, lattice) = asked[0];
            let reason = unusable(body, lattice).expect("every lattice is unusable");
            return Err(Wrong::new("lattice.m", reason.to_string(), reason.cure()));
        }
        Ok(Moduli { title: written.title.to_owned(), asked })
    }
}

/// What a lattice was found to have.
struct Measured {
    neighbours: usize,
    before: LatticeModuli,
    after: LatticeModuli,
    calibration: Option<Calibration>,
    negative_bonds: usize,
}

impl Question for Moduli {
    fn claims(&self, place: &Place) -> Vec<Claim> {
        let mut claims = vec![
            claim(
                place,
                "moduli",
                "largest error of C11 and C12, as printed and in use, over the intended ones",
            )
            .at_most(ErrorKind::Absolute, 1e-12)
            .because(Basis::Rounding, "sums of up to some thousand terms, and one 2×2 solution")
            .source("the same sums over an independently enumerated family, double-double arithmetic"),
            claim(
                place,
                "speeds",
                "largest error of long-wave speeds over the intended ones, P and S at 0° and 45°",
            )
            .at_most(ErrorKind::Absolute, 1e-12)
            .because(Basis::Rounding, "square roots of the moduli")
            .source("slope at k = 0 of the reference's dispersion relation"),
            claim(place, "refusals", "lattices that only one of the two codes refuses")
                .exactly()
                .because(
                    Basis::Theory,
                    "a modulus below rounding of the intended one, or no shear, leaves nothing to run",
                )
                .source("moduli of the independent sums"),
            claim(place, "families", "families whose size differs from the reference's")
                .exactly()
                .because(Basis::Theory, "a count is exact")
                .source("independent enumeration of the family"),
        ];
        if self.any(|lattice| lattice.calibrated) {
            claims.push(
                claim(place, "calibrated", "largest |C/C_intended − 1| of calibrated lattices")
                    .at_most(ErrorKind::Absolute, 1e-12)
                    .because(Basis::Rounding, "calibration solves for exactly these moduli")
                    .source("definition: C11 and C12 = C66 as intended"),
            );
            claims.push(
                claim(
                    place,
                    "factors",
                    "largest error of α and β over the larger of the factors on axes and diagonals",
                )
                .at_most(ErrorKind::Relative, 1e-12)
                .because(Basis::Rounding, "one 2×2 solution with positive sums")
                .source("α and β solved in double-double arithmetic"),
            );
        }
        claims
    }

    fn effort(&self) -> Effort {
        let bonds = |&(body, lattice): &(Body, Lattice)| match body {
            Body::Bar => lattice.m,
            Body::PlaneStress | Body::PlaneStrain => 2.0 * lattice.m * lattice.m,
        };
        let visited: f64 = self.asked.iter().map(bonds).sum();
        let count = self.asked.len() as u64;
        Effort {
            curves: count,
            evaluations: count,
            bond_evaluations: visited as u64,
            reference_evaluations: 2 * count,
            ..Effort::default()
        }
    }

    fn equations(&self) -> &'static str {
        "C₁₁ = Σ w |r|² cos⁴θ, C₁₂ = C₆₆ = Σ w |r|² cos²θ sin²θ over half the family; Zener's ratio 2C₆₆/(C₁₁ − C₁₂)
calibration: bonds times α + β cos 4θ, α and β from C₁₁ and C₁₂ as intended (one factor in a bar)"
    }

    fn answer(&self, subject: &dyn Subject, place: &Place) -> Answer {
        let measured: Vec<_> = self
            .asked
            .iter()
            .map(|&(body, lattice)| measure(subject, body, lattice).map_err(|e| e.to_string()))
            .collect();
        let usable = || {
            let pairs = self.asked.iter().zip(&measured);
            pairs.filter_map(|(&(body, lattice), found)| {
                found.as_ref().ok().map(|found| (body, lattice, found))
            })
        };
        let refused = self.asked.len() - usable().count();
        let negative: usize = usable().map(|(_, _, found)| found.negative_bonds).sum();
        let used = self.asked.len() - refused;
        let note =
            format!("{used} lattices, {refused} more refused by name, {negative} bonds with negative weight");
        let error = largest(usable().map(|(body, lattice, found)| error_of_moduli(body, lattice, found)));
        let speeds =
            largest(usable().map(|(body, lattice, found)| error_of_speeds(body, lattice, found.after)));
        let factors =
            largest(usable().filter_map(|(body, lattice, found)| error_of_factors(body, lattice, found)));
        let disputed = self
            .asked
            .iter()
            .zip(&measured)
            .filter(|((body, lattice), found)| found.is_ok() != sound(*body, *lattice))
            .count();
        let wrong_sizes =
            usable().filter(|(body, lattice, found)| found.neighbours != exact_size(*body, *lattice)).count();
        let calibrated = usable().filter(|(_, lattice, _)| lattice.calibrated);
        let residual = largest(calibrated.map(|(body, _, found)| {
            let shear = if body == Body::Bar { 0.0 } else { (found.after.c12 - 1.0).abs() };
            (found.after.c11 - 1.0).abs().max(shear)
        }));
        let evidence = vec![
            ("moduli".into(), error_of(error, note.clone())),
            ("speeds".into(), error_of(speeds, note.clone())),
            ("factors".into(), error_of(factors, note.clone())),
            ("refusals".into(), crate::question::value_of(Some(disputed as f64), Some(0.0), note.clone())),
            ("families".into(), crate::question::value_of(Some(wrong_sizes as f64), Some(0.0), note.clone())),
            ("calibrated".into(), error_of(residual, note)),
        ];
        let figures = self.figures(&measured, place);
        Answer { evidence, tables: vec![self.table(&measured, place)], figures, ..Answer::default() }
    }
}

fn measure(subject: &dyn Subject, body: Body, lattice: Lattice) -> Result<Measured, Unusable> {
    match body {
        Body::Bar => subject.bar_stencil(lattice).map(read),
        Body::PlaneStress | Body::PlaneStrain => subject.plane_stencil(lattice).map(read),
    }
}

fn read<const D: usize>(stencil: Stencil<D>) -> Measured {
    Measured {
        neighbours: 2 * stencil.bonds.len(),
        before: stencil.before,
        after: stencil.after,
        calibration: stencil.calibration,
        negative_bonds: stencil.negative_bonds(),
    }
}

fn exact_size(body: Body, lattice: Lattice) -> usize {
    let of = reference_lattice(lattice);
    match body {
        Body::Bar => reference::lattice::neighbours_bar(of.m, of.rule),
        Body::PlaneStress | Body::PlaneStrain => reference::lattice::neighbours_plane(of.m, of.rule),
    }
}

fn error_of_moduli(body: Body, lattice: Lattice, found: &Measured) -> f64 {
    let exact = |calibrated| {
        let of = reference::Lattice { calibrated, ..reference_lattice(lattice) };
        if body == Body::Bar {
            return [reference::lattice::bar_modulus(of), 0.0, 0.0];
        }
        let moduli = reference::lattice::plane_moduli(of);
        [moduli.c11, moduli.c12, moduli.c66]
    };
    let difference = |found: LatticeModuli, exact: [f64; 3]| {
        let shear = if body == Body::Bar { [0.0; 2] } else { [found.c12 - exact[1], found.c12 - exact[2]] };
        shear.iter().fold((found.c11 - exact[0]).abs(), |most, d| most.max(d.abs()))
    };
    difference(found.before, exact(false)).max(difference(found.after, exact(lattice.calibrated)))
}

/// Whether the reference finds the moduli of a lattice above rounding.
fn sound(body: Body, lattice: Lattice) -> bool {
    match body {
        Body::Bar => {
            let of = reference::Lattice { calibrated: false, ..reference_lattice(lattice) };
            reference::lattice::bar_modulus(of) >= f64::EPSILON
        }
        Body::PlaneStress | Body::PlaneStrain => sound_in_plane(lattice),
    }
}

/// The same in the plane.
pub fn sound_in_plane(lattice: Lattice) -> bool {
    let of = reference::Lattice { calibrated: false, ..reference_lattice(lattice) };
    let moduli = reference::lattice::plane_moduli(of);
    moduli.c11.min(moduli.c66) >= f64::EPSILON
}

/// Long-wave speeds over the intended ones: P at 0° and 45°, S at 0° and 45°.
///
/// Along a diagonal ρc² = (C₁₁ + C₁₂ + 2C₆₆)/2 and (C₁₁ − C₁₂)/2, with C₁₁ = 3C₁₂ = 3C₆₆ intended.
fn speeds(moduli: LatticeModuli) -> [f64; 4] {
    let LatticeModuli { c11, c12 } = moduli;
    [c11, 0.5 * (c11 + c12), c12, 0.5 * (3.0 * c11 - c12)].map(f64::sqrt)
}

fn error_of_speeds(body: Body, lattice: Lattice, moduli: LatticeModuli) -> f64 {
    let of = reference_lattice(lattice);
    if body == Body::Bar {
        return (moduli.c11.sqrt() - reference::lattice::bar(of, 0.0).slope).abs();
    }
    let [p_0, p_45, s_0, s_45] = speeds(moduli);
    let [on_axis, diagonal] =
        [0.0, std::f64::consts::FRAC_PI_4].map(|angle| reference::lattice::plane(of, 0.0, angle));
    let exact = [on_axis[0].slope, diagonal[0].slope, on_axis[1].slope, diagonal[1].slope];
    [p_0, p_45, s_0, s_45].iter().zip(exact).map(|(mine, exact)| (mine - exact).abs()).fold(0.0, f64::max)
}

fn error_of_factors(body: Body, lattice: Lattice, found: &Measured) -> Option<f64> {
    let mine = found.calibration?;
    let of = reference_lattice(lattice);
    if body == Body::Bar {
        let modulus = reference::lattice::bar_modulus(reference::Lattice { calibrated: false, ..of });
        return Some((mine.alpha * modulus - 1.0).abs());
    }
    let (alpha, beta) = reference::lattice::calibration(of)?;
    // α + β may be a small difference of large numbers; it is judged against the larger of the two factors.
    let scale = (alpha + beta).abs().max((alpha - beta).abs());
    Some((mine.alpha - alpha).abs().max((mine.beta - beta).abs()) / scale)
}

impl Moduli {
    fn any(&self, f: impl Fn(Lattice) -> bool) -> bool {
        self.asked.iter().any(|&(_, lattice)| f(lattice))
    }

    fn table(&self, measured: &[Result<Measured, String>], place: &Place) -> Table {
        let columns = [
            "neighbours",
            "c11_as_printed",
            "c12_as_printed",
            "zener_as_printed",
            "c11_in_use",
            "c12_in_use",
            "zener_in_use",
            "alpha",
            "beta",
            "speed_p_0_deg",
            "speed_p_45_deg",
            "speed_s_0_deg",
            "speed_s_45_deg",
            "negative_bonds",
            "refused",
        ];
        let mut table = lattice_table("moduli.csv", &columns);
        for (&(body, lattice), found) in self.asked.iter().zip(measured) {
            let own = match found {
                Ok(found) => cells(body, found),
                Err(reason) => {
                    let unknown = std::iter::repeat_n(Cell::Empty, columns.len() - 1);
                    unknown.chain([reason.clone().into()]).collect()
                }
            };
            table.push(lattice_row(&place.case, body, lattice, own));
        }
        table
    }

    /// Lattice modulus over the intended one, weights as printed, by kernel and m: a figure for each volume rule.
    fn figures(&self, measured: &[Result<Measured, String>], place: &Place) -> Vec<Figure> {
        let found = self.asked.iter().zip(measured).filter(|((body, _), _)| *body != Body::Bar);
        let found: Vec<(Lattice, LatticeModuli)> = found
            .filter_map(|((_, lattice), found)| found.as_ref().ok().map(|found| (*lattice, found.before)))
            .collect();
        let kernels = distinct(found.iter().map(|(lattice, _)| lattice.kernel));
        let sizes = distinct(found.iter().map(|(lattice, _)| lattice.m));
        // Whole m from 2 on fit one scale; a user's odd m are shown when there are no others.
        let usual: Vec<f64> = sizes.iter().copied().filter(|m| *m >= 2.0 && m.fract() == 0.0).collect();
        let sizes = if usual.is_empty() { sizes } else { usual };
        let drawn = VolumeRule::ALL
            .into_iter()
            .filter(|rule| found.iter().any(|(lattice, _)| lattice.volume_rule == *rule));
        let figure = |rule: VolumeRule| {
            let panel = |(name, modulus)| chart(name, modulus, rule, &found, &kernels, &sizes);
            let caption = format!(
                "{}, weights as printed; plane stress and plane strain have the same ratios.",
                self.title
            );
            let title = format!("{}: {} volumes", self.title, rule.name().replace('_', " "));
            let id = format!("{}-{}", place.case, rule.name().replace('_', "-"));
            Figure::new(id, title, caption, panel(MODULI[0])).panel(panel(MODULI[1])).columns(2)
        };
        drawn.map(figure).collect()
    }
}

/// One modulus by kernel, a dot for each m.
fn chart(
    name: &str,
    modulus: Reader,
    rule: VolumeRule,
    found: &[(Lattice, LatticeModuli)],
    kernels: &[Kernel],
    sizes: &[f64],
) -> Dots {
    let value = |kernel: Kernel, m: f64| {
        let mine = |l: &Lattice| l.kernel == kernel && l.m == m && l.volume_rule == rule;
        found.iter().find(|(lattice, _)| mine(lattice)).map_or(f64::NAN, |(_, moduli)| modulus(moduli))
    };
    let category = |&kernel: &Kernel| {
        Category::new(kernel.to_string(), sizes.iter().map(|&m| value(kernel, m)).collect::<Vec<_>>())
    };
    let groups = sizes.iter().map(|m| format!("m = {m}")).collect();
    Dots::new(
        Axis::linear(format!("lattice {name} / intended")),
        groups,
        kernels.iter().map(category).collect(),
    )
    .titled(name)
    .reference(1.0, "intended")
}

/// How to read one modulus of a lattice.
type Reader = fn(&LatticeModuli) -> f64;

const MODULI: [(&str, Reader); 2] = [("C11", |moduli| moduli.c11), ("C66", |moduli| moduli.c12)];

fn cells(body: Body, found: &Measured) -> Vec<Cell> {
    let plane = body != Body::Bar;
    let LatticeModuli { c11, c12 } = found.after;
    let [p_0, p_45, s_0, s_45] = speeds(found.after);
    vec![
        found.neighbours.into(),
        found.before.c11.into(),
        plane.then_some(found.before.c12).into(),
        plane.then(|| found.before.zener_ratio()).into(),
        c11.into(),
        plane.then_some(c12).into(),
        plane.then(|| found.after.zener_ratio()).into(),
        found.calibration.map(|calibration| calibration.alpha).into(),
        found.calibration.filter(|_| plane).map(|calibration| calibration.beta).into(),
        p_0.into(),
        plane.then_some(p_45).into(),
        plane.then_some(s_0).into(),
        plane.then_some(s_45).into(),
        found.negative_bonds.into(),
        Cell::Empty,
    ]
}
