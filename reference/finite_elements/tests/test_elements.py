"""Elements on a mesh with a quarter-point tip: patch test, rigid motion, mass, edge loads."""

import unittest

import numpy as np

from ..elements import (Material, displacement_basis, displacement_gradient, edge_load, free_unknowns, mass, stiffness)
from ..march import factorise
from ..mesh import SECTORS, Rectangle, Sizes, cracked_rectangle

MATERIAL = Material(young=200.0, poisson=0.25, density=5.0)
SHAPE = Rectangle(left=2.0, right=3.0, height=4.0)


def nodal(basis, field):
    """Nodal values of field(x, y) -> (u_x, u_y)."""
    values = np.empty(basis.N)
    points = basis.doflocs
    for component in (0, 1):
        unknowns = basis.get_dofs(elements=True).all([f"u^{component + 1}"])
        values[unknowns] = field(*points[:, unknowns])[component]
    return values


class Elements(unittest.TestCase):
    """One mesh, all tests."""

    @classmethod
    def setUpClass(cls):
        cls.mesh = cracked_rectangle(SHAPE, Sizes(far=0.5, tip=0.2))
        cls.basis = displacement_basis(cls.mesh)
        cls.stiffness = stiffness(cls.basis, MATERIAL)

    def test_quarter_points_are_where_they_should_be(self):
        corners = self.mesh.doflocs[:, self.mesh.facets]
        lengths = np.hypot(*corners)
        spokes = np.flatnonzero((lengths == 0.0).any(axis=0))
        self.assertEqual(spokes.size, SECTORS + 1)
        middle = np.hypot(*self.mesh.doflocs[:, self.mesh.dofs.facet_dofs[0, spokes]])
        np.testing.assert_allclose(middle, 0.25 * lengths[:, spokes].max(axis=0), rtol=1e-14)

    def test_a_linear_field_given_at_the_rim_is_met_inside(self):
        # Constant strain must be exact on any mesh, quarter-point triangles included; 1e-10 is rounding.
        slope = np.array([[2e-3, -1e-3], [3e-3, 4e-3]])
        exact = nodal(self.basis, lambda x, y: slope @ np.array([x, y]))
        sides = [(side, c) for side in ("left", "right", "top", "crack", "ligament") for c in "xy"]
        free = free_unknowns(self.basis, sides)
        found = np.where(np.isin(np.arange(self.basis.N), free), 0.0, exact)
        found[free] = factorise(self.stiffness[free][:, free])(-(self.stiffness @ found)[free])
        np.testing.assert_allclose(found, exact, atol=1e-10 * np.abs(exact).max())
        gradient = displacement_gradient(self.basis, found)
        np.testing.assert_allclose(gradient, np.broadcast_to(slope[:, :, None, None], gradient.shape), atol=1e-12)

    def test_a_linear_field_stores_the_energy_of_its_strain(self):
        # Uniaxial strain e stores (lambda + 2 mu) e^2 / 2 per area; by hand 240 GPa.
        field = nodal(self.basis, lambda x, y: (0.01 * x, 0.0 * y))
        self.assertAlmostEqual(field @ self.stiffness @ field, 240.0 * 1e-4 * 20.0, delta=1e-9)

    def test_rigid_motions_need_no_force(self):
        for field in (lambda x, y: (1.0 + 0 * x, 0 * x), lambda x, y: (0 * x, 1.0 + 0 * x), lambda x, y: (-y, x)):
            self.assertLess(np.abs(self.stiffness @ nodal(self.basis, field)).max(), 1e-10 * 200.0)

    def test_the_mass_is_the_density_times_the_area(self):
        matrix = mass(self.basis, MATERIAL)
        unit = nodal(self.basis, lambda x, y: (1.0 + 0 * x, 0 * x))
        self.assertAlmostEqual(unit @ matrix @ unit, 5.0 * 20.0, delta=1e-10)
        # A turn about the tip: rho times the polar moment of the rectangle, ((8 + 27) 4 + 5 * 64) / 3.
        turn = nodal(self.basis, lambda x, y: (-y, x))
        self.assertAlmostEqual(turn @ matrix @ turn, 5.0 * (35.0 * 4.0 + 5.0 * 64.0) / 3.0, delta=1e-9)

    def test_an_edge_load_adds_up_to_traction_times_length(self):
        load = edge_load(self.basis, {"top": (0.5, 2.0), "right": (0.0, 1.0)})
        along_x = nodal(self.basis, lambda x, y: (1.0 + 0 * x, 0 * x))
        along_y = nodal(self.basis, lambda x, y: (0 * x, 1.0 + 0 * x))
        self.assertAlmostEqual(load @ along_x, 0.5 * 5.0, delta=1e-12)
        self.assertAlmostEqual(load @ along_y, 2.0 * 5.0 + 1.0 * 4.0, delta=1e-12)


if __name__ == "__main__":
    unittest.main()
