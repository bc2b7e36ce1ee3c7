//! What a case claims of its histories: bounds with their reasons, written in the study file before anything is run.

use super::errors::{self, Errors};
use super::extraction::Extraction;
use super::intensity::{Found, Intensity, Read, Track};
use super::said::{check_name, check_reason};
use crate::levels::{furthest, order_of};
use crate::question::{Claiming, Place, claim, error_of};
use crate::rounded::rounded;
use pd_verify::claim::{Basis, Claim, ErrorKind};
use pd_verify::scene::{Positive, Wrong};
use pd_verify::verdict::Evidence;
use schemars::JsonSchema;
use serde::Deserialize;

/// What is claimed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum QuantityName {
    /// Root mean square of the error in the window over the largest |K| of the reference there.
    Rms,
    /// The largest error, likewise.
    Max,
    /// The error in L2 over that of the reference, in the window.
    L2,
    /// The largest K of the window over that of the reference, less 1.
    Peak,
    /// Levels at which the root mean square does not fall: to be none.
    NotFalling,
    /// The order in the spacing at which the root mean square falls.
    Order,
    /// The largest difference from another extraction in the window, over the largest |K| of the reference.
    Apart,
    /// The ratio to another extraction in the window, over that of their tip factors, less 1.
    Ratio,
    /// The largest |K| before the first wave arrives, over the largest |K| of the reference in the window.
    Early,
}

impl QuantityName {
    /// In the names of claims.
    fn word(self) -> &'static str {
        match self {
            Self::Rms => "rms",
            Self::Max => "max",
            Self::L2 => "l2",
            Self::Peak => "peak",
            Self::NotFalling => "not_falling",
            Self::Order => "order",
            Self::Apart => "apart",
            Self::Ratio => "ratio",
            Self::Early => "early",
        }
    }
}

/// A claim as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ExpectAsked {
    /// Of the claim; default the extraction and the quantity.
    pub name: Option<String>,
    /// Name of one of the case's extractions.
    pub extraction: String,
    pub quantity: QuantityName,
    /// Of `apart` and `ratio`: the other extraction.
    pub from: Option<String>,
    /// One of the weights, as in the claims of refinements: `gaussian_2_linear_calibrated`. Default: all, the furthest.
    pub weights: Option<String>,
    /// One of the levels; default the finest. Of no use to `not_falling` and `order`.
    pub dx_m: Option<Positive>,
    pub at_most: Option<f64>,
    pub at_least: Option<f64>,
    /// Where the bound comes from.
    pub basis: Basis,
    /// Why it is what it is, in a sentence.
    pub because: String,
    /// Where the answer comes from; default the case's reference.
    pub source: Option<String>,
    /// Hold K against the published reference instead: of `rms`, `max`, `l2` and `peak`.
    pub against_published: Option<bool>,
    /// Why the bound is expected to be broken: a printed statement that is shown wrong.
    pub broken: Option<String>,
}

/// A bound.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Bound {
    AtMost(f64),
    AtLeast(f64),
}

/// A claim, checked.
#[derive(Debug, Clone)]
pub struct Expect {
    /// Of its claim.
    pub name: String,
    asked: ExpectAsked,
    bound: Bound,
    /// Index of the extraction.
    extraction: usize,
    /// Of the other one.
    from: Option<usize>,
}

impl Expect {
    /// The claims of a case, each with a name of its own.
    pub fn all(
        asked: &[ExpectAsked],
        extractions: &[Extraction],
        tracks: &[Track],
        published: bool,
        by_m: bool,
    ) -> Result<Vec<Self>, Wrong> {
        let mut all: Vec<Self> = Vec::new();
        for (index, one) in asked.iter().enumerate() {
            let path = format!("expect[{index}]");
            let one = Self::new(one, extractions, tracks).map_err(|wrong| wrong.inside(&path))?;
            let taken: Vec<String> = all.iter().map(|other| other.name.clone()).collect();
            check_name("name", &one.name, &taken).map_err(|wrong| wrong.inside(&path))?;
            if one.published() && !published {
                let message = "there is no published reference to hold K against";
                let key = format!("{path}.against_published");
                return Err(Wrong::new(key, message, "add known.reference_poisson_ratio"));
            }
            if by_m && one.asked.quantity == QuantityName::Order {
                let message = "at a fixed horizon nothing is refined that an order could be had in";
                return Err(Wrong::new(format!("{path}.quantity"), message, "refine with dx_m"));
            }
            all.push(one);
        }
        Ok(all)
    }

    fn new(asked: &ExpectAsked, extractions: &[Extraction], tracks: &[Track]) -> Result<Self, Wrong> {
        use QuantityName::{Apart, NotFalling, Order, Ratio};
        let find = |key: &str, name: &str| {
            extractions.iter().position(|one| one.name == *name).ok_or_else(|| {
                let names: Vec<&str> = extractions.iter().map(|one| one.name.as_str()).collect();
                let message = format!("no extraction is called \"{name}\"");
                Wrong::new(key, message, format!("this case has: {}", names.join(", ")))
            })
        };
        let extraction = find("extraction", &asked.extraction)?;
        let pair = matches!(asked.quantity, Apart | Ratio);
        let from = match (&asked.from, pair) {
            (Some(name), true) => Some(find("from", name)?),
            (None, false) => None,
            (None, true) => {
                return Err(Wrong::new("", "a difference is from another extraction", "add from"));
            }
            (Some(_), false) => {
                return Err(Wrong::new("from", "from says nothing about this quantity", "leave it out"));
            }
        };
        let levels = tracks.iter().map(|track| track.setups.len()).min().unwrap_or(0);
        let needed = match asked.quantity {
            NotFalling => 2,
            Order => 3,
            _ => 1,
        };
        if levels < needed {
            let message = format!("this quantity needs {needed} levels, and there are {levels}");
            return Err(Wrong::new("quantity", message, "add spacings to dx_m"));
        }
        if from == Some(extraction) {
            return Err(Wrong::new("from", "an extraction does not differ from itself", "name another one"));
        }
        let errors = [QuantityName::Rms, QuantityName::Max, QuantityName::L2, QuantityName::Peak];
        let bound = match (asked.at_most, asked.at_least, asked.quantity) {
            (Some(most), None, quantity) if !matches!(quantity, Order | NotFalling) && most > 0.0 => {
                Bound::AtMost(most)
            }
            (None, Some(least), Order) if least.is_finite() => Bound::AtLeast(least),
            (None, Some(least), quantity) if errors.contains(&quantity) && least > 0.0 => {
                Bound::AtLeast(least)
            }
            (None, None, NotFalling) => Bound::AtMost(0.0),
            _ => {
                let help = "give at_most above 0; of an order, or an error that stays, at_least; of not_falling none";
                return Err(Wrong::new("", "a claim needs one bound that fits its quantity", help));
            }
        };
        let known = |slug: &String| tracks.iter().any(|track| track.slug == *slug);
        if let Some(slug) = asked.weights.as_ref().filter(|slug| !known(slug)) {
            let slugs: Vec<&str> = tracks.iter().map(|track| track.slug.as_str()).collect();
            let message = format!("no weights of this case are called \"{slug}\"");
            return Err(Wrong::new("weights", message, format!("this case has: {}", slugs.join(", "))));
        }
        if asked.against_published == Some(true)
            && !matches!(
                asked.quantity,
                QuantityName::Rms | QuantityName::Max | QuantityName::L2 | QuantityName::Peak
            )
        {
            let message = "this quantity is not held against the published reference";
            return Err(Wrong::new("against_published", message, "leave it out"));
        }
        let near = |dx: f64, spacing: f64| (spacing / dx - 1.0).abs() < 1e-6;
        if asked.dx_m.is_some() && matches!(asked.quantity, Order | NotFalling) {
            return Err(Wrong::new("dx_m", "this quantity is about all levels", "leave it out"));
        }
        if let Some(dx) = asked.dx_m
            && !tracks.iter().all(|track| track.setups.iter().any(|setup| near(dx.0, setup.scene.spacing)))
        {
            return Err(Wrong::new("dx_m", format!("no level has cells of {} m", dx.0), "take one of dx_m"));
        }
        check_reason(&asked.because)?;
        let word = asked.quantity.word();
        let name = asked.name.clone().unwrap_or_else(|| format!("{}_{word}", asked.extraction));
        Ok(Self { name, asked: asked.clone(), bound, extraction, from })
    }

    /// What is claimed.
    pub fn claim(&self, intensity: &Intensity, place: &Place) -> Claim {
        let asked = &self.asked;
        let mode = intensity.load.mode.word();
        let at = asked.dx_m.map_or("the finest level".to_owned(), |dx| format!("dx = {} m", dx.0));
        let against = if self.published() { " (against the published reference)" } else { "" };
        let of = format!("K_{mode} by {}{against}", asked.extraction.replace('_', " "));
        let other = asked.from.as_deref().unwrap_or_default().replace('_', " ");
        use QuantityName as Q;
        let (quantity, kind) = match asked.quantity {
            Q::Rms => (format!("root mean square error of {of} at {at}"), ErrorKind::RmsOfPeak),
            Q::Max => (format!("largest error of {of} at {at}"), ErrorKind::MaxOfPeak),
            Q::L2 => (format!("error in L2 of {of} at {at}"), ErrorKind::L2Relative),
            Q::Peak => (format!("error of the largest {of} at {at}"), ErrorKind::Relative),
            Q::NotFalling => (format!("levels at which the error of {of} does not fall"), ErrorKind::Count),
            Q::Order => (format!("order in the spacing of the error of {of}"), ErrorKind::Order),
            Q::Apart => (format!("largest difference of {of} from {other} at {at}"), ErrorKind::MaxOfPeak),
            Q::Early => (format!("largest {of} before the wave arrives, at {at}"), ErrorKind::MaxOfPeak),
            Q::Ratio => (
                format!("ratio of {of} to {other} at {at}, over that of their tip factors, less 1"),
                ErrorKind::Relative,
            ),
        };
        let source = asked.source.clone().unwrap_or_else(|| intensity.known.source().to_owned());
        let start = claim(place, &self.name, quantity);
        let bounded = match (self.bound, asked.quantity) {
            (_, Q::NotFalling) => start.exactly(),
            (Bound::AtMost(most), _) => start.at_most(kind, most),
            (Bound::AtLeast(least), _) => Claim { error_kind: kind, ..start.at_least(least) },
        };
        let claim = bounded.because(asked.basis, asked.because.clone()).source(source);
        match &asked.broken {
            Some(why) => claim.broken(why.clone()),
            None => claim,
        }
    }

    /// What was found, of several weights the furthest.
    pub fn evidence(&self, intensity: &Intensity, found: &Found) -> Evidence {
        let chosen = intensity
            .tracks
            .iter()
            .zip(&found.reads)
            .filter(|(track, _)| self.asked.weights.as_ref().is_none_or(|slug| *slug == track.slug));
        let each: Vec<Evidence> =
            chosen.map(|(track, reads)| self.of_track(intensity, track, reads)).collect();
        match self.bound {
            Bound::AtMost(most) => furthest(each, most).unwrap_or_default(),
            // One below the bound before one without a number, and this before one above.
            Bound::AtLeast(least) => {
                let rank = |evidence: &Evidence| match evidence.computed.filter(|value| !value.is_nan()) {
                    Some(value) if value < least => (0, value),
                    None => (1, 0.0),
                    Some(value) => (2, value),
                };
                let lower = |a: &Evidence, b: &Evidence| {
                    let (a, b) = (rank(a), rank(b));
                    a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
                };
                each.into_iter().min_by(lower).unwrap_or_default()
            }
        }
    }

    /// Whether tip factors are compared.
    pub fn asks_for_factors(&self) -> bool {
        self.asked.quantity == QuantityName::Ratio
    }

    /// The bound of an error at the finest level against the case's own reference, and why: what is also asked of other
    /// codes.
    pub fn bound_of(&self, quantity: QuantityName) -> Option<(f64, Basis, &str)> {
        let own = self.asked.quantity == quantity && self.asked.dx_m.is_none() && self.asked.broken.is_none();
        match self.bound {
            Bound::AtMost(most) if own && !self.published() => {
                Some((most, self.asked.basis, &self.asked.because))
            }
            _ => None,
        }
    }

    fn published(&self) -> bool {
        self.asked.against_published == Some(true)
    }

    fn of_track(&self, intensity: &Intensity, track: &Track, reads: &[Vec<Read>]) -> Evidence {
        let errors =
            |level: &Vec<Read>| errors::against(intensity, &level[self.extraction], self.published());
        let level = match self.asked.dx_m {
            None => reads.len() - 1,
            Some(dx) => {
                let near = |spacing: f64| (spacing / dx.0 - 1.0).abs() < 1e-6;
                track.setups.iter().position(|setup| near(setup.scene.spacing)).unwrap_or(reads.len() - 1)
            }
        };
        let setup = &track.setups[level];
        let note = |value: Option<f64>| {
            let moved =
                if setup.plate.moved.is_empty() { String::new() } else { format!("; {}", setup.plate.moved) };
            format!("{}: {}{moved}", track.name, value.map_or("nothing known".into(), rounded))
        };
        let single = |pick: fn(&Errors) -> f64| {
            let value = errors(&reads[level]).map(|errors| pick(&errors));
            Evidence { computed: value, ..error_of(value, note(value)) }
        };
        let steps = || track.setups.iter().map(|setup| setup.tip.horizon);
        let falling: Vec<(f64, f64)> = steps()
            .zip(reads.iter().map(|level| errors(level).map_or(f64::NAN, |errors| errors.rms)))
            .collect();
        match self.asked.quantity {
            QuantityName::Rms => single(|errors| errors.rms),
            QuantityName::Max => single(|errors| errors.max),
            QuantityName::L2 => single(|errors| errors.l2),
            QuantityName::Peak => single(|errors| errors.peak),
            QuantityName::NotFalling => not_falling(&track.name, &falling),
            QuantityName::Order => order_of(&track.name, &falling, 1.0, 0.0),
            QuantityName::Apart => {
                let from = &reads[level][self.from.unwrap_or(self.extraction)];
                let value = errors::apart(intensity, &reads[level][self.extraction], from);
                Evidence { computed: value, ..error_of(value, note(value)) }
            }
            QuantityName::Early => {
                let value = errors::early(intensity, &reads[level][self.extraction]);
                Evidence { computed: value, ..error_of(value, note(value)) }
            }
            QuantityName::Ratio => self.ratio(intensity, &track.name, &reads[level]),
        }
    }

    /// How far the ratio of two readings is from that of their factors, where none has been divided by.
    fn ratio(&self, intensity: &Intensity, name: &str, reads: &[Read]) -> Evidence {
        let from = self.from.unwrap_or(self.extraction);
        let mode = intensity.load.mode.index();
        let left = |index: usize| {
            let divided = intensity.extractions[index].tip_factor;
            reads[index].factors.map(|factors| if divided { 1.0 } else { factors[mode] })
        };
        let expected = left(self.extraction).zip(left(from)).map(|(a, b)| a / b);
        let found = errors::ratio(intensity, &reads[self.extraction], &reads[from]);
        let error = found.zip(expected).map(|(found, expected)| (found / expected - 1.0).abs());
        Evidence { computed: found, reference: expected, error, note: name.to_owned(), ..Evidence::default() }
    }
}

/// Levels whose error is not below that of the level before.
fn not_falling(name: &str, levels: &[(f64, f64)]) -> Evidence {
    if levels.iter().any(|level| !level.1.is_finite()) {
        return Evidence { note: format!("{name}: a level is not finite"), ..Evidence::default() };
    }
    let count = levels.windows(2).filter(|pair| pair[1].1 >= pair[0].1).count() as f64;
    let listed: Vec<String> = levels.iter().map(|level| rounded(level.1)).collect();
    let note = format!("{name}: {}", listed.join(", "));
    Evidence { computed: Some(count), reference: Some(0.0), error: Some(count), note, ..Evidence::default() }
}
