//! The wrong ingredients of work-precision studies, one each, in the scenes that are marched.

use super::convergence_faults::{OtherScene, aside, printed, soft, soft_when_fine};
use super::dsif_faults::Fault;
use crate::subject::{PdVerify, Subject};
use pd_verify::forces::Damping;
use pd_verify::record::{Failure, Record};
use pd_verify::scene::{Positive, Scene, StepRule};
use std::sync::Arc;

/// All of them, each with the studies in which it is looked for.
pub fn all() -> Vec<Fault> {
    fn fault(
        name: &'static str,
        studies: &'static [&'static str],
        subject: impl Subject + Send + 'static,
    ) -> Fault {
        Fault { name, studies, subject: Box::new(subject) }
    }
    vec![
        fault("calibration is forgotten", &["cost-plate"], OtherScene { bar: printed, plate: printed }),
        fault("the modulus is a tenth off", &["cost-bar"], OtherScene { bar: soft, plate: soft }),
        fault("pulses start half a cell aside", &["cost-bar"], OtherScene { bar: aside, plate: aside }),
        fault("fine bars are softer", &["cost-bar"], OtherScene { bar: soft_when_fine, plate: |_| () }),
        fault("all steps are half as long", &["cost-bar"], OtherScene { bar: halved, plate: |_| () }),
        fault("fine plates are softer", &["cost-crack"], OtherScene { bar: |_| (), plate: soft_when_fine }),
        fault("damping of rate 0 damps", &["cost-ablation"], Ablated(drag, |_| ())),
        fault("who takes snapshots shakes the plate", &["cost-ablation"], Ablated(shake, |_| ())),
        fault(
            "plans name nothing",
            &["cost-ablation"],
            Ablated(|_| (), |record| record.plan.avoidable.clear()),
        ),
        fault(
            "plans forget bytes",
            &["cost-ablation"],
            Ablated(|_| (), |record| record.plan.bytes_per_node -= 0.1),
        ),
    ]
}

/// One thing changed in what is marched, and in what is seen.
struct Ablated(fn(&mut Scene<2>), fn(&mut Record));

impl Subject for Ablated {
    fn march_plate(&self, scene: &Scene<2>) -> Result<Record, Failure> {
        let mut scene = scene.clone();
        (self.0)(&mut scene);
        let mut record = PdVerify.march_plate(&scene)?;
        (self.1)(&mut record);
        Ok(record)
    }
}

fn drag(scene: &mut Scene<2>) {
    for effect in &mut scene.effects {
        if effect.name() == "damping" && effect.neutral(f64::INFINITY).is_some() {
            *effect = Arc::new(Damping { rate_per_s: Positive(1.0) });
        }
    }
}

fn shake(scene: &mut Scene<2>) {
    if !scene.snapshots.is_empty() {
        scene.displacement[0].amplitude *= 1.0 + 1e-14;
    }
}

fn halved(scene: &mut Scene<1>) {
    match &mut scene.time.step {
        StepRule::Given { seconds, .. } => *seconds *= 0.5,
        StepRule::OfLimit(share) => *share *= 0.5,
    }
}
