//! Figures like those of the studies, and the awkward ones.

use crate::report::plot::{
    Axis, Category, Dot, Dots, Figure, Guide, HeatMap, Lines, Polar, Raster, Series, Stack, StackedBars,
};
use std::f64::consts::PI;

fn sampled(lo: f64, hi: f64, f: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let n = 200;
    (0..=n).map(|i| lo + (hi - lo) * f64::from(i) / f64::from(n)).map(|x| (x, f(x))).collect()
}

/// Seven schemes over the wavenumber, one unstable beyond a point.
pub fn dispersion() -> Figure {
    let dx = 0.01;
    let mut series = vec![Series::reference("local theory", vec![(0.0, 0.0), (PI / dx, PI / dx)])];
    for m in 1..=6 {
        let m = f64::from(m);
        let points = sampled(0.0, PI / dx, |k| {
            let w = 2.0 / dx * (0.5 * k * dx).sin() / (1.0 + 0.12 * m * (k * dx / PI).powi(2));
            if m == 6.0 && k > 250.0 { f64::NAN } else { w }
        });
        series.push(Series::line(format!("constant kernel, m = {m}"), points));
    }
    let panel = Lines::new(
        Axis::linear("wavenumber k (1/m)"),
        Axis::linear("angular frequency over wave speed ω/c (1/m)").range(0.0, 220.0),
        series,
    )
    .guide(Guide::Vertical { at: PI / dx, label: "Nyquist π/Δx".into() })
    .guide(Guide::Vertical { at: PI / 0.03, label: "π/δ".into() })
    .band(0.0, 62.8, "resolved: λ ≥ 10 Δx");
    Figure::new("dispersion", "Dispersion of a bar, Δx = 1 cm", "Seven curves.", panel)
}

/// Errors over five levels in three norms with two slopes.
pub fn convergence() -> Figure {
    let levels =
        |c: f64, p: f64| (0..5).map(|i| 0.02 * 0.5_f64.powi(i)).map(|h| (h, c * h.powf(p))).collect();
    let panel = Lines::new(
        Axis::log("spacing Δx (m)"),
        Axis::log("relative error (1)"),
        vec![
            Series::both("L1 norm", levels(8.0, 1.95)),
            Series::both("L2 norm", levels(12.0, 1.9)),
            Series::both("L∞ norm, constant kernel, full volumes, not calibrated", levels(3.0, 1.02)),
        ],
    )
    .guide(Guide::Slope { order: 2.0, label: "order 2".into() })
    .guide(Guide::Slope { order: 1.0, label: "order 1".into() })
    .guide(Guide::Horizontal { at: 1e-4, label: "bound 10⁻⁴".into() });
    Figure::new("convergence", "Convergence: the error falls as Δx²", "Three norms.", panel)
}

/// Two branches beside each other, three horizons each.
pub fn anisotropy() -> Figure {
    let branch = |sign: f64| -> Vec<Series> {
        (2..5)
            .map(f64::from)
            .map(|m| {
                let f = |a: f64| sign * (1.2 / m) * (1.0 + 0.5 * (4.0 * a.to_radians()).cos()) - 0.1;
                Series::line(format!("m = {m}"), sampled(0.0, 360.0, f))
            })
            .collect()
    };
    let radial = || Axis::linear("phase error (%)");
    Figure::new(
        "anisotropy",
        "Phase error over direction at kΔx = 0.5",
        "Two branches.",
        Polar::new(radial(), branch(-1.0)).titled("P"),
    )
    .panel(Polar::new(radial(), branch(1.0)).titled("S"))
    .columns(2)
}

/// Six kernels by nine horizons, two without a value.
pub fn orders() -> Figure {
    let x = (2..11).map(|m| format!("m = {m}")).collect();
    let y = ["constant", "conical", "parabolic", "gaussian p=2", "gaussian p=3", "exponential p=4"];
    let value = |i: u32, j: u32| match (i, j) {
        (2, 1) => None,
        (0, 4) => Some(f64::NAN),
        _ => Some(1.6 + 0.09 * f64::from(i) - 0.05 * f64::from(j * j)),
    };
    let values = (0..6).map(|j| (0..9).map(|i| value(i, j)).collect()).collect();
    let names = y.map(str::to_owned).to_vec();
    let order = Axis::linear("observed order (1)");
    let map = HeatMap::new(("horizon over spacing", x), ("kernel", names), order, values).diverging(2.0);
    Figure::new("orders", "Observed order of convergence", "Two is second order.", map)
}

/// The same as positive errors over many decades.
pub fn errors() -> Figure {
    let x = ["0.02", "0.01", "0.005", "0.0025"].map(str::to_owned).to_vec();
    let y = ["full", "linear", "exact area"].map(str::to_owned).to_vec();
    let value = |i: i32, j: i32| Some(3.2 * 10f64.powi(-2 * i - j));
    let values = (0..3).map(|j| (0..4).map(|i| value(i, j)).collect()).collect();
    let map =
        HeatMap::new(("spacing Δx (m)", x), ("volume rule", y), Axis::log("relative error (1)"), values);
    Figure::new("errors", "Error by volume rule", "Smaller is better.", map)
}

/// Strain of a released bar over place and time, with ripples behind the fronts and a part that was not computed.
pub fn space_time() -> Figure {
    let (columns, rows) = (200, 150);
    let ramp = |s: f64| {
        let folded = (s + 1.0).rem_euclid(4.0) - 1.0;
        let from = if folded <= 2.0 { folded - 1.0 } else { 3.0 - folded };
        (-from / 0.02).tanh() + 0.2 * (-(from.abs() / 0.15)).exp() * (from / 0.015).sin()
    };
    let value = |i: usize, j: usize| {
        let (x, t) = ((i as f64 + 0.5) / columns as f64, 0.8 * (j as f64 + 0.5) / rows as f64);
        let missing = t > 0.7 && (0.3..0.45).contains(&x);
        (!missing).then_some(0.5e-3 * (ramp(x - 5.05 * t) + ramp(x + 5.05 * t)))
    };
    let values = (0..rows).map(|j| (0..columns).map(|i| value(i, j)).collect()).collect();
    let (x, t) = (Axis::linear("place x (m)").range(0.0, 1.0), Axis::linear("time t (ms)").range(0.0, 0.8));
    let field = Raster::new(x, t, Axis::linear("strain ε (1)"), values).diverging(0.0);
    Figure::new("space-time", "Strain of the released bar", "Fronts run between the ends.", field)
}

/// Two small rasters, one by decades, one with logarithmic values and a zero.
pub fn fields() -> Figure {
    let field = |f: &dyn Fn(i32, i32) -> f64| -> Vec<Vec<Option<f64>>> {
        (0..20).map(|j| (0..30).map(|i| Some(f(i, j))).collect()).collect()
    };
    let smooth = field(&|i, j| libm::sin(0.2 * f64::from(i)) * f64::from(j));
    let errors =
        field(&|i, j| if i == j { 0.0 } else { 10f64.powf(-0.2 * f64::from(i) - 0.1 * f64::from(j)) });
    let x = || Axis::linear("place x (mm)").range(-50.0, 50.0);
    let first = Raster::new(x(), Axis::linear("time step"), Axis::linear("velocity (m/s)"), smooth);
    let decades = Axis::log("frequency (kHz)").range(1.0, 1e3);
    let second = Raster::new(x(), decades, Axis::log("relative error (1)"), errors);
    Figure::new("fields", "Two fields", "Side by side.", first.titled("linear"))
        .panel(second.titled("logarithmic"))
        .columns(2)
}

/// Lattice moduli beside the intended one.
pub fn moduli() -> Figure {
    let groups = ["m = 2", "m = 3", "m = 4", "m = 6"].map(str::to_owned).to_vec();
    let kernels =
        ["constant", "conical", "gaussian, p = 3", "exponential, p = 4, continued beyond the horizon"];
    let categories = kernels
        .iter()
        .zip(1..)
        .map(|(kernel, i)| {
            let mut category = Category::new(*kernel, (1..5).map(|g| 1.0 + 0.2 / f64::from(g * g * i)));
            category.dots[2] = Some(Dot { value: 1.01, range: Some((0.96, 1.06)) });
            category
        })
        .collect();
    let dots = Dots::new(Axis::linear("lattice modulus over intended modulus (1)"), groups, categories)
        .reference(1.0, "intended");
    Figure::new("moduli", "Modulus of the lattice", "One is right.", dots)
}

/// What the error of a peak is made of, in three lattices.
pub fn budget() -> Figure {
    let contributions =
        ["lattice moduli", "dispersion and discretisation", "extraction", "reference", "boundary"];
    let stacks = vec![
        Stack::new("constant kernel, m = 3, calibrated", [6.3, -3.1, 1.6, -0.9, 1.1]),
        Stack::new("exponential kernel, p = 1, m = 3", [2.9, -2.2, 1.3, -0.6, 0.8]),
        Stack::new("exponential kernel, p = 2, m = 3", [-1.7, -1.5, 1.2, -0.6, 0.5]),
    ];
    let value = Axis::linear("contribution to the error of the peak (% of the peak)");
    let panel =
        StackedBars::new(value, contributions.map(str::to_owned).to_vec(), "sum of contributions", stacks);
    Figure::new("budget", "What the error of the peak is made of", "Three kernels.", panel)
}

/// Strain at four times, one legend for all.
pub fn multiples() -> Figure {
    let panel = |t: f64| {
        let wave = |s: f64| sampled(0.0, 1.0, move |x| 1e-6 * (-((x - t) / s).powi(2)).exp());
        let curves = vec![
            Series::reference("exact", wave(0.05)),
            Series::line("m = 3", wave(0.055)),
            Series::line("m = 5", wave(0.07)),
        ];
        Lines::new(Axis::linear("x (m)"), Axis::linear("strain (1)"), curves).titled(format!("t = {t} s"))
    };
    let first = Figure::new("strain", "Strain along the bar", "Four times.", panel(0.2));
    first.panel(panel(0.4)).panel(panel(0.6)).panel(panel(0.8)).columns(2)
}

/// Everything that can be wrong with data at once, in small panels.
pub fn awkward() -> Figure {
    let lines = |title: &str, x: Axis, y: Axis, series| Lines::new(x, y, series).titled(title);
    let x = || Axis::linear("x (m)");
    let nan = vec![(f64::NAN, f64::NAN), (1.0, f64::NAN)];
    let one = vec![(0.5, 3.0)];
    Figure::new(
        "awkward",
        "Awkward data",
        "Empty, missing, single, narrow, tiny.",
        lines("no series", x(), Axis::linear("u (m)"), vec![]),
    )
    .panel(lines("all missing", x(), Axis::log("error (1)"), vec![Series::line("missing", nan)]))
    .panel(lines("one point", x(), Axis::linear("u (m)"), vec![Series::line("one", one)]))
    .panel(lines(
        "log, 1.2 to 1.9",
        x(),
        Axis::log("ratio (1)"),
        vec![Series::both("narrow", vec![(0.0, 1.2), (1.0, 1.5), (2.0, 1.9)])],
    ))
    .panel(lines(
        "around 1e−16",
        x(),
        Axis::linear("rounding error (1)"),
        vec![Series::both("tiny", vec![(0.0, 1e-16), (1.0, -2e-16), (2.0, 3e-16)])],
    ))
    .panel(lines(
        "around 1e−16, log, with a zero",
        Axis::log("x (m)"),
        Axis::log("rounding error (1)"),
        vec![Series::both("tiny log", vec![(1.0, 1e-16), (10.0, 0.0), (100.0, 3e-16), (1e3, 4e-15)])],
    ))
    .columns(2)
}

/// Labels far longer than the figure is wide.
pub fn wordy() -> Figure {
    let long = "the relative deviation of the numerically obtained group velocity from its local limit <&>";
    let curve = |c: f64| sampled(0.0, 1.0, move |x| c * x * x);
    let series = (1..5).map(|i| Series::line(format!("{long}, variant {i}"), curve(f64::from(i)))).collect();
    let panel =
        Lines::new(Axis::linear(format!("{long} {long}")), Axis::linear(format!("{long} (%)")), series)
            .titled(format!("{long} {long}"))
            .guide(Guide::Vertical { at: 0.5, label: long.into() })
            .guide(Guide::Vertical { at: 0.55, label: "middle".into() });
    Figure::new("wordy", format!("{long} {long}"), long, panel)
}

/// All of them.
pub fn all() -> Vec<Figure> {
    vec![
        dispersion(),
        convergence(),
        anisotropy(),
        orders(),
        errors(),
        space_time(),
        fields(),
        moduli(),
        budget(),
        multiples(),
        awkward(),
        wordy(),
    ]
}
