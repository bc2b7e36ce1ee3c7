"""The upper half of a cracked rectangle as matrices: held unknowns, loads, K; statics and step response of it."""

import numpy as np

from .elements import displacement_basis, edge_load, free_unknowns, mass, stiffness
from .interaction_integral import functionals
from .march import factorise, step_response
from .mesh import cracked_rectangle


class Model:
    """rectangle, sizes: see mesh; mode 1 or 2; held: (side, "x" or "y") pairs; tractions: a list of
    `{side: (t_x, t_y)}` in GPa, one per load; radii of the domains of the interaction integral in mm."""

    def __init__(self, rectangle, sizes, material, mode, held, tractions, radii):
        mesh = cracked_rectangle(rectangle, sizes)
        basis = displacement_basis(mesh)
        self.free = free_unknowns(basis, held)
        self.triangles = mesh.nelements
        self.stiffness = stiffness(basis, material)[self.free][:, self.free]
        self.mass = mass(basis, material)[self.free][:, self.free]
        self.loads = np.array([edge_load(basis, load)[self.free] for load in tractions]).T
        on_displacement, on_acceleration = functionals(basis, material, mode, radii)
        self.on_displacement = on_displacement[:, self.free]
        self.on_acceleration = on_acceleration[:, self.free]

    def static(self, foundation=0.0):
        """K (domains, loads) in GPa sqrt(mm) at rest.

        foundation: forces against displacement in units of the mass, 1/us^2. A small one stops the rotation that the
        held unknowns of a plate in shear leave free, and carries nothing when the loads are in equilibrium.
        """
        return self.on_displacement @ factorise(self.stiffness + foundation * self.mass)(self.loads)

    def step_response(self, time_step, steps):
        """Times (steps,) in us and K (steps, domains, loads) after the loads are put on at t = 0."""
        return step_response(self.stiffness, self.mass, self.loads, self.on_displacement, self.on_acceleration,
                             time_step, steps)
