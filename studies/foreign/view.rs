//! What was brought beside what is known: rows of `check.csv` and a figure of two panels.

use crate::question::Place;
use pd_verify::report::plot::{Axis, Band, Figure, Guide, Lines, Series};
use pd_verify::table::Table;

/// One quantity over one other, with its reference.
pub struct View {
    /// The quantity and its unit: "K_I (MPa√m)".
    pub across: String,
    pub up: String,
    /// What x and y are divided by in the figure.
    pub unit: [f64; 2],
    /// (x, value, reference) in SI, by x.
    pub rows: Vec<(f64, f64, Option<f64>)>,
    /// The reference, as finely as it is to be drawn.
    pub reference: Vec<(f64, f64)>,
    /// From where to where it is judged.
    pub judged: Option<(f64, f64)>,
    /// As markers, where rows are few or in no order.
    pub markers: bool,
}

impl View {
    pub fn table(&self, place: &Place, form: &str) -> Table {
        let columns = ["case", "data", "x", "value", "reference", "error_over_peak", "judged"];
        let mut table = Table::new("check.csv", &columns);
        let peak = self.peak();
        for &(x, value, reference) in &self.rows {
            let judged = reference.is_some() && self.judged.is_none_or(|(from, to)| (from..=to).contains(&x));
            let error = reference.map(|reference| (value - reference) / peak);
            table.push(vec![
                place.case.as_str().into(),
                form.into(),
                x.into(),
                value.into(),
                reference.into(),
                error.into(),
                judged.into(),
            ]);
        }
        table
    }

    fn peak(&self) -> f64 {
        self.rows.iter().filter_map(|row| row.2).map(f64::abs).fold(0.0, f64::max)
    }

    pub fn figure(&self, place: &Place, title: &str, caption: &str) -> Figure {
        let [x, y] = self.unit;
        let peak = self.peak();
        let scaled = |points: &[(f64, f64)]| points.iter().map(|(a, b)| (a / x, b / y)).collect::<Vec<_>>();
        let brought: Vec<(f64, f64)> = self.rows.iter().map(|row| (row.0, row.1)).collect();
        let far = self.rows.iter().filter_map(|row| Some((row.0 / x, 100.0 * (row.1 - row.2?) / peak)));
        let draw = |name: &str, points| {
            if self.markers { Series::markers(name, points) } else { Series::line(name, points) }
        };
        let bands: Vec<Band> = self
            .judged
            .iter()
            .map(|(from, to)| Band { from: from / x, to: to / x, label: "judged".into() })
            .collect();
        let series = vec![
            Series::reference("reference", scaled(&self.reference)),
            draw("the data", scaled(&brought)).slot(0),
        ];
        let mut upper = Lines::new(Axis::linear(self.across.clone()), Axis::linear(self.up.clone()), series);
        upper.bands = bands.clone();
        let errors = vec![draw("", far.collect()).slot(0)];
        let mut lower =
            Lines::new(Axis::linear(self.across.clone()), Axis::linear("error (% of the peak)"), errors);
        lower.bands = bands;
        lower.guides = vec![Guide::Horizontal { at: 0.0, label: String::new() }];
        Figure::new(format!("{}-check", place.case), title, caption, upper).panel(lower)
    }
}
