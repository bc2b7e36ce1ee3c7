"""Phase and group speed of plane waves in the linear bond-based peridynamic continuum, to 20 digits.

Equation, z = k delta, M_n = integral of W(s) s^n over 0 < s < 1, A_n = integral of cos(theta)^(2n) over a turn:
    bar      (omega delta / v)^2   = 2 / M_1             * sum_{n>=1} (-1)^(n+1) z^(2n)/(2n)! M_(2n-1)
    plane P  (omega delta / c_d)^2 = 8 / (3 pi M_2)      * sum_{n>=1} (-1)^(n+1) z^(2n)/(2n)! M_(2n) A_(n+1)
    plane S  (omega delta / c_s)^2 = 8 / (pi M_2)        * sum_{n>=1} (-1)^(n+1) z^(2n)/(2n)! M_(2n) (A_n - A_(n+1))
(1 - cos expanded under the integral; the prefactor is the energy equivalence with E, plane stress or plane
strain). Terms reach e^z and cancel, so the working precision is 60 digits plus the z / ln 10 that cancel.

Run:     python3 make_continuum_dispersion.py > continuum_dispersion.csv    (mpmath 1.3; about a minute)
Digits:  at least 50 carried, 20 printed; k_horizon and p are the exact values of the printed doubles.
Check:   a second route (quadrature of the defining integral; closed forms at large z) on some 40 entries,
         to 1e-40; the script stops with an error where they differ.
"""

import sys

from mpmath import mp, mpf

WAVE_NUMBERS = [1e-8, 1e-6, 1e-4, 1e-2, 0.1, 0.5, 1.0, 2.0, 3.7, 5.0, 10.0, 20.0, 40.0, 100.0, 314.15,
                1000.0, 3333.3, 1e4]
KERNELS = ([("constant", None)] + [("gaussian", p) for p in (1e-6, 0.5, 1.0, 2.0, 3.0, 7.3)]
           + [("exponential", p) for p in (1.0, 3.0)] + [("conical", None), ("parabolic", None)])
BRANCHES = [(1, "P"), (2, "P"), (2, "S")]


def moments(kernel, p, last):
    """M_0 .. M_last. Gaussian and exponential: integration by parts downwards, where no digit is lost."""
    one = mpf(1)
    if kernel == "constant":
        return [one / (n + 1) for n in range(last + 1)]
    if kernel == "conical":
        return [one / ((n + 1) * (n + 2)) for n in range(last + 1)]
    if kernel == "parabolic":
        return [2 * one / ((n + 1) * (n + 3)) for n in range(last + 1)]
    step, rate = (2, 2 * mpf(p) ** 2) if kernel == "gaussian" else (1, mpf(p))
    edge = mp.exp(-mpf(p) ** 2) if kernel == "gaussian" else mp.exp(-mpf(p))
    result = [None] * (last + 1 + step)
    for top in range(last + 1, last + 1 + step):
        term, total, n = edge / (top + 1), mpf(0), top + 1
        while term > total * mpf(10) ** -mp.dps:
            total += term
            n += step
            term *= rate / n
        result[top] = total
    for n in range(last, -1, -1):
        result[n] = (rate * result[n + step] + edge) / (n + 1)
    return result[:last + 1]


def angular(last):
    """A_0 .. A_last."""
    result = [2 * mp.pi]
    for n in range(1, last + 1):
        result.append(result[-1] * (2 * n - 1) / (2 * n))
    return result


def terms_needed(z):
    return int(1.5 * z) + 60


def speeds(kernel, p, wave_number):
    """[(omega / (k c), d omega / d k / c)] for the branches, by the power series."""
    mp.dps = 60 + int(wave_number / 2.302) + 5
    z, last = mpf(wave_number), terms_needed(wave_number)
    moment, turn = moments(kernel, p, 2 * last), angular(last + 1)
    squares, slopes = [mpf(0)] * 3, [mpf(0)] * 3
    power = mpf(1)                                   # z^(2n-1) / (2n)!, signed
    for n in range(1, last + 1):
        power = z / 2 if n == 1 else -power * z * z / ((2 * n) * (2 * n - 1))
        weights = (moment[2 * n - 1], moment[2 * n] * turn[n + 1], moment[2 * n] * (turn[n] - turn[n + 1]))
        for branch, weight in enumerate(weights):
            term = power * weight
            squares[branch] += term
            slopes[branch] += 2 * n * term
        if n > wave_number and abs(power) < mpf(10) ** -60 * z:
            break
    factors = (2 / moment[1], 8 / (3 * mp.pi * moment[2]), 8 / (mp.pi * moment[2]))
    result = []
    for factor, square, slope in zip(factors, squares, slopes):
        omega = mp.sqrt(factor * square * z)
        result.append((omega / z, factor * slope / (2 * omega)))
    return result


def weight(kernel, p):
    return {"constant": lambda s: mpf(1), "gaussian": lambda s: mp.exp(-(mpf(p) * s) ** 2),
            "exponential": lambda s: mp.exp(-mpf(p) * s), "conical": lambda s: 1 - s,
            "parabolic": lambda s: 1 - s * s}[kernel]


def speed_by_quadrature(kernel, p, wave_number, dimension, branch):
    """omega / (k c) from the defining integral, panel by panel; the angular integral by Bessel functions."""
    mp.dps = 60
    z, w = mpf(wave_number), weight(kernel, p)
    panels = mp.linspace(0, 1, int(wave_number / 6) + 3)
    if dimension == 1:
        moment = mp.quad(lambda s: w(s) * s, panels)
        whole = mp.quad(lambda s: 2 * w(s) * mp.sin(z * s / 2) ** 2 / s, panels) if wave_number > 1e-3 else None
        factor = 2 / moment
    else:
        moment = mp.quad(lambda s: w(s) * s * s, panels)
        share = {"P": lambda x: 1 - 2 * (mp.besselj(0, x) - mp.besselj(1, x) / x),
                 "S": lambda x: 1 - 2 * mp.besselj(1, x) / x}[branch]
        whole = mp.pi * mp.quad(lambda s: w(s) * share(z * s), panels)
        factor = 8 / (mp.pi * moment * (3 if branch == "P" else 1))
    return mp.sqrt(factor * whole) / z


def speed_in_closed_form(wave_number, dimension, branch):
    """omega / (k c) of the constant kernel: cosine integral in the bar, Bessel integrals in the plane."""
    mp.dps = 60
    z = mpf(wave_number)
    if dimension == 1:
        return 2 * mp.sqrt(mp.euler + mp.log(z) - mp.ci(z)) / z
    mp.dps = 70 + int(wave_number / 2.302)
    whole_j0 = mp.hyp1f2(0.5, 1, 1.5, -z * z / 4)                    # integral of J0(z s) over s
    whole_j1 = whole_j0 - mp.besselj(1, z) / z                      # integral of J1(z s)/(z s), by parts
    share = 1 - 2 * (whole_j0 - whole_j1) if branch == "P" else 1 - 2 * whole_j1
    return mp.sqrt(24 * share / (3 if branch == "P" else 1)) / z


def demand(name, one, other):
    if abs(one / other - 1) > mpf(10) ** -40:
        sys.exit(f"{name}: {mp.nstr(one, 45)} by the series, {mp.nstr(other, 45)} by the second route")


def cross_check():
    for kernel, p in KERNELS:
        for z in (0.5, 40.0):
            series = speeds(kernel, p, z)
            demand((kernel, p, z), series[0][0], speed_by_quadrature(kernel, p, z, 1, "P"))
        series = speeds(kernel, p, 3.7)
        for (dimension, branch), value in zip(BRANCHES, series):
            if dimension == 2 and kernel in ("constant", "gaussian"):
                demand((kernel, p, branch), value[0], speed_by_quadrature(kernel, p, 3.7, dimension, branch))
    demand("gaussian, 314.15", speeds("gaussian", 2.0, 314.15)[0][0],
           speed_by_quadrature("gaussian", 2.0, 314.15, 1, "P"))
    for z in (1.0, 100.0, 1000.0, 1e4):
        for (dimension, branch), value in zip(BRANCHES, speeds("constant", None, z)):
            if dimension == 1 or z <= 1000.0:
                demand(("constant", z, dimension, branch), value[0], speed_in_closed_form(z, dimension, branch))


def main():
    cross_check()
    print("dimension,branch,kernel,p,k_horizon,phase_speed_ratio,group_speed_ratio")
    for kernel, p in KERNELS:
        for wave_number in WAVE_NUMBERS:
            for (dimension, branch), (phase, group) in zip(BRANCHES, speeds(kernel, p, wave_number)):
                parameter = "" if p is None else repr(p)
                print(f"{dimension},{branch},{kernel},{parameter},{wave_number!r},"
                      f"{mp.nstr(phase, 20, strip_zeros=False)},{mp.nstr(group, 20, strip_zeros=False)}")


if __name__ == "__main__":
    main()
