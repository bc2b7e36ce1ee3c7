//! The edges of a body as written; an edge that is not named is free.

use pd_verify::constraints::{Edge, Edges};
use pd_verify::scene::Wrong;
use schemars::JsonSchema;
use serde::Deserialize;

/// What lies beyond each edge. Default: `free`.
#[derive(Debug, Clone, Copy, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EdgesAsked {
    pub left: Option<Edge>,
    pub right: Option<Edge>,
    /// Of a plate.
    pub bottom: Option<Edge>,
    /// Of a plate.
    pub top: Option<Edge>,
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
        Ok(Edges(std::array::from_fn(|axis| pairs[axis].map(Option::unwrap_or_default))))
    }
}
