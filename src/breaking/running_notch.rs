//! Notches that run: which bond is cut when, worked out once for the whole march.
//!
//! A bond is cut when the tip has passed the point where it crosses the line. Both of its ends are cut in the same step:
//! each looks at the time from both and takes the earlier, since rounding may tell them apart.

use super::tip::Tip;
use super::{Breakable, Broken};
use crate::connectivity::{Connectivity, with_images};
use crate::constraints::{Edge, Edges};
use crate::forces::Now;
use crate::grid::Grid;
use crate::scene::Scene;

/// The notches of a body that run, as a list of what is cut when.
#[derive(Debug, Clone)]
pub struct RunningNotches {
    breakable: Breakable,
    /// In the order of time.
    cuts: Vec<Cut>,
}

/// Some bonds of a node.
#[derive(Debug, Clone, Copy)]
struct Cut {
    /// In s.
    time: f64,
    word: usize,
    bits: u64,
}

impl RunningNotches {
    /// What the notches of a scene will cut of a half family, by its offsets; `None` where no notch runs.
    pub fn of<const D: usize>(scene: &Scene<D>, half: &[[i32; D]], grid: &Grid<D>) -> Option<Self> {
        if scene.running.is_empty() {
            return None;
        }
        let tips = scene.running.iter().map(|running| Tip::new(&scene.notches[running.notch], *running));
        let tips = with_images(scene, tips.collect(), Tip::mirrored, Tip::moved);
        let bonds = Bonds { grid, edges: scene.edges, tips };
        let connectivity = Connectivity::of(scene);
        let (mut cells, mut cuts) = (Vec::new(), Vec::new());
        let words = (2 * half.len()).div_ceil(64);
        for node in grid.each().filter(|node| bonds.may_change(*node)) {
            let first = cells.len() * words;
            let before = cuts.len();
            for (index, offset) in half.iter().enumerate() {
                for (end, offset) in [*offset, offset.map(|n| -n)].into_iter().enumerate() {
                    let exists = connectivity.present(node, offset);
                    let time = exists.then(|| bonds.cut(node, offset)).flatten();
                    let bit = 2 * index + end;
                    let cut = |time| Cut { time, word: first + bit / 64, bits: 1 << (bit % 64) };
                    cuts.extend(time.map(cut));
                }
            }
            if cuts.len() > before {
                cells.push(grid.number(node));
            }
        }
        cuts.sort_by(|a, b| a.time.total_cmp(&b.time));
        Some(Self { breakable: Breakable::new(cells, half.len()), cuts })
    }

    /// The nodes that will lose bonds.
    pub fn breakable(&self) -> &Breakable {
        &self.breakable
    }

    /// Nothing is broken yet.
    pub fn intact(&self) -> Broken {
        self.breakable.intact()
    }

    /// The rule: cuts what the tips have passed at the present time. Hands back what was broken before, where that changes.
    pub fn commit(&self, now: &Now<'_>, broken: &mut Broken) -> Option<Broken> {
        // Half a step more than the last one: times are rounded, and what is cut already stays so.
        let passed = |time: f64| self.cuts.partition_point(|cut| cut.time <= time);
        let due = &self.cuts[passed(now.time - 1.5 * now.time_step)..passed(now.time)];
        if due.iter().all(|cut| broken.words[cut.word] & cut.bits == cut.bits) {
            return None;
        }
        let before = broken.clone();
        due.iter().for_each(|cut| broken.words[cut.word] |= cut.bits);
        Some(before)
    }

    /// Bytes it keeps, and those of the bits.
    pub fn bytes(&self) -> usize {
        size_of_val(self.cuts.as_slice()) + self.breakable.bytes()
    }
}

/// The bonds of a body as tips see them.
struct Bonds<'a, const D: usize> {
    grid: &'a Grid<D>,
    edges: Edges<D>,
    tips: Vec<Tip>,
}

impl<const D: usize> Bonds<'_, D> {
    fn may_change(&self, node: [isize; D]) -> bool {
        let reach = (self.grid.halo as f64 + 0.5) * self.grid.spacing;
        let at = self.place(node, [0; D]);
        self.tips.iter().any(|tip| tip.is_near(at, reach))
    }

    /// When the bond of a node is cut, in s.
    fn cut(&self, node: [isize; D], offset: [i32; D]) -> Option<f64> {
        let (other, back) = self.other_end(node, offset)?;
        let times = [self.seen(node, offset), self.seen(other, back)];
        times.into_iter().flatten().min_by(f64::total_cmp)
    }

    /// The same as seen from one end.
    fn seen(&self, node: [isize; D], offset: [i32; D]) -> Option<f64> {
        let (a, b) = (self.place(node, [0; D]), self.place(node, offset));
        let times = self.tips.iter().filter_map(|tip| tip.time(a, b, self.grid.spacing));
        times.min_by(f64::total_cmp)
    }

    /// The node of the body at the other end, and how it sees the same bond: beyond an edge its image.
    fn other_end(&self, node: [isize; D], offset: [i32; D]) -> Option<([isize; D], [i32; D])> {
        let far: [isize; D] = std::array::from_fn(|axis| node[axis] + offset[axis] as isize);
        let other = self.edges.image(self.grid, far)?;
        let back = std::array::from_fn(|axis| {
            let [below, above] = self.edges.0[axis];
            let beyond = match far[axis] {
                n if n < 0 => below,
                n if n >= self.grid.nodes[axis] as isize => above,
                _ => Edge::Free,
            };
            let mirrors = matches!(beyond, Edge::MirrorOdd | Edge::MirrorEven);
            if mirrors { offset[axis] } else { -offset[axis] }
        });
        Some((other, back))
    }

    /// As in [`Connectivity`]: a bar lies on the x axis.
    fn place(&self, node: [isize; D], offset: [i32; D]) -> [f64; 2] {
        let at = |axis: usize| (node[axis] as f64 + 0.5 + f64::from(offset[axis])) * self.grid.spacing;
        std::array::from_fn(|axis| if axis < D { at(axis) } else { 0.0 })
    }
}
