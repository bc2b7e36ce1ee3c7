//! The tips at rest that a case needs: each lattice once.

use super::extraction::Extraction;
use super::setup::Setup;
use super::tip::{REACH, TipAtRest, TipField};
use crate::convergence::whole::resting;
use crate::question::Effort;
use crate::subject::Subject;
use pd_verify::forces::surface::Correction;
use pd_verify::lattice::Lattice;
use pd_verify::material::Body;
use pd_verify::plan::Plan;
use rayon::prelude::*;

/// Tips found at rest, by lattice and by how the tip stands between columns.
pub struct Tips {
    all: Vec<(Key, TipField)>,
}

type Key = (Lattice, Body, Correction, bool);

fn key(setup: &Setup) -> Key {
    (setup.lattice, setup.scene.body, setup.plate.surface, setup.plate.between_columns())
}

fn keys<'s>(setups: impl Iterator<Item = &'s Setup>) -> Vec<Key> {
    let mut keys = Vec::new();
    for key in setups.map(key) {
        if !keys.contains(&key) {
            keys.push(key);
        }
    }
    keys
}

impl Tips {
    /// Brings the tips of these lattices to rest.
    pub fn of<'s>(setups: impl Iterator<Item = &'s Setup>, subject: &dyn Subject) -> Result<Self, String> {
        let solve = |&key: &Key| {
            let (lattice, body, surface, between) = key;
            Ok((key, TipAtRest::new(lattice, (body, surface), between, REACH)?.solve(subject)?))
        };
        let all: Vec<Result<(Key, TipField), String>> = keys(setups).par_iter().map(solve).collect();
        Ok(Self { all: all.into_iter().collect::<Result<_, _>>()? })
    }

    /// What an extraction finds at a tip at rest under K = 1, in modes I and II; `None` where it looks too far.
    pub fn factors(&self, setup: &Setup, extraction: &Extraction) -> Option<[f64; 2]> {
        let (_, field) = self.all.iter().find(|(key, _)| *key == self::key(setup))?;
        // Radii in m are taken in the horizons of this lattice.
        let extraction = match extraction.radii(setup.tip.horizon) {
            Some(ring) => extraction.with(ring.outer / setup.tip.horizon, None),
            None => extraction.clone(),
        };
        field.factors(&extraction).ok()
    }

    /// The work of finding them.
    pub fn effort<'s>(setups: impl Iterator<Item = &'s Setup>) -> Effort {
        let mut total = Effort::default();
        for (lattice, body, surface, between) in keys(setups) {
            if let Ok(tip) = TipAtRest::new(lattice, (body, surface), between, REACH) {
                let side = tip.nodes()[0];
                for plan in tip.scenes().iter().filter_map(|scene| Plan::at_rest(scene).ok()) {
                    total += resting(&plan, side);
                }
            }
        }
        total
    }
}
