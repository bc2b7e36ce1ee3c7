//! A field of displacement of another code, at rest, held against its closed form at the places that were reported.

use crate::foreign::{Data, Foreign, Keys, Mistake, Suspect, View, Wanted, likely, scaled};
use crate::levels::relative;
use crate::question::{Answer, Claiming, Place, claim, error_of};
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::verdict::Evidence;

/// Displacements (u_x, u_y) over (x, y).
pub type Exact<'a> = Box<dyn Fn([f64; 2]) -> [f64; 2] + 'a>;

/// A plate at rest whose displacement is known.
pub struct ForeignField<'a> {
    pub title: &'a str,
    /// Unique in the case.
    pub name: &'static str,
    /// Of the square in which it is judged, from (0, 0).
    pub side: f64,
    pub exact: Exact<'a>,
    /// Bound of the root mean square, with its reason.
    pub bound: (f64, Basis, &'static str),
    pub problem: Vec<(&'static str, String)>,
    pub source: &'static str,
    /// Known wrong answers: what was done, the field, and what the note says of it.
    pub wrong: Vec<(&'static str, Exact<'a>, &'static str)>,
}

/// Fewer places do not show a field.
const FEWEST: usize = 16;
const TRIED: usize = 2000;

type Node = ([f64; 2], [f64; 2]);

impl ForeignField<'_> {
    fn nodes(&self, data: &Data) -> Vec<Node> {
        let [x, y, ux, uy] = ["x_m", "y_m", "ux_m", "uy_m"].map(|name| data.of(name));
        let all = (0..x.len()).map(|n| ([x[n], y[n]], [ux[n], uy[n]]));
        let slack = 1e-6 * self.side;
        all.filter(|(at, _)| at.iter().all(|x| (-slack..=self.side + slack).contains(x))).collect()
    }

    fn error(nodes: &[Node], exact: impl Fn([f64; 2]) -> [f64; 2]) -> Option<f64> {
        let pairs = nodes.iter().flat_map(|(at, u)| {
            let known = exact(*at);
            [(u[0], known[0]), (u[1], known[1])]
        });
        Some(relative(pairs)[1]).filter(|error| error.is_finite())
    }

    fn suspects(&self, nodes: &[Node]) -> Vec<Suspect> {
        let every = nodes.len().div_ceil(TRIED).max(1);
        let nodes: Vec<Node> = nodes.iter().copied().step_by(every).collect();
        let mut all = scaled(|factor| {
            let scaled: Vec<Node> = nodes.iter().map(|(at, u)| (*at, u.map(|u| factor * u))).collect();
            Self::error(&scaled, &self.exact)
        });
        let mut add = |cause: String, error| all.push(Suspect { cause, error });
        let turned: Vec<Node> = nodes.iter().map(|(at, u)| (*at, [u[1], u[0]])).collect();
        add(
            "with u_x and u_y exchanged: are the columns in the order x, y, u_x, u_y?".into(),
            Self::error(&turned, &self.exact),
        );
        let across: Vec<Node> = nodes.iter().map(|(at, u)| ([at[1], at[0]], *u)).collect();
        add(
            "with x and y exchanged: are the columns in the order x, y, u_x, u_y?".into(),
            Self::error(&across, &self.exact),
        );
        let count = nodes.len() as f64;
        let mean = [0, 1]
            .map(|axis| nodes.iter().map(|(at, u)| u[axis] - (self.exact)(*at)[axis]).sum::<f64>() / count);
        let moved: Vec<Node> = nodes.iter().map(|(at, u)| (*at, [u[0] - mean[0], u[1] - mean[1]])).collect();
        add(
            "less a translation of the whole plate: is it held as it should be?".into(),
            Self::error(&moved, &self.exact),
        );
        let half = 0.5 * self.side;
        add(
            "with the origin in the middle of the square: the corner is at (0, 0)".into(),
            Self::error(&nodes, |[x, y]| (self.exact)([x + half, y + half])),
        );
        for (what, wrong, _) in &self.wrong {
            add(format!("as {what}: was that computed?"), Self::error(&nodes, wrong));
        }
        all
    }

    fn places(&self) -> Vec<[f64; 2]> {
        let at = |n: usize| (n as f64 + 0.5) / 20.0 * self.side;
        (0..20).flat_map(|j| (0..20).map(move |i| [at(i), at(j)])).collect()
    }

    fn columns(&self, of: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<Vec<f64>> {
        let places = self.places();
        let u: Vec<[f64; 2]> = places.iter().map(|at| of(*at)).collect();
        let pick = |of: &[[f64; 2]], axis: usize| of.iter().map(|one| one[axis]).collect();
        vec![pick(&places, 0), pick(&places, 1), pick(&u, 0), pick(&u, 1)]
    }
}

impl Foreign for ForeignField<'_> {
    fn name(&self) -> String {
        self.name.into()
    }

    fn what(&self) -> String {
        format!(
            "displacement of nodes at rest in the square of {} m: {}",
            self.side,
            self.name.replace('-', " ")
        )
    }

    fn wanted(&self) -> Vec<Wanted> {
        vec![
            Wanted::new(
                "x_m",
                "m",
                &["x"],
                "place before the load, from the lower left corner of the square",
            ),
            Wanted::new("y_m", "m", &["y"], "likewise, upwards"),
            Wanted::new("ux_m", "m", &["ux", "u_x", "displacement_x"], "displacement along x"),
            Wanted::new("uy_m", "m", &["uy", "u_y", "displacement_y"], "displacement along y"),
        ]
    }

    fn keys(&self) -> Keys {
        Keys::Distinct(&["x_m", "y_m"])
    }

    fn problem(&self) -> Vec<(&'static str, String)> {
        self.problem.clone()
    }

    fn claims(&self, place: &Place) -> Vec<Claim> {
        let (most, basis, why) = self.bound;
        let quantity = format!(
            "root mean square error of the displacement over that of the exact one, {}",
            self.name.replace('-', " ")
        );
        vec![
            claim(place, "check_field", quantity)
                .at_most(ErrorKind::L2Relative, most)
                .because(basis, why)
                .source(self.source),
        ]
    }

    fn judge(&self, data: &Data, place: &Place) -> Answer {
        let nodes = self.nodes(data);
        let spread = |axis: usize| {
            let low = nodes.iter().map(|node| node.0[axis]).fold(f64::INFINITY, f64::min);
            nodes.iter().map(|node| node.0[axis]).fold(f64::NEG_INFINITY, f64::max) - low
        };
        let covered = nodes.len() >= FEWEST && spread(0) >= 0.7 * self.side && spread(1) >= 0.7 * self.side;
        let left = data.of("x_m").len() - nodes.len();
        let evidence = if covered {
            let error = Self::error(&nodes, &self.exact);
            let failed = error.is_some_and(|error| error > self.bound.0);
            let cause =
                if failed { likely(error, self.bound.0, self.suspects(&nodes)) } else { String::new() };
            let left = if left > 0 { format!(", {left} outside the square left out") } else { String::new() };
            Evidence { computed: error, ..error_of(error, format!("{} nodes{left}{cause}", nodes.len())) }
        } else {
            let outside = format!(
                "{} nodes lie in the square from (0, 0) to ({} m, {} m), {FEWEST} over seven tenths of both sides are needed",
                nodes.len(),
                self.side,
                self.side
            );
            let cause = if left > nodes.len() {
                "; most lie outside it: are lengths in mm, or is the origin elsewhere?"
            } else {
                ""
            };
            Evidence { outside: Some(outside + cause), ..Evidence::default() }
        };
        let view = |axis: usize| View {
            across: "x (m)".into(),
            up: format!("u_{} (µm)", ["x", "y"][axis]),
            unit: [1.0, 1e-6],
            rows: nodes.iter().map(|(at, u)| (at[0], u[axis], Some((self.exact)(*at)[axis]))).collect(),
            reference: Vec::new(),
            judged: None,
            markers: true,
        };
        // Of the component that is larger: the other one may be nothing.
        let size =
            |axis: usize| nodes.iter().map(|(at, _)| (self.exact)(*at)[axis].abs()).fold(0.0, f64::max);
        let view = view(usize::from(size(1) > size(0)));
        let caption =
            "Displacement of all nodes that were brought, over x, and how far it is from the exact one.";
        Answer {
            evidence: vec![("check_field".into(), evidence)],
            tables: vec![view.table(place, self.name)],
            figures: if covered { vec![view.figure(place, self.title, caption)] } else { Vec::new() },
            ..Answer::default()
        }
    }

    fn reference(&self) -> Vec<Vec<f64>> {
        self.columns(&self.exact)
    }

    fn mistakes(&self) -> Vec<Mistake> {
        let times = |factor: f64| self.columns(|at| (self.exact)(at).map(|u| factor * u));
        let mut all = vec![
            Mistake { what: "the sign flipped", columns: times(-1.0), cause: "sign convention" },
            Mistake { what: "twice as large", columns: times(2.0), cause: "1/2" },
            Mistake { what: "displacements in mm", columns: times(1e3), cause: "10⁻³" },
        ];
        for (what, wrong, cause) in &self.wrong {
            all.push(Mistake { what, columns: self.columns(wrong), cause });
        }
        all
    }
}
