"""Stress intensity factors from the dynamic interaction integral, in its domain form, as a linear functional.

With an auxiliary crack-tip field u', in equilibrium and free of traction on the faces, and a weight q that is 1 at the
tip and 0 at the rim of the domain A,
    I = integral over A of (s_ij u'_i,1 + s'_ij u_i,1 - s_kl e'_kl delta_1j) q_,j + rho a_i u'_i,1 q
      = 2 (K_I K'_I + K_II K'_II) / E',    E' = E/(1 - nu^2),
since the divergence of the bracket is rho a_i u'_i,1. The faces add nothing (no traction), nor does a ligament on a
line of symmetry, where u and u' have the same zero components; then the half domain is doubled.
"""

import numpy as np
from skfem import ElementTriP1, LinearForm
from skfem.helpers import grad, sym_grad

# Of a plate cut along the crack the model has one half.
HALVES = 2.0


def williams_gradient(material, mode, x, y):
    """Gradient (2, 2, ...) of the displacements (mm) of the singular field of K = 1 GPa sqrt(mm).

    mode 1 or 2; x, y arrays in mm with the crack on the negative x axis. Kolosov's 2 mu (u + i v) =
    kappa phi - z conj(phi') - conj(psi) with phi' = C/sqrt(z), C = (K_I - i K_II)/(2 sqrt(2 pi)), and psi' such that
    the faces are free: psi' = conj(C)/sqrt(z) - phi' - z phi''.
    """
    z = x + 1j * y
    kappa = 3.0 - 4.0 * material.poisson
    amplitude = {1: 1.0, 2: -1j}[mode] / (2.0 * np.sqrt(2.0 * np.pi))
    first = amplitude / np.sqrt(z)
    second = -0.5 * first / z
    psi = np.conj(amplitude) / np.sqrt(z) - first - z * second
    along_x = kappa * first - np.conj(first) - z * np.conj(second) - np.conj(psi)
    along_y = 1j * (kappa * first - np.conj(first) + z * np.conj(second) + np.conj(psi))
    gradient = np.array([[along_x.real, along_y.real], [along_x.imag, along_y.imag]])
    return gradient / (2.0 * material.shear_modulus)


def functional(basis, material, mode, outer):
    """Vectors g, h (n,) with K = g . u + h . a, K in GPa sqrt(mm), for the upper half of a (anti)symmetric plate.

    basis: see elements.displacement_basis; u (mm) and a (mm/us^2) all its unknowns; outer: radius of the domain in mm.
    The weight falls linearly from 1 at a third of `outer` to 0 there, at the vertices, and is linear in each triangle.
    """
    weights = basis.with_element(ElementTriP1())
    radius = np.hypot(*weights.doflocs)
    if np.count_nonzero(radius < outer) < 50:
        raise ValueError(f"fewer than 50 vertices lie within {outer} mm of the tip: refine the mesh")
    weight = weights.interpolate(np.clip((outer - radius) / (outer - outer / 3.0), 0.0, 1.0))
    auxiliary = williams_gradient(material, mode, *basis.global_coordinates())
    strain = 0.5 * (auxiliary + auxiliary.swapaxes(0, 1))
    auxiliary_stress = material.stress(strain)
    slope = grad(weight)

    @LinearForm
    def from_displacement(v, _):
        stress = material.stress(sym_grad(v))
        return (np.einsum("ij...,i...,j...->...", stress, auxiliary[:, 0], slope)
                + np.einsum("ij...,i...,j...->...", auxiliary_stress, grad(v)[:, 0], slope)
                - np.einsum("ij...,ij...,...->...", stress, strain, slope[0]))

    @LinearForm
    def from_acceleration(v, _):
        return material.density * np.einsum("i...,i...,...->...", v, auxiliary[:, 0], weight)

    scale = HALVES * 0.5 * material.effective_young
    return scale * from_displacement.assemble(basis), scale * from_acceleration.assemble(basis)


def functionals(basis, material, mode, radii):
    """The same for several domains: arrays (domains, n)."""
    pairs = [functional(basis, material, mode, outer) for outer in radii]
    return np.array([g for g, _ in pairs]), np.array([h for _, h in pairs])
