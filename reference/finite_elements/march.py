"""Newmark's average acceleration (beta = 1/4, gamma = 1/2) under a step load, and histories under a smooth rise."""

import numpy as np
from scipy.sparse.linalg import splu


def factorise(matrix):
    """Solver of a sparse symmetric positive definite matrix (SuperLU; pivots stay on the diagonal)."""
    return splu(matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0,
                options={"SymmetricMode": True}).solve


def step_response(stiffness, mass, loads, on_displacement, on_acceleration, time_step, steps):
    """Linear functionals of the motion from rest under loads that act from t = 0 on.

    stiffness, mass: sparse (n, n); loads (n, l); on_displacement and on_acceleration (f, n): the functionals are
    on_displacement @ u + on_acceleration @ a. Returns times (steps,), the middle of each time step, and values
    (steps, f, l).

    Average acceleration is the midpoint rule: u_m = (u_0 + u_1)/2, a = (v_1 - v_0)/dt and M a + K u_m = F, so that the
    middle of a step is where the equation of motion holds, and no initial acceleration has to be guessed.
    """
    if steps < 1 or time_step <= 0:
        raise ValueError(f"{steps} steps of {time_step} us: both must be positive")
    quarter = 4.0 / time_step**2
    solve = factorise(stiffness + quarter * mass)
    displacement = np.zeros_like(loads)
    velocity = np.zeros_like(loads)
    values = np.empty((steps, on_displacement.shape[0], loads.shape[1]))
    for step in range(steps):
        middle = solve(loads + mass @ (quarter * displacement + (2.0 / time_step) * velocity))
        acceleration = quarter * (middle - displacement) - (2.0 / time_step) * velocity
        values[step] = on_displacement @ middle + on_acceleration @ acceleration
        displacement = 2.0 * middle - displacement
        velocity += time_step * acceleration
    return (np.arange(steps) + 0.5) * time_step, values


def smooth(times, values, rise):
    """Response to a load that rises over `rise`, centred on t = 0, from the step response.

    times (n,) evenly spaced from half a step on, values (n, ...), zero before. The rate of the load is a symmetric
    raised cosine of full width `rise`. The last rise/2 of the result is NaN: it needs a longer step response.
    """
    time_step = times[1] - times[0]
    reach = int(np.floor(0.5 * rise / time_step))
    if reach < 4:
        raise ValueError(f"a rise of {rise} us is not resolved by steps of {time_step} us: take shorter steps")
    lags = np.arange(-reach, reach + 1) * time_step
    weights = 1.0 + np.cos(2.0 * np.pi * lags / rise)
    weights /= weights.sum()
    padded = np.concatenate([np.zeros((reach, *values.shape[1:])), values,
                             np.full((reach, *values.shape[1:]), np.nan)])
    result = np.zeros_like(values)
    for shift, weight in enumerate(weights):
        result += weight * padded[shift:shift + len(values)]
    return result
