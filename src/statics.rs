//! Rest under constant loads: F(u) = 0 by conjugate gradients, for linear bodies; no stiffness matrix is built.
//!
//! Driven nodes are held at their displacement of t = 0; what depends on the velocity does not act at rest. A free body under balanced loads keeps its mean displacement.

use crate::breaking::Broken;
use crate::field::{Field, Window};
use crate::forces::{Class, Now};
use crate::model::Model;
use thiserror::Error;

/// A body at rest.
#[derive(Debug, Clone, PartialEq)]
pub struct Rest {
    /// u in m, a field of the model's grid.
    pub displacement: Field,
    pub iterations: usize,
    /// ‖F‖ left over ‖F‖ at the start.
    pub residual: f64,
}

/// Why there is no rest.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NoRest {
    /// The exact law.
    #[error("finite rotations are not linear: conjugate gradients do not apply")]
    NotLinear,
    /// Too many iterations.
    #[error("not at rest after {iterations} iterations: a force of {residual:e} of the first is left")]
    NotConverged { iterations: usize, residual: f64 },
}

/// Solves from u = 0 until ‖F‖ has fallen by `tolerance`, in at most `most` iterations.
pub fn rest<const D: usize>(model: &Model<D>, tolerance: f64, most: usize) -> Result<Rest, NoRest> {
    if !model.linear {
        return Err(NoRest::NotLinear);
    }
    let mut displacement = model.grid.field();
    let mut driven = model.grid.field();
    for constraint in &model.constraints {
        constraint.hold(0.0, Window::from(&displacement), &mut driven, 0);
    }
    let held: Vec<usize> =
        model.constraints.iter().flat_map(|constraint| constraint.places()).copied().collect();
    displacement.iter_mut().zip(driven.iter()).for_each(|(u, driven)| *u += driven);
    model.fill_ghosts(&mut displacement);

    let mut residual = model.grid.field();
    for class in [Class::Internal, Class::Load] {
        model.add_forces(model.of_class(class), &still(&displacement), &mut residual);
    }
    held.iter().for_each(|&place| residual[place] = 0.0);
    let mut direction = residual.clone();
    let mut image = model.grid.field();
    let start = dot(&residual, &residual);
    let mut left = start;
    for iterations in 0..most {
        if left <= start * tolerance * tolerance {
            return Ok(Rest { displacement, iterations, residual: relative(left, start) });
        }
        model.fill_ghosts(&mut direction);
        image.fill(0.0);
        model.add_forces(model.of_class(Class::Internal), &still(&direction), &mut image);
        held.iter().for_each(|&place| image[place] = 0.0);
        // The image is −K times the direction.
        let step = -left / dot(&direction, &image);
        for ((u, r), (p, a)) in
            displacement.iter_mut().zip(residual.iter_mut()).zip(direction.iter().zip(image.iter()))
        {
            *u += step * p;
            *r += step * a;
        }
        let next = dot(&residual, &residual);
        let turn = next / left;
        direction.iter_mut().zip(residual.iter()).for_each(|(p, r)| *p = r + turn * *p);
        left = next;
    }
    Err(NoRest::NotConverged { iterations: most, residual: relative(left, start) })
}

fn relative(left: f64, start: f64) -> f64 {
    if start == 0.0 { 0.0 } else { (left / start).sqrt() }
}

fn still(displacement: &[f64]) -> Now<'_> {
    Now {
        displacement: displacement.into(),
        increment: Window::NONE,
        time: 0.0,
        time_step: f64::NAN,
        broken: Broken::none(),
    }
}

/// In the order of the field, whatever the threads do.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
