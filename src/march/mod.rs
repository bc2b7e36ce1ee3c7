//! Time marching by leapfrog: d ← d + Δt²/ρ F(u), u ← u + d, with d = Δt times the velocity at the half step.
//!
//! Velocity Verlet and central differences are the same scheme written in other variables (tests/schemes.rs). Started
//! with d = Δt v₀ − ½Δt² a₀ half a step before t = 0, it is second order from the first step on.

//!
//! Between two looks at a body several steps are made in one pass over memory (`pass`, `schedule`); no bit depends on
//! how many, nor on the number of threads.

mod kept;
mod motion;
mod pass;
mod schedule;
mod shared;

pub use kept::Kept;
pub use motion::Motion;

use crate::breaking::{Broken, RunningNotches};
use crate::constraints::Ghost;
use crate::field::{Field, Window, all_finite};
use crate::forces::Now;
use crate::grid::Grid;
use crate::ledger::Ledger;
use crate::model::Model;
use crate::scene::{Initial, Scene};
use pass::{Accelerate, Pass};
use schedule::Schedule;
use shared::Shared;
use std::collections::BTreeMap;

/// Steps of a pass, at most: with more the fields of neighbouring pieces no longer stay in a core's cache.
const STEPS_PER_PASS: usize = 4;

/// The sum of initial fields, `scale` times, as a field of the grid.
pub(crate) fn initial<const D: usize>(grid: &Grid<D>, fields: &[Initial<D>], scale: f64) -> Field {
    let mut values = grid.field();
    for initial in fields {
        for node in grid.each() {
            let place = grid.place(node) + initial.component * grid.stride();
            values[place] += scale * initial.at(grid.position(node));
        }
    }
    values
}

/// A body in motion.
pub struct March<'m, const D: usize> {
    model: &'m Model<D>,
    /// Δt in s.
    time_step: f64,
    step: u64,
    displacement: Field,
    increment: Field,
    /// The displacements of the next time while they are made, or a sum of forces.
    other: Field,
    /// Sums of forces on a piece, for each band of a pass.
    sums: Vec<Field>,
    /// By piece, the only term that acts there, where there is one and no constraint.
    alone: Vec<Option<usize>>,
    ghosts: Vec<Ghost<D>>,
    broken: Broken,
}

impl<'m, const D: usize> March<'m, D> {
    /// The body at t = 0, from the scene's initial fields.
    pub fn new(model: &'m Model<D>, scene: &Scene<D>, time_step: f64) -> Self {
        let displacement = initial(&model.grid, &scene.displacement, 1.0);
        let increment = initial(&model.grid, &scene.velocity, time_step);
        Self::from_fields(model, displacement, increment, time_step)
    }

    /// The body at t = 0 with displacement u and Δt v in m, as fields of the model's grid.
    pub fn from_fields(
        model: &'m Model<D>,
        displacement: impl Into<Field>,
        velocity_step: impl Into<Field>,
        time_step: f64,
    ) -> Self {
        let grid = &model.grid;
        let broken = model.breaking.as_ref().map_or_else(|| Broken::none().clone(), RunningNotches::intact);
        let bands = rayon::current_num_threads().min(model.worth_threads()).clamp(1, grid.pieces());
        let mut march = Self {
            model,
            time_step,
            step: 0,
            displacement: displacement.into(),
            increment: grid.field(),
            other: grid.field(),
            sums: vec![Field::zeros(grid.piece()); bands],
            alone: (0..grid.pieces()).map(|piece| alone(model, piece)).collect(),
            ghosts: if model.edges.repeats_pieces() { Vec::new() } else { model.edges.ghosts(grid) },
            broken,
        };
        for constraint in &model.constraints {
            constraint.hold(0.0, Window::from(&march.displacement), &mut march.increment, 0);
        }
        add(&mut march.displacement, &march.increment);
        march.increment = velocity_step.into();
        model.fill_ghosts(&mut march.displacement);
        march.commit();
        let mut force = std::mem::take(&mut march.other);
        model.force(&march.now(), &mut force);
        accelerate(model, -0.5 * time_step * time_step, &force, &mut march.increment);
        // Ghosts and removed nodes do not move: what the other field holds of them is what it will hold.
        force.copy_from_slice(&march.displacement);
        march.other = force;
        march
    }

    /// t in s.
    pub fn time(&self) -> f64 {
        self.step as f64 * self.time_step
    }

    /// Steps done.
    pub fn step(&self) -> u64 {
        self.step
    }

    /// Δt in s.
    pub fn time_step(&self) -> f64 {
        self.time_step
    }

    /// u at the present time in m.
    pub fn displacement(&self) -> &[f64] {
        &self.displacement
    }

    /// u(n) − u(n−1) in m.
    pub fn increment(&self) -> &[f64] {
        &self.increment
    }

    /// The velocity in m/s at the present time, (u(n+1) − u(n−1))/2Δt, by a trial of the next step that changes nothing.
    /// There is no step before the first: the velocity at t = 0 is the one given as `start`, and nodes that are driven
    /// take that of the step which they begin.
    pub fn velocity(&self, start: Option<Field>) -> Field {
        let (model, time_step) = (self.model, self.time_step);
        let (mut force, mut next) = (model.grid.field(), self.increment.clone());
        model.force(&self.now(), &mut force);
        accelerate(model, time_step * time_step, &force, &mut next);
        let time = (self.step + 1) as f64 * time_step;
        let now = Window::from(&self.displacement);
        model.constraints.iter().for_each(|constraint| constraint.hold(time, now, &mut next, 0));
        let Some(mut velocity) = start else {
            return next
                .iter()
                .zip(self.increment.iter())
                .map(|(next, last)| (next + last) / (2.0 * time_step))
                .collect();
        };
        let driven = model.constraints.iter().flat_map(|constraint| constraint.places());
        driven.for_each(|&place| velocity[place] = next[place] / time_step);
        velocity
    }

    /// The accelerations in m/s² of the nodes whose first components lie at `places`, (u(n+1) − 2u(n) + u(n−1))/Δt² by a
    /// trial of the next step that changes nothing: of a node that is free to move F/ρ, whatever its motion before, so also
    /// at t = 0. Driven nodes have no step before the first: at t = 0 they take the acceleration of the first step's end.
    /// Forces are evaluated on the pieces of work that hold the places.
    pub fn accelerations(&self, places: &[usize]) -> Vec<[f64; D]> {
        let (model, grid) = (self.model, &self.model.grid);
        let piece_of = |place: &usize| (place - grid.body().start) / grid.piece();
        let mut wanted: Vec<usize> = places.iter().map(piece_of).collect();
        wanted.sort_unstable();
        wanted.dedup();
        let now = self.now();
        let on_piece = |&piece: &usize| {
            let range = grid.range(piece);
            let (mut force, mut acceleration) = (Field::zeros(range.len()), Field::zeros(range.len()));
            model.force_on(&now, piece, &mut force);
            accelerate_piece(model, 1.0, range.start, &force, &mut acceleration);
            (range.start, acceleration)
        };
        let pieces: Vec<(usize, Field)> = model.map_pieces(wanted.clone(), |piece| on_piece(&piece));
        let driven = self.driven_accelerations();
        let of = |place: &usize| {
            let (start, acceleration) = &pieces[wanted.partition_point(|piece| *piece < piece_of(place))];
            std::array::from_fn(|axis| {
                let place = place + axis * grid.stride();
                driven.get(&place).copied().unwrap_or_else(|| acceleration[place - start])
            })
        };
        places.iter().map(of).collect()
    }

    /// Accelerations of driven nodes, by place.
    fn driven_accelerations(&self) -> BTreeMap<usize, f64> {
        if self.model.constraints.is_empty() {
            return BTreeMap::new();
        }
        let square = self.time_step * self.time_step;
        let at = |step: u64| {
            let (time, mut increment) = (step as f64 * self.time_step, self.increment.clone());
            for constraint in &self.model.constraints {
                constraint.hold(time, Window::from(&self.displacement), &mut increment, 0);
            }
            increment
        };
        let next = at(self.step + 1);
        let second = (self.step == 0).then(|| at(2));
        let of = |&place: &usize| {
            let acceleration = match &second {
                Some(second) => (second[place] - 2.0 * next[place]) / square,
                None => (next[place] - self.increment[place]) / square,
            };
            (place, acceleration)
        };
        self.model.constraints.iter().flat_map(|constraint| constraint.places()).map(of).collect()
    }

    /// The model that moves.
    pub fn model(&self) -> &'m Model<D> {
        self.model
    }

    /// The state in the terms of forces.
    pub fn now(&self) -> Now<'_> {
        Now {
            displacement: Window::from(&self.displacement),
            increment: Window::from(&self.increment),
            time: self.time(),
            time_step: self.time_step,
            broken: &self.broken,
        }
    }

    /// The bonds that have broken so far.
    pub fn broken(&self) -> &Broken {
        &self.broken
    }

    /// Marches on to a step. Nothing looks at the body in between.
    pub fn advance_to(&mut self, step: u64) {
        if self.sums.len() == 1 {
            return self.pass_to(step);
        }
        // One worker goes from pass to pass and is not called anew for each.
        rayon::scope(|_| self.pass_to(step));
    }

    /// Steps of a pass over the body where nothing looks at it for as many: one where bonds may break, or where its first
    /// rows follow its last.
    pub fn steps_per_pass(&self) -> usize {
        let one = self.model.breaking.is_some() || self.model.edges.repeats_pieces();
        if one { 1 } else { STEPS_PER_PASS }
    }

    /// Pass after pass.
    fn pass_to(&mut self, step: u64) {
        let most = self.steps_per_pass();
        while self.step < step {
            let left = usize::try_from(step - self.step).unwrap_or(most);
            self.pass(left.min(most));
            self.commit();
        }
    }

    /// Up to so many steps in one pass.
    fn pass(&mut self, steps: usize) {
        let model = self.model;
        let grid = &model.grid;
        let schedule = Schedule::new(grid.pieces(), grid.lag(), steps, self.sums.len());
        let pass = Pass {
            model,
            broken: &self.broken,
            alone: &self.alone,
            ghosts: &self.ghosts,
            time_step: self.time_step,
            step: self.step,
            displacement: [Shared::new(&mut self.displacement), Shared::new(&mut self.other)],
            increment: Shared::new(&mut self.increment),
        };
        pass.run(&schedule, &mut self.sums);
        self.step += schedule.levels as u64;
        if schedule.levels % 2 == 1 {
            std::mem::swap(&mut self.displacement, &mut self.other);
        }
        if model.edges.repeats_pieces() {
            model.fill_ghosts(&mut self.displacement);
        }
    }

    /// One step, with every force booked. The same bits as without.
    pub fn advance_booked(&mut self, ledger: &mut Ledger<D>) {
        let mut force = std::mem::take(&mut self.other);
        ledger.sum_forces(self.model, &self.now(), &mut force);
        let before = ledger.remember(&self.increment);
        self.move_on(&force);
        ledger.book(self.model, before, &force, &self.now());
        force.copy_from_slice(&self.displacement);
        self.other = force;
        if let Some(before) = self.commit() {
            ledger.release(self.model, &self.now(), &before);
        }
    }

    /// The one moment at which bonds break: a step is done and the next has not begun. What was broken before, where that
    /// changes.
    fn commit(&mut self) -> Option<Broken> {
        let breaking = self.model.breaking.as_ref()?;
        let mut broken = std::mem::replace(&mut self.broken, Broken::none().clone());
        let before = breaking.commit(&self.now(), &mut broken);
        self.broken = broken;
        before
    }

    /// The second half of a step, the force being known.
    fn move_on(&mut self, force: &[f64]) {
        accelerate(self.model, self.time_step * self.time_step, force, &mut self.increment);
        self.step += 1;
        let next = self.time();
        for constraint in &self.model.constraints {
            constraint.hold(next, Window::from(&self.displacement), &mut self.increment, 0);
        }
        let increment = &self.increment;
        let (start, piece) = (self.model.grid.body().start, self.model.grid.piece());
        self.model.each_piece(&mut self.displacement, |index, u| {
            let from = start + index * piece;
            add(u, &increment[from..from + u.len()]);
        });
        self.model.fill_ghosts(&mut self.displacement);
    }

    /// Whether every displacement is a number.
    pub fn is_finite(&self) -> bool {
        all_finite(&self.displacement)
    }
}

/// The only term that acts on a piece, where there is one and no constraint.
fn alone<const D: usize>(model: &Model<D>, piece: usize) -> Option<usize> {
    let range = model.grid.range(piece);
    let held = |places: &[usize]| places.iter().any(|place| range.contains(place));
    if model.constraints.iter().any(|constraint| held(constraint.places())) {
        return None;
    }
    let mut acting = (0..model.forces().len()).filter(|&index| model.forces()[index].acts_on(piece));
    acting.next().filter(|_| acting.next().is_none())
}

fn add(to: &mut [f64], what: &[f64]) {
    to.iter_mut().zip(what).for_each(|(to, what)| *to += what);
}

/// d ← d + scale/ρ F.
fn accelerate<const D: usize>(model: &Model<D>, scale: f64, force: &[f64], increment: &mut [f64]) {
    let (start, piece) = (model.grid.body().start, model.grid.piece());
    model.each_piece(increment, |index, d| {
        let start = start + index * piece;
        accelerate_piece(model, scale, start, &force[start..start + d.len()], d);
    });
}

/// The same on a piece that starts at a place.
fn accelerate_piece<const D: usize>(
    model: &Model<D>,
    scale: f64,
    start: usize,
    force: &[f64],
    increment: &mut [f64],
) {
    model.isa.run(Accelerate { inertia: &model.inertia, scale, start, force, increment });
}
