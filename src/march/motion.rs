//! How fast that is which moves in a march, as its own bonds see it: what leapfrog cannot carry shows here first.
//!
//! s² = ¼Δt² dᵀKd/dᵀMd, d = u(n) − u(n−1) of the nodes that are free, is the mean of (ωΔt/2)² over the modes that move,
//! weighted by their kinetic energies. In a linear body it never exceeds (Δt over the body's own limit)², whatever loads,
//! damping and driven nodes do: above 1 it proves that the step is too long. Leapfrog's invariant,
//! H = ½dᵀ(M/Δt² − K/4)d + ½ūᵀKū with ū = ½(u(n) + u(n−1)), says what that means: where s² > 1 motion counts as a negative
//! energy and grows without bound while H keeps still. With finite rotations K is the secant from u(n−1) to u(n).

use super::March;
use crate::field::{Field, Window, all_finite, largest};
use crate::forces::{Class, Now};
use crate::model::Inertia;

/// The motion of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Motion {
    /// ½ρV Σ v(n−½)² in J, without driven nodes.
    pub kinetic: f64,
    /// s²; NaN where the motion is no number, 0 where nothing moves.
    pub square: f64,
}

impl<const D: usize> March<'_, D> {
    /// The motion of the step done last, for the price of its forces. No bit of the march changes.
    pub fn motion(&mut self) -> Motion {
        let model = self.model;
        if !all_finite(&self.increment) {
            return Motion { kinetic: f64::INFINITY, square: f64::NAN };
        }
        let size = largest(&self.increment);
        if size == 0.0 {
            return Motion { kinetic: 0.0, square: 0.0 };
        }
        // A linear body is asked for K·d itself, so that no digit is lost where it is strained and hardly moves; squares of
        // what has grown far are no numbers.
        let scale = if model.linear { 1.0 / size } else { 1.0 };
        let mut driven: Vec<usize> =
            model.constraints.iter().flat_map(|constraint| constraint.places()).copied().collect();
        driven.sort_unstable();
        let mut trial = std::mem::take(&mut self.other);
        let (start, piece) = (model.grid.body().start, model.grid.piece());
        model.each_piece(&mut trial, |index, trial| {
            let from = start + index * piece;
            let (d, u) = (&self.increment[from..from + trial.len()], &self.displacement[from..]);
            if model.linear {
                trial.iter_mut().zip(d).for_each(|(trial, d)| *trial = scale * d);
            } else {
                trial.iter_mut().zip(d).zip(u).for_each(|((trial, d), u)| *trial = u - d);
            }
        });
        driven.iter().for_each(|&at| trial[at] = if model.linear { 0.0 } else { self.displacement[at] });
        model.fill_ghosts(&mut trial);
        let each = |piece: usize| self.of_piece(piece, &trial, scale, &driven);
        let pieces = model.map_pieces((0..model.grid.pieces()).collect(), each);
        let [mass, pull] = pieces.iter().fold([0.0; 2], |sum, piece| [sum[0] + piece[0], sum[1] + piece[1]]);
        trial.copy_from_slice(&self.displacement);
        self.other = trial;
        let square = self.time_step * self.time_step;
        let kinetic = 0.5 * model.cell_volume * mass / square / (scale * scale);
        Motion { kinetic, square: if mass > 0.0 { 0.25 * square * pull / mass } else { 0.0 } }
    }

    /// dᵀρd and dᵀKd of a piece; d is the increment times `scale`, 0 where nodes are driven.
    fn of_piece(&self, piece: usize, trial: &[f64], scale: f64, driven: &[usize]) -> [f64; 2] {
        let (model, range) = (self.model, self.model.grid.range(piece));
        let mut moved: Vec<f64> = self.increment[range.clone()].iter().map(|d| scale * d).collect();
        let from = driven.partition_point(|place| *place < range.start);
        let mine = driven[from..].iter().take_while(|place| **place < range.end);
        mine.for_each(|place| moved[place - range.start] = 0.0);
        let pulled = |now: Now<'_>| {
            let mut sum = Field::zeros(range.len());
            let internal = &model.forces()[model.of_class(Class::Internal)];
            internal.iter().for_each(|force| force.add(&now, piece, &mut sum));
            moved.iter().zip(&sum).map(|(d, force)| d * force).sum::<f64>()
        };
        let at_trial =
            pulled(Now { displacement: Window::from(trial), increment: Window::NONE, ..self.now() });
        let pull = if model.linear { -at_trial } else { at_trial - pulled(self.now()) };
        let mass = match &model.inertia {
            Inertia::Uniform(density) => density * moved.iter().map(|d| d * d).sum::<f64>(),
            Inertia::Diagonal(densities) => {
                moved.iter().zip(&densities[range.clone()]).map(|(d, density)| density * d * d).sum()
            }
        };
        [mass, pull]
    }
}
