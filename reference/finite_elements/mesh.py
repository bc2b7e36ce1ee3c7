"""Triangle meshes of a rectangle with a crack along its lower edge, quarter-point elements at the tip.

The tip is the origin, the crack the part x < 0 of the lower edge y = 0, the ligament the part x > 0.
Lengths are in mm throughout the program.
"""

import math
from dataclasses import dataclass, replace

import gmsh
import numpy as np
from skfem import MeshTri, MeshTri2


@dataclass(frozen=True)
class Rectangle:
    """-left < x < right, 0 < y < height, all in mm."""

    left: float
    right: float
    height: float


@dataclass(frozen=True)
class Sizes:
    """Edge lengths of the triangles in mm: `far` from the tip, `tip` at it; they grow by `growth` per mm between."""

    far: float
    tip: float
    growth: float = 0.2


# Triangles around the upper half of the tip.
SECTORS = 8


def cracked_rectangle(rectangle, sizes):
    """Six-node mesh with the sides `left`, `right`, `top`, `crack` and `ligament` named.

    Returns a skfem.MeshTri2; every edge is straight, the tip is a vertex of a fan of `SECTORS` triangles of
    radius `sizes.tip`, and the middle nodes of the edges that end there sit at a quarter of their length.
    """
    if not 0 < sizes.tip < min(rectangle.left, rectangle.right, rectangle.height):
        raise ValueError(f"tip size {sizes.tip} mm does not fit into {rectangle}: take a finer mesh")
    points, triangles = _triangulate(rectangle, sizes)
    mesh = quarter_points(MeshTri2.from_mesh(MeshTri(points, triangles)))
    near = 1e-9 * (rectangle.left + rectangle.right)
    return mesh.with_boundaries({
        "left": lambda x: x[0] < -rectangle.left + near,
        "right": lambda x: x[0] > rectangle.right - near,
        "top": lambda x: x[1] > rectangle.height - near,
        "crack": lambda x: (x[1] < near) & (x[0] < 0),
        "ligament": lambda x: (x[1] < near) & (x[0] > 0),
    })


def quarter_points(mesh):
    """The MeshTri2 with the middle nodes of all edges that end at the origin moved to a quarter of the edge from it."""
    corners = mesh.doflocs[:, mesh.facets]  # (2, 2 ends, edges)
    at_tip = np.hypot(*corners) == 0.0
    edges = np.flatnonzero(at_tip.any(axis=0))
    if edges.size == 0:
        raise ValueError("no vertex of the mesh is at the origin, so there is no tip")
    middle = mesh.dofs.facet_dofs[0, edges]
    places = mesh.doflocs.copy()
    places[:, middle] *= 0.5  # from a half of the edge to a quarter
    return replace(mesh, doflocs=places)


def _triangulate(rectangle, sizes):
    """Corner points (2, n) and triangles (3, m) from gmsh."""
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("General.NumThreads", 1)
        gmsh.model.add("rectangle")
        _describe(rectangle, sizes)
        gmsh.model.mesh.generate(2)
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
        corners = gmsh.model.mesh.getElementsByType(2)[1].reshape(-1, 3)
    finally:
        gmsh.finalize()
    order = np.argsort(tags)
    points = coordinates.reshape(-1, 3)[order, :2].T.copy()
    points[np.abs(points) < 1e-12] = 0.0
    return points, np.searchsorted(tags[order], corners).T.copy()


def _describe(rectangle, sizes):
    """Geometry and size field, in the open gmsh model: one surface per triangle of the fan, one for the rest."""
    geo, field, option = gmsh.model.geo, gmsh.model.mesh.field, gmsh.option
    tip = geo.addPoint(0.0, 0.0, 0.0)
    angles = np.linspace(0.0, math.pi, SECTORS + 1)
    rim = [geo.addPoint(sizes.tip * math.cos(a), sizes.tip * math.sin(a) if 0 < a < math.pi else 0.0, 0.0)
           for a in angles]
    spokes = [geo.addLine(tip, point) for point in rim]
    chords = [geo.addLine(a, b) for a, b in zip(rim, rim[1:])]
    for line in spokes + chords:
        geo.mesh.setTransfiniteCurve(line, 2)
    for i, chord in enumerate(chords):
        geo.addPlaneSurface([geo.addCurveLoop([spokes[i], chord, -spokes[i + 1]])])
    corners = [geo.addPoint(x, y, 0.0) for x, y in [
        (rectangle.right, 0.0), (rectangle.right, rectangle.height),
        (-rectangle.left, rectangle.height), (-rectangle.left, 0.0)]]
    outline = [rim[0], *corners, rim[-1]]
    sides = [geo.addLine(a, b) for a, b in zip(outline, outline[1:])]
    geo.addPlaneSurface([geo.addCurveLoop(sides + [-chord for chord in reversed(chords)])])
    geo.synchronize()

    size = field.add("MathEval")
    field.setString(size, "F", f"Min({sizes.far}, {sizes.tip} + {sizes.growth} * Sqrt(x*x + y*y))")
    field.setAsBackgroundMesh(size)
    for name in ["Mesh.MeshSizeExtendFromBoundary", "Mesh.MeshSizeFromPoints", "Mesh.MeshSizeFromCurvature"]:
        option.setNumber(name, 0)
    option.setNumber("Mesh.Algorithm", 6)  # frontal Delaunay: the most even triangles
