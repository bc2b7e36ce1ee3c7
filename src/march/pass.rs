//! Some steps of a body in one pass over memory.
//!
//! On a piece where bonds act alone they move the nodes themselves; elsewhere forces are summed first, then the increments
//! change, constraints hold, and the displacements of the next time are written. Both are the same arithmetic.

use super::schedule::Schedule;
use super::shared::Shared;
use crate::breaking::Broken;
use crate::constraints::Ghost;
use crate::field::{Field, Window};
use crate::forces::Now;
use crate::forces::Step;
use crate::model::{Inertia, Model};
use crate::simd::{Kernel, Lanes};
use rayon::prelude::*;

/// The fields of a body in the terms of a pass.
pub struct Pass<'a, const D: usize> {
    pub model: &'a Model<D>,
    pub broken: &'a Broken,
    /// By piece, the only term that acts there, where there is one and no constraint.
    pub alone: &'a [Option<usize>],
    /// What mirrors the ends.
    pub ghosts: &'a [Ghost<D>],
    pub time_step: f64,
    /// The step at which the pass begins.
    pub step: u64,
    /// Displacements of even and odd levels.
    pub displacement: [Shared<'a>; 2],
    pub increment: Shared<'a>,
}

impl<const D: usize> Pass<'_, D> {
    /// Does all tasks; `sums` has a piece for each band.
    pub fn run(&self, schedule: &Schedule, sums: &mut [Field]) {
        if schedule.bands == 1 {
            // SAFETY: one task after the other, in the order of the schedule.
            schedule.trapezoid(0).for_each(|task| unsafe { self.task(task, &mut sums[0]) });
            return;
        }
        let sums = &mut sums[..schedule.bands];
        // SAFETY: tasks of different bands, then of different wedges, write nothing that others touch (`schedule`).
        sums.par_iter_mut().enumerate().with_max_len(1).for_each(|(band, sum)| {
            schedule.trapezoid(band).for_each(|task| unsafe { self.task(task, sum) });
        });
        if schedule.levels > 1 {
            // SAFETY: as above.
            sums[1..].par_iter_mut().enumerate().with_max_len(1).for_each(|(band, sum)| {
                schedule.wedge(band).for_each(|task| unsafe { self.task(task, sum) });
            });
        }
    }

    /// Step `level` of the pass on a piece.
    ///
    /// # Safety
    /// Nobody writes meanwhile what the nodes of the piece see of this level, nobody touches the piece in the other field and
    /// in the increments, nor the ghosts that repeat it.
    unsafe fn task(&self, (level, piece): (usize, usize), sum: &mut [f64]) {
        let model = self.model;
        let grid = &model.grid;
        let (range, seen) = (grid.range(piece), grid.seen(piece));
        let (from, to) = (self.displacement[level % 2], self.displacement[(level + 1) % 2]);
        // SAFETY: the caller's; the three stretches lie in three fields.
        let (u, next, increment) = unsafe {
            (from.read(seen.clone()), to.write(range.clone()), self.increment.write(range.clone()))
        };
        let displacement = Window::new(u, seen.start);
        let step = self.step + level as u64;
        let factor = self.time_step * self.time_step;
        let now = |increment| Now {
            displacement,
            increment: Window::new(increment, range.start),
            time: step as f64 * self.time_step,
            time_step: self.time_step,
            broken: self.broken,
        };
        let alone = match (&model.inertia, self.alone[piece]) {
            (Inertia::Uniform(density), Some(bonds)) => {
                let (increment, next) = (&mut *increment, &mut *next);
                let mut step = Step { increment, next, start: range.start, factor: factor / density };
                model.forces()[bonds].step(&now(&[]), piece, &mut step)
            }
            _ => false,
        };
        if !alone {
            let sum = &mut sum[..range.len()];
            model.force_on(&now(increment), piece, sum);
            model.isa.run(Accelerate {
                inertia: &model.inertia,
                scale: factor,
                start: range.start,
                force: sum,
                increment: &mut *increment,
            });
            let until = (step + 1) as f64 * self.time_step;
            for constraint in &model.constraints {
                constraint.hold(until, displacement, increment, range.start);
            }
            let own = &u[range.start - seen.start..range.end - seen.start];
            model.isa.run(Move { own, increment, next });
        }
        if D > 1 && model.edges.any() {
            model.edges.fill_beside(grid, next);
        }
        for ghost in self.ghosts.iter().filter(|ghost| range.contains(&ghost.sources().start)) {
            // SAFETY: the caller's; sources and ghosts of a piece do not overlap, and `next` is not used after this.
            unsafe { ghost.fill(to.read(ghost.sources()), to.write(ghost.places())) };
        }
    }
}

/// d ← d + scale/ρ F.
pub struct Accelerate<'a> {
    pub inertia: &'a Inertia,
    pub scale: f64,
    /// Place of the first number.
    pub start: usize,
    pub force: &'a [f64],
    pub increment: &'a mut [f64],
}

impl Kernel for Accelerate<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let terms = self.increment.iter_mut().zip(self.force);
        match self.inertia {
            Inertia::Uniform(density) => {
                let factor = self.scale / density;
                terms.for_each(|(d, force)| *d += factor * force);
            }
            Inertia::Diagonal(densities) => {
                let terms = terms.zip(&densities[self.start..]);
                terms.for_each(|((d, force), density)| *d += self.scale / density * force);
            }
        }
    }
}

/// u(n+1) = u(n) + d.
struct Move<'a> {
    own: &'a [f64],
    increment: &'a [f64],
    next: &'a mut [f64],
}

impl Kernel for Move<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let terms = self.next.iter_mut().zip(self.own.iter().zip(self.increment));
        terms.for_each(|(next, (u, d))| *next = u + d);
    }
}
