//! A tip at rest under K = 1, alone: what the nonlocal zone of a tip makes of every reading.
//!
//! Around a tip the only length is the horizon, so the field of a lattice at rest under a far K is the same for all
//! spacings when it is seen in units of δ. What a reading finds there, over the K that was put on, is one number for each
//! kernel, m, volume rule, mode and reading: its tip factor. Refining at fixed m does not change it, so a reading whose
//! factor is not 1 does not converge; divided by it, it does.

use super::extraction::{Extraction, Prepared};
use super::plate::BEFORE_TIP;
use crate::subject::Subject;
use pd_verify::constraints::HeldFrame;
use pd_verify::forces::surface::Correction;
use pd_verify::lattice::{Lattice, Stencil};
use pd_verify::material::{Body, Material};
use pd_verify::scene::{Initial, Notch, Scene, Shape, StepRule, Time};
use pd_verify::stress_intensity::fit::Fit;
use pd_verify::stress_intensity::williams::{FaceStress, Inertia, Williams};
use pd_verify::stress_intensity::{Annulus, Elastic, Faces, Functional, Mode, Sites, Tip, Unreadable};
use std::sync::Arc;

/// From the tip to the frame, in δ.
pub const REACH: f64 = 20.0;
/// Where the far K is read, in δ, up to this part of the way to the frame.
const FAR: (f64, f64) = (6.0, 0.85);
/// Highest term there.
const FAR_TERMS: usize = 8;

/// A tip in a square of lattice whose frame is held at the field of K = 1.
#[derive(Debug, Clone)]
pub struct TipAtRest {
    pub tip: Tip,
    elastic: Elastic,
    /// One scene per mode.
    scenes: [Scene<2>; 2],
}

/// The same, found at rest.
#[derive(Debug, Clone)]
pub struct TipField {
    tip: Tip,
    elastic: Elastic,
    /// Displacement of all nodes, per mode.
    fields: [Vec<[f64; 2]>; 2],
    /// K of each mode in its own field, far from the tip.
    far: [f64; 2],
}

impl TipAtRest {
    /// Makes the square ready; `between_columns` says how the tip stands, `reach` how far the frame is, in δ.
    pub fn new(
        lattice: Lattice,
        (body, surface): (Body, Correction),
        between_columns: bool,
        reach: f64,
    ) -> Result<Self, String> {
        let material = Material { youngs_modulus: 1.0, density: 1.0 };
        let elastic = Elastic::of(material, body).ok_or("a bar has no crack")?;
        let width = Stencil::<2>::new(lattice).map_err(|unusable| unusable.to_string())?.reach();
        let half = (reach * lattice.m).ceil() as usize;
        let columns = 2 * half + usize::from(!between_columns);
        let at = [0.5 * columns as f64, half as f64];
        let time = Time { duration: 1.0, step: StepRule::OfLimit(1.0) };
        let bare = Scene {
            surface,
            notches: vec![Notch { from: [0.0, at[1]], to: [at[0] - BEFORE_TIP, at[1]] }],
            ..Scene::bare(material, body, lattice, [columns, 2 * half], 1.0, time)
        };
        let scenes = Mode::BOTH.map(|mode| {
            let shape = Shape::NearTip { tip: at, mode, elastic };
            let fields: Vec<Initial<2>> =
                [0, 1].map(|component| Initial { component, amplitude: 1.0, shape: shape.clone() }).to_vec();
            Scene {
                effects: vec![Arc::new(HeldFrame { layers: width, fields: fields.clone() })],
                displacement: fields,
                ..bare.clone()
            }
        });
        let sites = Sites { nodes: bare.nodes, spacing: 1.0, first: at.map(|x| 0.5 - x) };
        Ok(Self { tip: Tip { sites, horizon: lattice.m, crack: at[0] }, elastic, scenes })
    }

    /// The constants by which its displacements are read.
    pub fn elastic(&self) -> Elastic {
        self.elastic
    }

    /// Nodes of the square.
    pub fn nodes(&self) -> [usize; 2] {
        self.tip.sites.nodes
    }

    pub fn scenes(&self) -> &[Scene<2>; 2] {
        &self.scenes
    }

    /// Lets it come to rest in both modes.
    pub fn solve(&self, subject: &dyn Subject) -> Result<TipField, String> {
        let [first, second] = &self.scenes;
        let (one, two) = rayon::join(|| subject.rest_plate(first), || subject.rest_plate(second));
        let fields = [one?, two?];
        if fields.iter().any(|field| field.len() != self.tip.sites.count()) {
            return Err("a tip at rest has other nodes than were asked for".into());
        }
        let fit = self.far_fit().map_err(|unreadable| unreadable.to_string())?;
        let far = [0, 1].map(|mode| of_mode(&fit.reading().modes[mode], &fields[mode]));
        Ok(TipField { tip: self.tip, elastic: self.elastic, fields, far })
    }

    /// Williams' series with its term r^(−1/2), far from the nonlocal zone.
    fn far_fit(&self) -> Result<Fit, Unreadable> {
        let (inner, share) = FAR;
        let annulus = Annulus { inner: inner * self.tip.horizon, outer: share * self.tip.sites.reach() };
        let williams = Williams {
            annulus,
            terms: FAR_TERMS,
            process_zone: true,
            clear_of_faces: 0.0,
            inertia: Inertia::Neglected,
            faces: FaceStress::Known,
        };
        williams.fit(&self.tip, &self.elastic)
    }
}

fn of_mode(functional: &Functional, field: &[[f64; 2]]) -> f64 {
    functional.at(
        field,
        &vec![[0.0; 2]; if functional.needs_acceleration() { field.len() } else { 0 }],
        Faces::default(),
    )
}

impl TipField {
    /// What a reading finds over the K that is there, for modes I and II.
    pub fn factors(&self, extraction: &Extraction) -> Result<[f64; 2], Unreadable> {
        let Prepared { reading, .. } = extraction.prepare(&self.tip, &self.elastic)?;
        Ok([0, 1].map(|mode| of_mode(&reading.modes[mode], &self.fields[mode]) / self.far[mode]))
    }
}
