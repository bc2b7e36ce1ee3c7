//! The wrong ingredients of work-precision studies, one each, in the scenes that are marched.

use super::convergence_faults::{OtherScene, aside, printed, soft, soft_when_fine};
use super::dsif_faults::Fault;
use crate::subject::Subject;
use pd_verify::scene::{Scene, StepRule};

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
    ]
}

fn halved(scene: &mut Scene<1>) {
    match &mut scene.time.step {
        StepRule::Given { seconds, .. } => *seconds *= 0.5,
        StepRule::OfLimit(share) => *share *= 0.5,
    }
}
