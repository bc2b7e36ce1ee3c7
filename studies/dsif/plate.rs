//! A cracked plate as written, and as a lattice can represent it: cells, the tip, the bonds that the crack cuts.

use crate::dispersion::words::BodyName;
use pd_verify::constraints::{Edge, Edges};
use pd_verify::forces::surface::Correction;
use pd_verify::scene::{Notch, Positive, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;

/// Where the crack lies; always along x, at half the height.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum CrackPlace {
    /// From the left edge inwards, with one tip.
    LeftEdge,
    /// In the middle, with two tips; the right one is read.
    Centre,
}

/// What holds the left and the right edge.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LateralName {
    #[default]
    Free,
    /// The edges slide along y and do not leave their place: a plane wave of mode I stays plane.
    Rollers,
    /// The edges move along x alone: a plane wave of mode II stays plane.
    Guides,
}

/// A plate as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlateAsked {
    pub body: BodyName,
    /// Along x and y.
    pub size_m: [Positive; 2],
    pub crack: CrackPlace,
    /// Of the whole crack: 2a of one in the middle.
    pub crack_length_m: Positive,
    /// Default: `free`.
    pub lateral: Option<LateralName>,
    /// For bonds near free edges and the crack. Default: `none`.
    pub surface_correction: Option<Correction>,
}

/// A plate as its lattice has it. Lengths in m.
#[derive(Debug, Clone, PartialEq)]
pub struct Cracked {
    pub nodes: [usize; 2],
    pub spacing: f64,
    pub place: CrackPlace,
    pub lateral: LateralName,
    pub surface: Correction,
    /// The tip that is read.
    pub tip: [f64; 2],
    /// The whole crack.
    pub crack: f64,
    /// What differs from what was asked; empty where nothing does.
    pub moved: String,
}

/// How far before a tip the cut ends, in spacings: the bonds that pass through the tip itself hold.
pub const BEFORE_TIP: f64 = 1e-3;

/// Finer plates take days to march, and seconds to plan.
const MOST_CELLS: f64 = 5e7;

impl PlateAsked {
    /// The plate on cells of `dx` m: whole cells, an even number of rows, the tip at a multiple of half a cell.
    pub fn on(&self, dx: f64) -> Result<Cracked, Wrong> {
        let [width, height] = self.size_m.map(|side| side.0);
        let columns = (width / dx).round();
        let rows = 2.0 * (0.5 * height / dx).round();
        let halves = match self.crack {
            CrackPlace::LeftEdge => (2.0 * self.crack_length_m.0 / dx).round(),
            // Half the crack in half cells: both tips move alike.
            CrackPlace::Centre => 2.0 * (self.crack_length_m.0 / dx).round(),
        };
        let crack = 0.5 * halves * dx;
        let right = match self.crack {
            CrackPlace::LeftEdge => crack,
            CrackPlace::Centre => 0.5 * (columns * dx + crack),
        };
        if !(columns >= 4.0 && rows >= 4.0 && halves >= 2.0) {
            let message =
                format!("cells of {dx} m leave {columns} by {rows} of them, and a crack of {crack} m");
            return Err(Wrong::new("dx_m", message, "take a smaller dx_m"));
        }
        if columns * rows > MOST_CELLS {
            let message = format!(
                "cells of {dx} m are {:.1e} in the plate, at most {MOST_CELLS:.0e} are run",
                columns * rows
            );
            return Err(Wrong::new("dx_m", message, "take a larger dx_m"));
        }
        if right > columns * dx - dx {
            let message = format!("the crack of {crack} m ends outside the plate of {} m", columns * dx);
            return Err(Wrong::new("plate.crack_length_m", message, "let it end inside"));
        }
        let tip = [right, 0.5 * rows * dx];
        let real = [columns * dx, rows * dx, crack];
        Ok(Cracked {
            nodes: [columns as usize, rows as usize],
            spacing: dx,
            place: self.crack,
            lateral: self.lateral.unwrap_or_default(),
            surface: self.surface_correction.unwrap_or_default(),
            tip,
            crack,
            moved: moved([width, height, self.crack_length_m.0], real),
        })
    }

    /// H, half the height, in m.
    pub fn half_height(&self) -> f64 {
        0.5 * self.size_m[1].0
    }
}

/// What a lattice changes of a plate, in words.
fn moved(asked: [f64; 3], real: [f64; 3]) -> String {
    let names = ["width", "height", "crack"];
    let each = names.into_iter().zip(asked.into_iter().zip(real));
    let differs = each.filter(|(_, (asked, real))| (asked - real).abs() > 1e-9 * asked);
    let said: Vec<String> = differs
        .map(|(name, (asked, real))| format!("{name} {} m for {asked} m", crate::rounded::rounded(real)))
        .collect();
    said.join(", ")
}

impl Cracked {
    /// The bonds that are cut: those that cross the crack between its ends, tips excluded.
    pub fn notch(&self) -> Notch {
        let short = BEFORE_TIP * self.spacing;
        let from = match self.place {
            CrackPlace::LeftEdge => 0.0,
            CrackPlace::Centre => self.tip[0] - self.crack + short,
        };
        Notch { from: [from, self.tip[1]], to: [self.tip[0] - short, self.tip[1]] }
    }

    pub fn edges(&self) -> Edges<2> {
        let lateral = match self.lateral {
            LateralName::Free => Edge::Free,
            LateralName::Rollers => Edge::MirrorOdd,
            LateralName::Guides => Edge::MirrorEven,
        };
        Edges([[lateral; 2], [Edge::Free; 2]])
    }

    /// What must lie between an annulus and the crack's other end: at a second tip its nonlocal zone.
    pub fn free_crack(&self, horizon: f64) -> f64 {
        match self.place {
            CrackPlace::LeftEdge => self.crack,
            CrackPlace::Centre => self.crack - 2.0 * horizon,
        }
    }

    /// The same plate with its tip further ahead by so many m.
    pub fn further(&self, by: f64) -> Self {
        Self { tip: [self.tip[0] + by, self.tip[1]], crack: self.crack + by, ..self.clone() }
    }

    /// From the tip to the right edge.
    pub fn ahead(&self) -> f64 {
        self.nodes[0] as f64 * self.spacing - self.tip[0]
    }

    /// a: the length of an edge crack, half that of one in the middle.
    pub fn a(&self) -> f64 {
        match self.place {
            CrackPlace::LeftEdge => self.crack,
            CrackPlace::Centre => 0.5 * self.crack,
        }
    }

    /// From the tip to the nearest edge other than the one that the crack comes from.
    pub fn room(&self) -> f64 {
        self.ahead().min(self.tip[1])
    }

    /// Whether the tip stands between two columns of nodes, or on one.
    pub fn between_columns(&self) -> bool {
        let at = self.tip[0] / self.spacing;
        (at - at.round()).abs() < 0.25
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(size: [f64; 2], crack: CrackPlace, length: f64) -> PlateAsked {
        PlateAsked {
            body: BodyName::PlaneStress,
            size_m: size.map(Positive),
            crack,
            crack_length_m: Positive(length),
            lateral: None,
            surface_correction: None,
        }
    }

    #[test]
    fn a_plate_that_fits_is_not_moved() {
        let plate = asked([10.0, 4.0], CrackPlace::LeftEdge, 5.0).on(0.05).unwrap();
        assert_eq!((plate.nodes, plate.tip, plate.moved.as_str()), ([200, 80], [5.0, 2.0], ""));
        assert!(plate.between_columns());
        assert_eq!(plate.room(), 2.0);
    }

    /// 40/0.26 = 153.8 and 24/0.26 = 92.3 cells.
    #[test]
    fn what_does_not_fit_is_moved_to_half_cells_and_said() {
        let plate = asked([0.104, 0.04], CrackPlace::Centre, 0.024).on(0.26e-3).unwrap();
        assert_eq!(plate.nodes, [400, 154]);
        assert!((plate.a() - 46.0 * 0.26e-3).abs() < 1e-12 && plate.between_columns());
        assert_eq!(plate.moved, "height 0.04004 m for 0.04 m, crack 0.02392 m for 0.024 m");
        let fine = asked([0.104, 0.04], CrackPlace::Centre, 0.024).on(0.13e-3).unwrap();
        assert!((fine.a() / 0.13e-3 - 92.5).abs() < 1e-9 && !fine.between_columns());
    }

    #[test]
    fn bonds_through_the_tip_hold_and_those_behind_it_do_not() {
        let plate = asked([8.0, 4.0], CrackPlace::LeftEdge, 4.0).on(1.0).unwrap();
        let cut = |a, b| plate.notch().cuts(a, b, 1.0);
        assert!(cut([3.5, 1.5], [3.5, 2.5]) && !cut([3.5, 1.5], [4.5, 2.5]) && cut([2.5, 1.5], [4.5, 2.5]));
        let centred = asked([8.0, 4.0], CrackPlace::Centre, 4.0).on(1.0).unwrap();
        let cut = |a, b| centred.notch().cuts(a, b, 1.0);
        assert!(cut([2.5, 1.5], [2.5, 2.5]) && !cut([1.5, 1.5], [2.5, 2.5]) && !cut([1.5, 1.5], [1.5, 2.5]));
    }

    #[test]
    fn cracks_that_part_the_plate_are_refused() {
        let wrong = asked([8.0, 4.0], CrackPlace::LeftEdge, 8.0).on(1.0).unwrap_err();
        assert_eq!(wrong.key, "plate.crack_length_m");
        assert_eq!(asked([8.0, 4.0], CrackPlace::LeftEdge, 4.0).on(3.0).unwrap_err().key, "dx_m");
    }
}
