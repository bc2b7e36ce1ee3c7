//! Least squares with fields as unknowns, kept as weights: every amplitude is a linear functional of the motion.

use super::{Faces, Functional, Mode, Reading, Unreadable};
use nalgebra::DMatrix;

/// What has an amplitude in a fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unknown {
    /// Williams' term n (or the running crack's), of amplitude one as [`super::eigenfunction::term`] says.
    Term { n: i32, mode: Mode },
    /// The companion of a term: its amplitude is the term's second time derivative.
    Inertia { n: i32, mode: Mode },
    /// Uniform σ_yy, in Pa.
    FaceNormal,
    /// Uniform σ_xy, in Pa.
    FaceShear,
}

/// An unknown and its displacement for amplitude one at each node of a fit.
pub type Column = (Unknown, Vec<[f64; 2]>);

/// A condition number (of columns of length one) from which on rounding would show in K.
pub const WORST_CONDITION: f64 = 1e9;

/// A prepared fit.
#[derive(Debug, Clone)]
pub struct Fit {
    columns: Vec<Column>,
    amplitudes: Vec<Functional>,
    known: Known,
    condition: f64,
}

/// Fields taken off the displacement before the fit.
#[derive(Debug, Clone, Default)]
struct Known {
    /// Of unit σ_yy and σ_xy.
    faces: Option<[Vec<[f64; 2]>; 2]>,
    /// Companions, each with the amplitude read from the acceleration.
    driven: Vec<(Functional, Vec<[f64; 2]>)>,
}

impl Fit {
    /// Prepares the least-squares amplitudes of some columns over some nodes; all nodes weigh the same.
    pub fn new(nodes: &[usize], columns: Vec<Column>) -> Result<Self, Unreadable> {
        let unknowns = columns.len();
        if nodes.len() < unknowns {
            return Err(Unreadable::TooFewNodes { nodes: nodes.len(), unknowns });
        }
        let matrix =
            DMatrix::from_fn(2 * nodes.len(), unknowns, |row, column| columns[column].1[row / 2][row % 2]);
        let (inverse, condition) = least_squares(matrix)?;
        let amplitude = |unknown: usize| {
            let weight = |row: usize| inverse[(unknown, row)];
            let displacement =
                (0..nodes.len()).map(|node| [weight(2 * node), weight(2 * node + 1)]).collect();
            Functional { nodes: nodes.to_vec(), displacement, ..Functional::default() }
        };
        let amplitudes = (0..unknowns).map(amplitude).collect();
        Ok(Self { columns, amplitudes, known: Known::default(), condition })
    }

    /// Takes the uniform fields of a unit of σ_yy and σ_xy on the faces off the displacement first.
    pub(super) fn less_faces(mut self, fields: [Vec<[f64; 2]>; 2]) -> Self {
        for amplitude in &mut self.amplitudes {
            amplitude.faces = [0, 1].map(|face| -product(&amplitude.displacement, &fields[face]));
        }
        self.known.faces = Some(fields);
        self
    }

    /// Takes companions off the displacement first, each with an amplitude that is read from the acceleration at the
    /// nodes of the fit: `driven` holds functionals whose displacement weights are meant for the acceleration.
    pub(super) fn less_driven(mut self, driven: Vec<(Functional, Vec<[f64; 2]>)>) -> Self {
        for amplitude in &mut self.amplitudes {
            let mut weights = vec![[0.0; 2]; amplitude.nodes.len()];
            for (read, field) in &driven {
                let share = product(&amplitude.displacement, field);
                for (weight, w) in weights.iter_mut().zip(&read.displacement) {
                    weight[0] -= share * w[0];
                    weight[1] -= share * w[1];
                }
            }
            amplitude.acceleration = weights;
        }
        self.known.driven = driven;
        self
    }

    /// K_I and K_II.
    ///
    /// # Panics
    /// When term 1 is not among the unknowns.
    pub fn reading(&self) -> Reading {
        let k = |mode| self.amplitude(Unknown::Term { n: 1, mode }).expect("K is an unknown of every fit");
        Reading { modes: Mode::BOTH.map(|mode| k(mode).clone()) }
    }

    /// The amplitude of an unknown, `None` where the fit has no such unknown.
    pub fn amplitude(&self, unknown: Unknown) -> Option<&Functional> {
        let place = self.columns.iter().position(|(found, _)| *found == unknown)?;
        Some(&self.amplitudes[place])
    }

    /// The T-stress in Pa.
    pub fn t_stress(&self) -> Option<&Functional> {
        self.amplitude(Unknown::Term { n: 2, mode: Mode::I })
    }

    /// What is fitted.
    pub fn unknowns(&self) -> impl Iterator<Item = Unknown> + '_ {
        self.columns.iter().map(|(unknown, _)| *unknown)
    }

    /// Condition number of the fit, its columns scaled to length one.
    pub fn condition(&self) -> f64 {
        self.condition
    }

    /// How badly the fields describe a motion: length of what the fit leaves over length of the displacement, both less the
    /// fitted rigid motion. NaN at rest.
    pub fn residual(&self, displacement: &[[f64; 2]], acceleration: &[[f64; 2]], faces: Faces) -> f64 {
        let nodes = self.amplitudes.first().map_or(&[][..], |amplitude| &amplitude.nodes);
        let mut left: Vec<[f64; 2]> = nodes.iter().map(|&node| displacement[node]).collect();
        if let Some(fields) = &self.known.faces {
            take(&mut left, faces.normal, &fields[0]);
            take(&mut left, faces.shear, &fields[1]);
        }
        for (read, field) in &self.known.driven {
            take(&mut left, read.at(acceleration, &[], Faces::default()), field);
        }
        let is_rigid = |unknown: &Unknown| {
            matches!(unknown, Unknown::Term { n: 0, .. } | Unknown::Term { n: 2, mode: Mode::II })
        };
        let amplitudes: Vec<f64> =
            self.amplitudes.iter().map(|amplitude| amplitude.at(displacement, acceleration, faces)).collect();
        let mut shape = 0.0;
        for rigid in [true, false] {
            for ((unknown, field), amplitude) in self.columns.iter().zip(&amplitudes) {
                if is_rigid(unknown) == rigid {
                    take(&mut left, *amplitude, field);
                }
            }
            if rigid {
                shape = length(&left);
            }
        }
        length(&left) / shape
    }
}

/// Weights of data (columns) on least-squares unknowns (rows), and the condition number of the problem, its columns scaled
/// to length one, so that radii and moduli do not enter it.
pub(super) fn least_squares(mut matrix: DMatrix<f64>) -> Result<(DMatrix<f64>, f64), Unreadable> {
    let lengths: Vec<f64> = matrix.column_iter().map(|column| column.norm()).collect();
    for (mut column, length) in matrix.column_iter_mut().zip(&lengths) {
        column /= *length;
    }
    let qr = matrix.qr();
    let svd = qr.r().svd(true, true);
    let condition = svd.singular_values.max() / svd.singular_values.min();
    if condition.is_nan() || condition >= WORST_CONDITION {
        return Err(Unreadable::RankDeficient { unknowns: lengths.len(), condition });
    }
    let mut inverse = svd.pseudo_inverse(0.0).expect("both sides were asked for") * qr.q().transpose();
    for (mut row, length) in inverse.row_iter_mut().zip(&lengths) {
        row /= *length;
    }
    Ok((inverse, condition))
}

fn take(from: &mut [[f64; 2]], amplitude: f64, field: &[[f64; 2]]) {
    for (left, u) in from.iter_mut().zip(field) {
        left[0] -= amplitude * u[0];
        left[1] -= amplitude * u[1];
    }
}

fn product(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a[0] * b[0] + a[1] * b[1]).sum()
}

fn length(field: &[[f64; 2]]) -> f64 {
    product(field, field).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const K: Unknown = Unknown::Term { n: 1, mode: Mode::I };

    /// The mean of three numbers is their least-squares constant; residual by hand.
    #[test]
    fn a_constant_is_fitted_as_the_mean_and_the_residual_is_what_is_left() {
        let fit = Fit::new(&[2, 0, 1], vec![(K, vec![[2.0, 0.0]; 3])]).unwrap();
        let u = [[1.0, 5.0], [2.0, 0.0], [6.0, 0.0]];
        let mean = fit.amplitude(K).unwrap().at(&u, &[], Faces::default());
        assert!((mean - 1.5).abs() < 1e-15);
        assert!((fit.condition() - 1.0).abs() < 1e-14);
        // 1, 2, 6 less 3, with 5 across: √(4 + 1 + 9 + 25) of √(1 + 4 + 36 + 25).
        let wanted = (39.0_f64 / 66.0).sqrt();
        assert!((fit.residual(&u, &[], Faces::default()) - wanted).abs() < 1e-15);
        assert!(fit.t_stress().is_none());
    }

    #[test]
    fn unknowns_that_look_alike_and_data_that_are_not_numbers_are_refused() {
        let twin = Unknown::Term { n: 3, mode: Mode::I };
        let columns = vec![(K, vec![[1.0, 2.0]; 3]), (twin, vec![[0.5, 1.0]; 3])];
        assert!(matches!(Fit::new(&[0, 1, 2], columns), Err(Unreadable::RankDeficient { .. })));
        let broken = vec![(K, vec![[f64::NAN, 0.0]; 3])];
        assert!(matches!(Fit::new(&[0, 1, 2], broken), Err(Unreadable::RankDeficient { .. })));
        let few = vec![(K, vec![[1.0, 0.0]]), (twin, vec![[0.0, 1.0]])];
        assert!(matches!(Fit::new(&[0], few), Err(Unreadable::TooFewNodes { nodes: 1, unknowns: 2 })));
    }
}
