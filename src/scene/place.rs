//! Where on a body something acts: an axis, an edge, a box of nodes.

use super::{Positive, Wrong};
use crate::grid::Grid;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Axis {
    X,
    Y,
}

impl Axis {
    /// Index of the component, refused where the body has no such direction.
    pub fn index<const D: usize>(self) -> Result<usize, Wrong> {
        match self {
            Self::X => Ok(0),
            Self::Y if D == 2 => Ok(1),
            Self::Y => Err(Wrong::new("axis", "a bar has no y", "take axis = \"x\"")),
        }
    }
}

/// An edge of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    Left,
    Right,
    Bottom,
    Top,
}

impl Side {
    /// In study files and messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Bottom => "bottom",
            Self::Top => "top",
        }
    }

    /// The axis it ends and whether it is the upper end.
    pub fn end<const D: usize>(self) -> Result<(usize, bool), Wrong> {
        match self {
            Self::Left => Ok((0, false)),
            Self::Right => Ok((0, true)),
            Self::Bottom if D == 2 => Ok((1, false)),
            Self::Top if D == 2 => Ok((1, true)),
            Self::Bottom | Self::Top => {
                Err(Wrong::new("edge", "a bar has no bottom or top", "take edge = \"left\" or \"right\""))
            }
        }
    }

    /// Whether a node lies among the `layers` outermost ones of this edge.
    pub fn holds<const D: usize>(
        self,
        grid: &Grid<D>,
        layers: usize,
    ) -> Result<impl Fn([isize; D]) -> bool + use<D>, Wrong> {
        let (axis, upper) = self.end::<D>()?;
        let last = grid.nodes[axis] as isize - 1;
        Ok(move |node: [isize; D]| {
            let depth = if upper { last - node[axis] } else { node[axis] };
            depth < layers as isize
        })
    }
}

/// Some nodes of a body: those along an edge, or those in a box.
#[derive(Debug, Clone, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Region {
    pub edge: Option<Side>,
    /// How far the nodes reach from the edge; default one cell.
    pub depth_m: Option<Positive>,
    /// Lower corner of a box, one number per axis.
    pub from_m: Option<Vec<f64>>,
    /// Upper corner.
    pub to_m: Option<Vec<f64>>,
}

impl Region {
    /// Whether a node's centre belongs to the region; a region without nodes is refused.
    pub fn nodes<const D: usize>(&self, grid: &Grid<D>) -> Result<Vec<[isize; D]>, Wrong> {
        let found: Vec<[isize; D]> = match (self.edge, &self.from_m, &self.to_m) {
            (None, None, None) if self.depth_m.is_none() => grid.each().collect(),
            (Some(side), None, None) => {
                let depth = self.depth_m.map_or(grid.spacing, |depth| depth.0);
                let layers = (depth / grid.spacing + 1e-9).floor() as usize;
                if layers == 0 {
                    let message = format!(
                        "a layer of {depth} m is thinner than a cell of {} m: it holds no node",
                        grid.spacing
                    );
                    let help = format!("take {} m or more, or leave depth_m out for one cell", grid.spacing);
                    return Err(Wrong::new("depth_m", message, help));
                }
                let (axis, _) = side.end::<D>()?;
                if layers > grid.nodes[axis] {
                    let size = grid.nodes[axis] as f64 * grid.spacing;
                    let message = format!("a depth of {depth} m is larger than the body of {size} m");
                    return Err(Wrong::new(
                        "depth_m",
                        message,
                        "take a smaller depth, or leave out edge and depth_m",
                    ));
                }
                let holds = side.holds(grid, layers)?;
                grid.each().filter(|node| holds(*node)).collect()
            }
            (None, Some(from), Some(to)) if self.depth_m.is_none() => {
                if from.len() != D || to.len() != D {
                    let message = format!("a corner has {D} number(s) here");
                    return Err(Wrong::new("from_m", message, "give one number per axis, also in to_m"));
                }
                // A corner meant to stand on a node must not miss it by rounding.
                let slack = 1e-9 * grid.spacing;
                let inside = |node: &[isize; D]| {
                    let at = grid.position(*node);
                    (0..D).all(|axis| from[axis] - slack <= at[axis] && at[axis] <= to[axis] + slack)
                };
                grid.each().filter(inside).collect()
            }
            (None, None, None) => {
                let message = "a depth is counted from an edge, and edge is missing";
                return Err(Wrong::new("", message, "give edge, for example edge = \"left\""));
            }
            _ => {
                let help =
                    "give edge with depth_m, or from_m and to_m, or leave the table out for the whole body";
                return Err(Wrong::new("", "a region is an edge or a box, not both", help));
            }
        };
        if found.is_empty() {
            let help = match grid.pierced() {
                true => "widen it to hold the centre of a cell that no hole has removed",
                false => "widen it to hold the centre of a cell",
            };
            return Err(Wrong::new("", "the region holds no node", help));
        }
        Ok(found)
    }
}
