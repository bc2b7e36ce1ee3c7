//! The edges of a body as written; an edge that is not named is free.

use pd_verify::constraints::{Edge, Edges};
use pd_verify::scene::Wrong;
use schemars::JsonSchema;
use serde::Deserialize;

/// What lies beyond one edge, in words.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EdgeName {
    /// Bonds beyond the edge are missing.
    Free,
    /// A plane of symmetry: the edge slides along its plane and does not leave it. Also called `roller`.
    MirrorOdd,
    /// Another word for `mirror_odd`.
    Roller,
    /// No strain across the edge, which does not slide along its plane.
    MirrorEven,
    /// The body repeats; the opposite edge must be periodic too.
    Periodic,
}

impl From<EdgeName> for Edge {
    fn from(name: EdgeName) -> Self {
        match name {
            EdgeName::Free => Self::Free,
            EdgeName::MirrorOdd | EdgeName::Roller => Self::MirrorOdd,
            EdgeName::MirrorEven => Self::MirrorEven,
            EdgeName::Periodic => Self::Periodic,
        }
    }
}

/// What lies beyond each edge. Default: `free`.
#[derive(Debug, Clone, Copy, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EdgesAsked {
    pub left: Option<EdgeName>,
    pub right: Option<EdgeName>,
    /// Of a plate.
    pub bottom: Option<EdgeName>,
    /// Of a plate.
    pub top: Option<EdgeName>,
}

impl EdgesAsked {
    /// The edges of a body.
    pub fn check<const D: usize>(&self) -> Result<Edges<D>, Wrong> {
        let upright = [("bottom", self.bottom), ("top", self.top)];
        if let Some((key, _)) = upright.into_iter().find(|(_, edge)| D == 1 && edge.is_some()) {
            let message = format!("a bar has no {key} edge");
            return Err(Wrong::new(key, message, "leave it out: a bar ends left and right"));
        }
        let pairs = [[self.left, self.right], [self.bottom, self.top]];
        Ok(Edges(std::array::from_fn(|axis| {
            pairs[axis].map(|name| name.map(Edge::from).unwrap_or_default())
        })))
    }
}
