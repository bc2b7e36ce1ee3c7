"""Marching and smoothing against closed forms: one oscillator, ramps and steps."""

import unittest

import numpy as np
from scipy.sparse import csc_matrix

from ..march import smooth, step_response


class March(unittest.TestCase):
    """A mass of 2 on a spring of 8: omega = 2, under a force of 4."""

    def march(self, time_step):
        one = np.ones((1, 1))
        return step_response(csc_matrix(8.0 * one), csc_matrix(2.0 * one), 4.0 * one, np.array([[1.0], [0.0]]),
                             np.array([[0.0], [1.0]]), time_step, round(3.0 / time_step))

    def test_the_oscillator_follows_its_closed_form_to_second_order(self):
        errors = []
        for time_step in (0.02, 0.01):
            times, values = self.march(time_step)
            errors.append(np.abs(values[:, 0, 0] - 0.5 * (1.0 - np.cos(2.0 * times))).max())
            self.assertLess(np.abs(values[:, 1, 0] - 2.0 * np.cos(2.0 * times)).max(), 10 * time_step**2)
        # Halving the step quarters the error; 10 % for the term after it.
        self.assertAlmostEqual(errors[0] / errors[1], 4.0, delta=0.4)

    def test_smoothing_a_ramp_late_changes_nothing_and_a_step_becomes_the_rise(self):
        times = (np.arange(1000) + 0.5) * 0.01
        ramp = smooth(times, times, 1.0)
        late = (times > 1.0) & np.isfinite(ramp)
        np.testing.assert_allclose(ramp[late], times[late], rtol=1e-12)
        self.assertTrue(np.isnan(ramp[-1]) and np.isfinite(ramp[-51]))
        step = smooth(times, np.where(times > 5.0, 1.0, 0.0), 1.0)
        rising = np.abs(times - 5.0) < 0.5
        s = times[rising] - 5.0
        # Integral of 1 + cos(2 pi s) from -1/2; half a sample of 1 % is what a sampled step cannot tell: (pi/2 0.01)^2.
        np.testing.assert_allclose(step[rising], 0.5 + s + np.sin(2 * np.pi * s) / (2 * np.pi), atol=3e-4)

    def test_wrong_input_is_named(self):
        with self.assertRaisesRegex(ValueError, "shorter steps"):
            smooth(np.arange(10) + 0.5, np.zeros(10), 2.0)


if __name__ == "__main__":
    unittest.main()
