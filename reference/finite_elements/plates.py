"""The cracked plates: geometry, material, symmetry, loads and the instants at which their histories are written.

Both plates are cut to a quarter, which is exact. The model has its origin at the right tip, so the left side x = -a is
the middle of the plate and the lower edge its crack line.
"""

import math
from dataclasses import dataclass

from .elements import Material
from .mesh import Rectangle, Sizes

MESHES = ("coarser", "coarse", "standard", "fine")


@dataclass(frozen=True)
class Plate:
    """A plate with a central crack of half length `half_crack` (mm).

    mode: 1 or 2; held: (side, component) pairs that symmetry holds at zero; loads: name -> {side: traction}, unit
    tractions; rise: full width of the smoothing, us; first and interval: instants written, us; samples: how many;
    sizes: triangle edges far from the tip in mm, one per name of MESHES; header: columns of the file.
    """

    file: str
    mode: int
    rectangle: Rectangle
    half_crack: float
    material: Material
    held: tuple
    loads: dict
    rise: float
    first: float
    samples: int
    sizes: dict
    header: str

    @property
    def interval(self):
        """Time between two rows of the file, us."""
        return 8.0 * self.first

    @property
    def unit(self):
        """K of the unit load in an infinite plate, GPa sqrt(mm)."""
        return math.sqrt(math.pi * self.half_crack)

    @property
    def domains(self):
        """Radii of the domains of the interaction integral, mm."""
        return [0.5 * self.half_crack, 0.7 * self.half_crack, 0.9 * self.half_crack]

    def mesh_sizes(self, name):
        """Sizes of the mesh called `name`: triangles at the tip a quarter as long as far away."""
        far = self.sizes[name]
        return Sizes(far, 0.25 * far)

    def time_step(self, name):
        """us. An odd part of twice `first`, so that the instants written are middles of steps."""
        return 2.0 * self.first / {"coarser": 1, "coarse": 1, "standard": 3, "fine": 3}[name]


def tension():
    """20 x 40 mm, crack 2a = 4.8 mm across the width, step tension on both short ends (y = +-20 mm).

    Mirror symmetry about both axes of the crack: u_x = 0 on x = -a, u_y = 0 on the ligament.
    """
    material = Material(young=200.0, poisson=0.25, density=5.0)
    return Plate(
        file="chen_plate_mode1_nu025.csv",
        mode=1,
        rectangle=Rectangle(left=2.4, right=7.6, height=20.0),
        half_crack=2.4,
        material=material,
        held=(("left", "x"), ("ligament", "y")),
        loads={"ends": {"top": (0.0, 1.0)}},
        rise=0.2,
        first=0.01225 / material.dilatational_speed,
        samples=679,
        sizes={"coarser": 0.5, "coarse": 0.35, "standard": 0.22, "fine": 0.14},
        header="t_us,k1_over_sigma_sqrt_pi_a_raw,k1_over_sigma_sqrt_pi_a_rise_0.2us,"
               "estimated_error_of_rise_0.2us",
    )


def shear():
    """104 x 40 mm, crack 2a = 24 mm along the length, step shear on the long edges, with and without the short ones.

    The displacements change sign with either mirror: u_x is odd in y, u_y odd in the distance from the middle, so that
    u_y = 0 on x = -a and u_x = 0 on the ligament. A rotation as a whole is free, as it is in the plate.
    """
    material = Material(young=73.5, poisson=0.25, density=2.45)
    return Plate(
        file="mode2_plate_104x40.csv",
        mode=2,
        rectangle=Rectangle(left=12.0, right=40.0, height=20.0),
        half_crack=12.0,
        material=material,
        held=(("left", "y"), ("ligament", "x")),
        loads={"top_bottom": {"top": (1.0, 0.0)}, "four_edges": {"top": (1.0, 0.0), "right": (0.0, 1.0)}},
        rise=0.4,
        first=0.021875 / material.dilatational_speed,
        samples=693,
        sizes={"coarser": 1.0, "coarse": 0.7, "standard": 0.45, "fine": 0.3},
        header="t_us,k2_top_bottom_over_tau_sqrt_pi_a_raw,k2_top_bottom_rise_0.4us,estimated_error_top_bottom,"
               "k2_four_edges_raw,k2_four_edges_rise_0.4us,estimated_error_four_edges",
    )


PLATES = {"tension": tension, "shear": shear}
