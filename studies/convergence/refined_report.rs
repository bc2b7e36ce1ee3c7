//! Rows of `convergence.csv` and figures of refinements: errors over δ or 1/m, the fitted tail, slopes to read them by.

use super::path::Refine;
use super::refined::{Problem, Refined, Seen, Track};
use super::space::{In, Space};
use super::theory::Expected;
use crate::levels::{self, NORMS};
use crate::question::Place;
use pd_verify::compare::order::{Tail, fitted, tail};
use pd_verify::report::plot::{Axis, Dash, Figure, Guide, Lines, Marker, Series};
use pd_verify::table::Table;

/// Curves that one panel can show.
const DRAWN: usize = 7;
/// The norm that figures show.
const L2: usize = 1;

/// Rows of all levels.
pub fn table<L>(tracks: &[Track<L>], seen: &[Seen], place: &Place) -> Table {
    let mut table = levels::table("convergence.csv");
    for (track, seen) in tracks.iter().zip(seen) {
        let at = |level: usize| {
            let level = track.sequence.levels[level];
            (track.sequence.lattice(level), level.spacing)
        };
        levels::push(&mut table, track.sequence.refine.word(), &place.case, &seen.levels, at);
    }
    table
}

/// The errors of all refinements: what converges, what stops, what theory leaves to the volume rule.
pub fn figures<const D: usize, P: Problem<D>>(
    refined: &Refined<D, P>,
    seen: &[Seen],
    place: &Place,
) -> Vec<Figure>
where
    In: Space<D>,
{
    let floor = refined.floor();
    let both = || refined.tracks.iter().zip(seen);
    let path = refined.tracks.iter().any(|track| track.sequence.refine == Refine::DeltaM);
    let alone = if path { "weights as printed, δ → 0 and m → ∞" } else { "m → ∞ at fixed δ" };
    let groups: [(&str, bool, Vec<_>); 3] = [
        ("with the intended moduli", true, both().filter(|(track, _)| track.converges()).collect()),
        ("with other moduli than intended", false, both().filter(|(track, _)| track.stops()).collect()),
        (alone, true, both().filter(|(track, _)| !track.converges() && !track.stops()).collect()),
    ];
    let mut panels = Vec::new();
    let mut left_out = 0;
    for (title, ordered, tracks) in groups {
        if tracks.is_empty() {
            continue;
        }
        left_out += tracks.len().saturating_sub(DRAWN);
        panels.push(panel::<D, _>(
            title,
            ordered,
            &tracks[..tracks.len().min(DRAWN)],
            floor,
            refined.problem.order().expected,
        ));
    }
    let mut caption = format!(
        "Error in L2 of {}, relative to the exact field. Broken lines: the fitted powers, through the finest levels whose pairwise orders agree or, where nodes enter and leave the rim, through all.",
        refined.problem.what()
    );
    let at_floor: usize = seen.iter().map(|seen| tail(&seen.levels.in_norm(L2), floor).at_floor).sum();
    if at_floor > 0 {
        caption += &format!(" {at_floor} levels lie at the round-off floor of {floor:e} and carry no order.");
    }
    if left_out > 0 {
        caption += &format!(" {left_out} more lattices are in convergence.csv.");
    }
    let mut figure = Figure::new(place.case.clone(), refined.title.clone(), caption, Lines::default());
    figure.panels = panels.into_iter().map(Into::into).collect();
    vec![figure]
}

fn panel<const D: usize, L>(
    title: &str,
    ordered: bool,
    tracks: &[(&Track<L>, &Seen)],
    floor: f64,
    order: f64,
) -> Lines {
    let mut series = Vec::new();
    for (slot, (track, seen)) in tracks.iter().enumerate() {
        series.push(Series::both(track.name.clone(), seen.levels.in_norm(L2)).slot(slot));
    }
    for (slot, (track, seen)) in tracks.iter().enumerate().filter(|_| ordered) {
        let levels = seen.levels.in_norm(L2);
        let judged = match track.expected::<D>() {
            Expected::Falls { .. } if track.alone() => continue,
            Expected::Slope { .. } if track.alone() => {
                Tail { order: fitted(&levels), levels, at_floor: 0, too_coarse: 0 }
            }
            _ => tail(&levels, floor),
        };
        let fitted = fit(&judged);
        series.extend(fitted.map(|line| Series::line("", line).slot(slot).dash(Dash::Dashed).width(1.2)));
    }
    if !ordered {
        let mark = |(track, seen): &(&Track<L>, &Seen)| {
            Some((track.sequence.step(track.sequence.finest()), seen.plateau?[L2]))
        };
        for (slot, track) in tracks.iter().enumerate() {
            let label = if slot == 0 { "+ of a body with the lattice's moduli" } else { "" };
            let marks = Series::markers(label, mark(track).into_iter().collect());
            series.push(marks.slot(slot).marker(Marker::Plus));
        }
    }
    let by_m = tracks.iter().all(|(track, _)| track.sequence.refine == Refine::M);
    let x = if by_m { Axis::log("1/m = Δx/δ") } else { Axis::log("δ (m)") };
    let mut panel =
        Lines::new(x, Axis::log(format!("error in {}", NORMS[L2].to_uppercase())), series).titled(title);
    if ordered {
        panel = panel.guide(Guide::Slope { order, label: format!("order {order}") });
    }
    panel
}

/// The fitted power through the tail, drawn a little beyond its ends.
fn fit(tail: &Tail) -> Option<Vec<(f64, f64)>> {
    let order = tail.order?.value;
    let count = tail.levels.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| tail.levels.iter().map(of).sum::<f64>() / count;
    let (h, error) = (mean(|level| libm::log(level.0)), mean(|level| libm::log(level.1)));
    let at = |x: f64| (x, libm::exp(error + order * (libm::log(x) - h)));
    Some(vec![at(1.3 * tail.levels.first()?.0), at(tail.levels.last()?.0 / 1.3)])
}
