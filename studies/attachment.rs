//! Files of a folder of results: their names, and their bytes when they are to be written.

use pd_verify::record::Snapshot;
use pd_verify::report::{npy, vti};
use std::borrow::Cow;
use std::sync::Arc;

/// A file. Snapshots become bytes only when asked for, so that none is in memory twice.
#[derive(Debug, Clone)]
pub struct Attachment {
    pub name: String,
    content: Content,
}

#[derive(Debug, Clone)]
enum Content {
    Text(String),
    Vti(Arc<Snapshot>),
    Displacement(Arc<Snapshot>),
    Velocity(Arc<Snapshot>),
}

impl Attachment {
    pub fn text(name: impl Into<String>, text: impl Into<String>) -> Self {
        Self { name: name.into(), content: Content::Text(text.into()) }
    }

    /// All fields of a snapshot in a file of VTK: `base.vti`.
    pub fn vti(base: &str, snapshot: &Arc<Snapshot>) -> Self {
        Self { name: format!("{base}.vti"), content: Content::Vti(snapshot.clone()) }
    }

    /// The fields of a snapshot as arrays of NumPy, in a file each: `base.displacement.npy`, `base.velocity.npy`.
    pub fn npy(base: &str, snapshot: &Arc<Snapshot>) -> [Self; 2] {
        let of = |field: &str, content| Self { name: format!("{base}.{field}.npy"), content };
        [
            of("displacement", Content::Displacement(snapshot.clone())),
            of("velocity", Content::Velocity(snapshot.clone())),
        ]
    }

    pub fn bytes(&self) -> Cow<'_, [u8]> {
        match &self.content {
            Content::Text(text) => Cow::Borrowed(text.as_bytes()),
            Content::Vti(snapshot) => vti(snapshot).into(),
            Content::Displacement(snapshot) => npy(&snapshot.nodes, &snapshot.displacement).into(),
            Content::Velocity(snapshot) => npy(&snapshot.nodes, &snapshot.velocity).into(),
        }
    }
}
