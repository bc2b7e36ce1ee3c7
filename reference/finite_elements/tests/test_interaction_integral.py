"""The interaction integral on exact fields: Williams' singular term, other terms, and a motion that accelerates."""

import unittest

import numpy as np

from ..elements import Material, displacement_basis
from ..interaction_integral import functionals, williams_gradient
from ..mesh import Rectangle, Sizes, cracked_rectangle
from .test_elements import nodal

MATERIAL = Material(young=200.0, poisson=0.25, density=5.0)
RADII = [0.8, 1.2, 1.8]


def singular(mode):
    """Displacements of K = 1 GPa sqrt(mm), in the trigonometric form of the textbooks."""
    kappa, mu = 3.0 - 4.0 * MATERIAL.poisson, MATERIAL.shear_modulus

    def field(x, y):
        r, half = np.hypot(x, y), 0.5 * np.arctan2(y, x)
        scale = np.sqrt(r / (2.0 * np.pi)) / (2.0 * mu)
        sine, cosine = np.sin(half), np.cos(half)
        if mode == 1:
            return (scale * cosine * (kappa - 1.0 + 2.0 * sine**2), scale * sine * (kappa + 1.0 - 2.0 * cosine**2))
        return (scale * sine * (kappa + 1.0 + 2.0 * cosine**2), -scale * cosine * (kappa - 1.0 - 2.0 * sine**2))

    return field


class InteractionIntegral(unittest.TestCase):
    """One mesh with some six rings of triangles in the smallest domain."""

    @classmethod
    def setUpClass(cls):
        cls.basis = displacement_basis(cracked_rectangle(Rectangle(2.0, 2.0, 2.0), Sizes(far=0.12, tip=0.03)))
        cls.parts = {mode: functionals(cls.basis, MATERIAL, mode, RADII) for mode in (1, 2)}

    def test_the_auxiliary_gradient_is_that_of_the_textbook_displacement(self):
        x, y = np.array([0.3, -0.2, -0.4, 0.1]), np.array([0.2, 0.5, 0.01, 0.7])
        step = 1e-6
        for mode in (1, 2):
            field = singular(mode)
            along_x = (np.array(field(x + step, y)) - field(x - step, y)) / (2 * step)
            along_y = (np.array(field(x, y + step)) - field(x, y - step)) / (2 * step)
            found = williams_gradient(MATERIAL, mode, x, y)
            np.testing.assert_allclose(found, np.stack([along_x, along_y], axis=1), rtol=1e-7, atol=1e-12)

    def test_k_of_the_singular_field_is_one(self):
        # Quarter points hold sqrt(r) along the spokes; interpolation elsewhere and quadrature leave 1e-6 here.
        for mode in (1, 2):
            displacement = nodal(self.basis, singular(mode))
            for value in self.parts[mode][0] @ displacement:
                self.assertAlmostEqual(value, 1.0, delta=5e-6)

    def test_rigid_motion_and_t_stress_have_no_k(self):
        # Of the symmetry of the mode each; fields that the elements hold exactly, so that quadrature of r^(-1/2)
        # remains, where the weight has a slope: 1e-9 of E sqrt(r), r = 1 mm.
        nu, bound = MATERIAL.poisson, 1e-9 * MATERIAL.young
        push = nodal(self.basis, lambda x, y: (1.0 + 0 * x, 0 * x))
        turn = nodal(self.basis, lambda x, y: (-y, 2.0 + x))
        t_stress = nodal(self.basis, lambda x, y: ((1 - nu) * x, -nu * y))
        for mode, field in ((1, push), (2, turn), (1, t_stress)):
            self.assertLess(np.abs(self.parts[mode][0] @ field).max(), bound)

    def test_inertia_makes_up_for_stress_that_is_not_in_equilibrium(self):
        # u_y = y^2 in the upper half, -y^2 in the lower: s_yy = 2 (lambda + 2 mu) |y| and s_xy = 0 leave the faces and
        # the ligament free, rho a_y = 2 (lambda + 2 mu). Nothing is singular: K_I = 0 on every domain, by the inertia
        # term alone. Quadrature of r^(-1/2) in the tip triangles leaves 1e-7.
        field = nodal(self.basis, lambda x, y: (0 * x, y**2))
        push = 2.0 * (MATERIAL.lame + 2.0 * MATERIAL.shear_modulus) / MATERIAL.density
        acceleration = nodal(self.basis, lambda x, y: (0 * x, push + 0 * y))
        on_displacement, on_acceleration = self.parts[1]
        without = on_displacement @ field
        together = without + on_acceleration @ acceleration
        self.assertGreater(np.abs(without).min(), 10.0)
        self.assertLess(np.abs(together).max(), 1e-6 * np.abs(without).max())


if __name__ == "__main__":
    unittest.main()
