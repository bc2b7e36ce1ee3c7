"""Six-node triangles of linear elasticity in plane strain: matrices, edge loads and the unknowns that are free.

Units of the whole program: mm, microsecond, GPa, g/cm^3 (GPa us^2/mm^2 = g/cm^3, speeds come out in mm/us = km/s).
"""

import math
from dataclasses import dataclass

import numpy as np
from skfem import Basis, BilinearForm, ElementTriP2, ElementVector, LinearForm
from skfem.helpers import ddot, dot, eye, grad, sym_grad, trace

COMPONENT = {"x": "u^1", "y": "u^2"}


@dataclass(frozen=True)
class Material:
    """Isotropic, plane strain: Young's modulus (GPa), Poisson's ratio, density (g/cm^3)."""

    young: float
    poisson: float
    density: float

    @property
    def shear_modulus(self):
        """GPa."""
        return self.young / (2.0 * (1.0 + self.poisson))

    @property
    def lame(self):
        """Lame's first constant, GPa."""
        return 2.0 * self.shear_modulus * self.poisson / (1.0 - 2.0 * self.poisson)

    @property
    def effective_young(self):
        """E/(1 - nu^2) in GPa: K^2 over it is the energy release rate."""
        return self.young / (1.0 - self.poisson**2)

    @property
    def dilatational_speed(self):
        """mm/us."""
        return math.sqrt((self.lame + 2.0 * self.shear_modulus) / self.density)

    @property
    def shear_speed(self):
        """mm/us."""
        return math.sqrt(self.shear_modulus / self.density)

    def stress(self, strain):
        """Stress (GPa) of a strain, arrays (2, 2, ...)."""
        return self.lame * eye(trace(strain), 2) + 2.0 * self.shear_modulus * strain


def displacement_basis(mesh):
    """Two-component quadratic displacements on a MeshTri2; Gauss points integrate polynomials of degree 6 exactly
    (mass of a straight triangle: 4), which leaves room for the curved map of the quarter-point triangles."""
    return Basis(mesh, ElementVector(ElementTriP2()), intorder=6)


def stiffness(basis, material):
    """Sparse (n, n), GPa per unit thickness."""

    @BilinearForm
    def form(u, v, _):
        return ddot(material.stress(sym_grad(u)), sym_grad(v))

    return form.assemble(basis).tocsc()


def mass(basis, material):
    """Consistent, sparse (n, n), g/cm^3 mm^2 per unit thickness."""

    @BilinearForm
    def form(u, v, _):
        return material.density * dot(u, v)

    return form.assemble(basis).tocsc()


def edge_load(basis, tractions):
    """Nodal forces (n,) of uniform tractions `{side: (t_x, t_y)}` in GPa on named sides."""
    total = np.zeros(basis.N)
    for side, (t_x, t_y) in tractions.items():

        @LinearForm
        def form(v, _):
            return t_x * v[0] + t_y * v[1]

        total += form.assemble(basis.boundary(side))
    return total


def free_unknowns(basis, held):
    """Indices of the unknowns left when `held`, pairs (side, "x" or "y"), are zero."""
    fixed = [basis.get_dofs(side).all([COMPONENT[component]]) for side, component in held]
    return np.setdiff1d(np.arange(basis.N), np.concatenate(fixed) if fixed else [])


def displacement_gradient(basis, displacement):
    """Array (2, 2, triangles, Gauss points): row i, column j is the derivative of u_i along x_j."""
    return grad(basis.interpolate(displacement))
