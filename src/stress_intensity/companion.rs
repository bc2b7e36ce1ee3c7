//! Inertia near a tip: the field that an accelerating term drives, (λ+µ)∇∇·c + µ∇²c = ρ u with free faces.
//!
//! Where term n has the amplitude a(t), the motion is u = a U + ä C + … with C ~ r^{n/2 + 2} the companion of U: a static
//! series alone lacks it. With w = u_x + iu_y the equation reads ∂/∂z* [(2/(κ−1)) Re ∂w/∂z + ∂w/∂z] = ρ/(4µ) w_U, so both
//! integrations are of powers: with G = ∫w_U dz*, ∂w/∂z = ρ/(4µ(κ+1)) (κ G − G*). What is left on the faces is taken away
//! by a ψ* = z*^s. A multiple of term n + 4, which C may contain as well, is left to that term.

use super::eigenfunction::{Field, Monomial};
use super::{Elastic, Mode};

/// The companion of a field, in m per m/s² of it. Powers as in Williams' terms n ≥ −1 and their companions.
pub fn companion(elastic: &Elastic, field: &Field) -> Field {
    let scale = elastic.density / (4.0 * elastic.shear_modulus * (elastic.kappa + 1.0));
    // i* = −i: in mode II the conjugate of a field with factor i has factor −i.
    let sign = if field.mode == Mode::I { 1.0 } else { -1.0 };
    let mut monomials = Vec::new();
    for &Monomial { coefficient, power: p, conjugate_power: q } in &field.monomials {
        if coefficient == 0.0 {
            continue;
        }
        let integrated = scale * coefficient / (q + 1.0);
        monomials.push(Monomial {
            coefficient: elastic.kappa * integrated / (p + 1.0),
            power: p + 1.0,
            conjugate_power: q + 1.0,
        });
        monomials.push(Monomial {
            coefficient: -sign * integrated / (q + 2.0),
            power: q + 2.0,
            conjugate_power: p,
        });
    }
    let driven = Field { mode: field.mode, monomials };
    freed(elastic, driven)
}

/// Takes the traction off the faces by a ψ of the same power. The upper face bears either normal or shear stress only, as
/// does ψ's; the lower face follows by symmetry.
fn freed(elastic: &Elastic, mut field: Field) -> Field {
    let Some(first) = field.monomials.first() else { return field };
    let power = first.power + first.conjugate_power;
    let psi = Monomial { coefficient: 1.0, power: 0.0, conjugate_power: power };
    let on_face = |field: &Field| {
        let [_, normal, shear] = elastic.stress(field.gradient([-1.0, 0.0]));
        [normal, shear]
    };
    let (driven, unit) = (on_face(&field), on_face(&Field { mode: field.mode, monomials: vec![psi] }));
    let product = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
    let coefficient = -product(driven, unit) / product(unit, unit);
    field.monomials.push(Monomial { coefficient, ..psi });
    field
}

#[cfg(test)]
mod tests {
    use super::super::eigenfunction::term;
    use super::super::synthetic::imbalance;
    use super::*;

    const ELASTIC: Elastic = Elastic { shear_modulus: 2.5, kappa: 1.7, density: 3.0 };

    fn terms() -> impl Iterator<Item = Field> {
        (-1..=3).flat_map(|n| Mode::BOTH.map(|mode| term(&ELASTIC, n, mode)))
    }

    /// Differences of fourth order with h = 2e-3 at r ≈ 0.7: h⁴ times sixth derivatives and rounding 1e-16/h² are below 1e-8.
    #[test]
    fn the_companion_holds_the_equation_of_motion() {
        for field in terms() {
            let once = companion(&ELASTIC, &field);
            let twice = companion(&ELASTIC, &once);
            for (given, driven) in [(&field, &once), (&once, &twice)] {
                for x in [[0.3, 0.6], [-0.6, 0.4], [-0.5, -0.5], [0.7, -0.1]] {
                    let wanted = given.displacement(x).map(|u| ELASTIC.density * u);
                    let left = imbalance(&ELASTIC, |x| driven.displacement(x), wanted, x, 2e-3);
                    assert!(left < 1e-8 * libm::hypot(wanted[0], wanted[1]).max(0.1), "{field:?}: {left:e}");
                }
            }
        }
    }

    #[test]
    fn its_faces_are_free() {
        for field in terms() {
            for field in [companion(&ELASTIC, &field), companion(&ELASTIC, &companion(&ELASTIC, &field))] {
                let stress = |x| ELASTIC.stress(field.gradient(x));
                for x in [[-0.6, 0.0], [-0.6, -0.0], [-1.4, 0.0]] {
                    let [along, normal, shear] = stress(x);
                    let [a, b, c] = stress([-x[0], 0.3]);
                    let size = along.abs().max(a.abs()).max(b.abs()).max(c.abs());
                    assert!(normal.abs().max(shear.abs()) < 1e-14 * size, "{field:?} {x:?} {normal} {shear}");
                }
            }
        }
    }
}
