"""Histories of K of a plate: computed on one mesh, with the error that the next coarser mesh suggests, as a table."""

import time
from dataclasses import dataclass

import numpy as np

from .march import smooth
from .model import Model
from .plates import MESHES


@dataclass(frozen=True)
class Run:
    """One plate on one mesh; times (s,) in us, raw and smooth (s, loads) over unit * load.

    spread: largest difference between two domains in the smoothed histories over the peak.
    """

    times: np.ndarray
    raw: np.ndarray
    smooth: np.ndarray
    spread: float
    summary: str


def compute(plate, name):
    """The plate on the mesh `name` of MESHES."""
    start = time.perf_counter()
    model = Model(plate.rectangle, plate.mesh_sizes(name), plate.material, plate.mode, plate.held,
                  list(plate.loads.values()), plate.domains)
    time_step = plate.time_step(name)
    wanted = plate.first + plate.interval * np.arange(plate.samples)
    steps = int(np.ceil((wanted[-1] + 0.5 * plate.rise) / time_step)) + 2
    times, values = model.step_response(time_step, steps)
    values /= plate.unit
    smoothed = smooth(times, values, plate.rise)
    rows = np.rint(wanted / time_step - 0.5).astype(int)
    if not np.allclose(times[rows], wanted, rtol=1e-9):
        raise ValueError(f"the instants of {plate.file} are not middles of steps of {time_step} us")
    smoothed = smoothed[rows]
    peak = np.abs(smoothed.mean(axis=1)).max(axis=0)
    spread = float((np.ptp(smoothed, axis=1) / peak).max())
    summary = (f"{plate.file} {name}: edges {plate.sizes[name]} mm, {model.triangles} triangles, "
               f"{model.free.size} unknowns, {steps} steps of {1e3 * time_step:.4g} ns, "
               f"domains within {100 * spread:.4f} % of the peak, {time.perf_counter() - start:.0f} s")
    return Run(wanted, values[rows].mean(axis=1), smoothed.mean(axis=1), spread, summary)


def table(plate, name, tell=print):
    """Rows of the file (samples, columns) on the mesh `name`, and the next coarser one for the estimated error."""
    coarser = compute(plate, MESHES[MESHES.index(name) - 1])
    tell(coarser.summary)
    run = compute(plate, name)
    tell(run.summary)
    error = np.abs(run.smooth - coarser.smooth)
    columns = [run.times]
    for load in range(run.raw.shape[1]):
        columns += [run.raw[:, load], run.smooth[:, load], error[:, load]]
    return np.array(columns).T


def write(path, plate, rows):
    """The table as CSV, six digits; what is below 1e-12 of the load is zero."""
    with open(path, "w", encoding="ascii", newline="\n") as file:
        file.write(plate.header + "\n")
        for row in np.round(rows, 12) + 0.0:  # no minus zeros
            file.write(",".join(f"{value:.6g}" for value in row) + "\n")
