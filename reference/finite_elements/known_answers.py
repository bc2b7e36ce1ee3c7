"""The program held against known answers: cracks at rest (handbook) and Freund's suddenly loaded crack."""

import math
from dataclasses import dataclass

import numpy as np

from .elements import Material
from .march import smooth
from .mesh import Rectangle, Sizes
from .model import Model
from .plates import shear

# mu = lambda = 1: c_s = 1 and c_d = sqrt(3) mm/us.
MATERIAL = Material(young=2.5, poisson=0.25, density=1.0)
# Triangle edges over the half crack (statics) or over the height (Freund).
EDGE = {"coarse": 0.08, "standard": 0.05, "fine": 0.03}
# Allowed against Freund, front included: twice what dispersion of the mesh leaves there.
FRONT = {"coarse": 1e-2, "standard": 2.5e-3, "fine": 1e-3}


@dataclass(frozen=True)
class Answer:
    """What was compared, how far off it is and how far off it may be, both relative."""

    what: str
    difference: float
    allowed: float

    @property
    def holds(self):
        """False for NaN too."""
        return self.difference <= self.allowed

    def __str__(self):
        return (f"{'pass' if self.holds else 'FAIL'}  {self.what}: off by {100 * self.difference:.4f} %, "
                f"allowed {100 * self.allowed:g} %")


def against(what, found, known):
    """The answer of a crack at rest. Handbooks print five digits; the square of 2a/W = 0.01 is not yet infinite."""
    return Answer(f"{what}: {found:.5f}, known {known:g}", abs(found / known - 1.0), 5e-4)


def tension_strip(width_over_crack, height_over_width, edge):
    """K_I/(sigma sqrt(pi a)) at rest, central crack a = 1 mm, half width `width_over_crack` in mm; a quarter is meshed.

    The far triangles grow with the plate.
    """
    width = width_over_crack
    sizes = Sizes(far=max(2.0 * edge, 0.1 * width), tip=0.25 * edge, growth=2.0 * edge)
    model = Model(Rectangle(1.0, width - 1.0, height_over_width * width), sizes, MATERIAL, 1,
                  (("left", "x"), ("ligament", "y")), [{"top": (0.0, 1.0)}], [0.5, 0.9])
    return float(model.static().mean()) / math.sqrt(math.pi)


def shear_plate(edge):
    """K_II/(tau sqrt(pi a)) at rest of the 104 x 40 mm plate under pure shear on its four edges."""
    plate = shear()
    size = plate.half_crack * edge
    model = Model(plate.rectangle, Sizes(size, 0.25 * size), plate.material, 2, plate.held,
                  [plate.loads["four_edges"]], plate.domains)
    # Of the slowest motion, about (c_s / 100 mm)^2 = 1e-3 / us^2, a millionth.
    return float(model.static(foundation=1e-9).mean()) / plate.unit


def at_rest(name):
    """Answers of the cracks at rest on the mesh `name`."""
    edge = EDGE[name]
    return [
        against("K_I, infinite plate (square, 2a/W = 0.01)", tension_strip(100.0, 1.0, edge), 1.0),
        against("K_I, long strip, 2a/W = 0.2 (Isida)", tension_strip(5.0, 3.0, edge), 1.0246),
        against("K_I, long strip, 2a/W = 0.5 (Isida)", tension_strip(2.0, 3.0, edge), 1.1867),
        against("K_II, 104 x 40 mm, pure shear (stored static limit)", shear_plate(edge), 1.1806),
    ]


def freund(material, mode, times):
    """K in GPa sqrt(mm) of a semi-infinite crack hit at t = 0 by a plane wave of unit stress (GPa); times in us.

    Freund, Dynamic Fracture Mechanics (1990), section 2.5 (mode I) and 2.6 (mode II), plane strain.
    """
    nu, after = material.poisson, np.maximum(times, 0.0)
    if mode == 1:
        return 2.0 / (1.0 - nu) * np.sqrt(material.dilatational_speed * after * (1.0 - 2.0 * nu) / math.pi)
    return 2.0 * np.sqrt(2.0 * material.shear_speed * after / (math.pi * (1.0 - nu)))


def suddenly_loaded(mode, name):
    """The largest difference from Freund over the largest K.

    2 mm x 2 mm plate cracked to its middle, loaded on the two edges along the crack, rollers on the others, so that two
    plane waves meet on the crack at H/c: K is twice Freund's until a wave from the tip, or the reflected plane wave, is
    back from an edge. Both sides are smoothed by a rise of 0.2 H/c; the front itself is part of the comparison.
    """
    edge = EDGE[name]
    speed, load, ligament, rollers = {1: (MATERIAL.dilatational_speed, (0.0, 1.0), "y", "x"),
                                      2: (MATERIAL.shear_speed, (1.0, 0.0), "x", "y")}[mode]
    arrival, rise = 1.0 / speed, 0.2 / speed
    back = arrival + 2.0 / MATERIAL.dilatational_speed
    model = Model(Rectangle(1.0, 1.0, 1.0), Sizes(edge, 0.25 * edge), MATERIAL, mode,
                  (("ligament", ligament), ("left", rollers), ("right", rollers)), [{"top": load}], [0.5, 0.9])
    time_step = 0.1 * edge / speed
    times, values = model.step_response(time_step, int((back + rise) / time_step))
    found = smooth(times, values.mean(axis=1)[:, 0], rise)
    known = smooth(times, 2.0 * freund(MATERIAL, mode, times - arrival), rise)
    inside = times <= back - 0.5 * rise
    difference = np.abs(found - known)[inside].max() / known[inside].max()
    return Answer(f"Freund, mode {mode}, step smoothed over 0.2 H/c, largest difference over the peak",
                  float(difference), FRONT[name])


def answers(name):
    """All answers, one after the other, on the mesh `name`."""
    yield from at_rest(name)
    for mode in (1, 2):
        yield suddenly_loaded(mode, name)
