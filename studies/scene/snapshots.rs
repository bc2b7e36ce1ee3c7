//! Snapshots of a plate as written, and the files and figures that they become.

use super::figures::shown;
use super::march::{MarchAsked, Marched};
use super::probes::check_name;
use super::snapshot_figure::figure;
use crate::attachment::Attachment;
use crate::bar::names::slug;
use crate::input::OneOrMany;
use crate::question::Place;
use pd_verify::record::{LAST_SOUND, Record, Snapshot};
use pd_verify::report::plot::Figure;
use pd_verify::report::pvd;
use pd_verify::scene::{Snapshots, Wrong};
use schemars::JsonSchema;
use serde::Deserialize;
use std::sync::Arc;

/// A format of files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Format {
    /// ImageData of VTK, one file for each time, and a `.pvd` that lists them for ParaView.
    Vti,
    /// Arrays of NumPy, shape (ny, nx, 2): displacement and velocity of each time.
    Npy,
}

/// Snapshots as written.
#[derive(Debug, Clone, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SnapshotAsked {
    /// Part of the names of its files.
    pub name: String,
    /// Rising; each is taken at the nearest step.
    pub at_s: OneOrMany<f64>,
    /// Default: both.
    pub formats: Option<Vec<Format>>,
    /// Whether to draw the displacements, at up to 6 of the times. Default `true`.
    pub picture: Option<bool>,
}

/// What the snapshots of a case may be on disk together.
const MAX_BYTES: u64 = 4 << 30;
const MAX_FILES: usize = 10_000;

impl SnapshotAsked {
    fn has(&self, format: Format) -> bool {
        self.formats.as_ref().is_none_or(|formats| formats.contains(&format))
    }

    fn pictured(&self) -> bool {
        self.picture.unwrap_or(true)
    }

    fn check(&self) -> Result<(), Wrong> {
        check_name(&self.name)?;
        if self.name == LAST_SOUND {
            let message = "the body at the last sound look of a march that diverges is called so";
            return Err(Wrong::new("name", message, "choose another name"));
        }
        if self.formats.as_ref().is_some_and(Vec::is_empty) && !self.pictured() {
            let message = "these snapshots are neither written nor drawn";
            return Err(Wrong::new("formats", message, "name a format, or leave picture = false out"));
        }
        Ok(())
    }

    /// Bytes on disk for each byte of displacement and velocity: VTK has a third component.
    fn bytes_per_byte(&self) -> f64 {
        1.5 * f64::from(self.has(Format::Vti)) + f64::from(self.has(Format::Npy))
    }

    fn files(&self) -> usize {
        let each = usize::from(self.has(Format::Vti)) + 2 * usize::from(self.has(Format::Npy));
        each * self.at_s.0.len() + usize::from(self.has(Format::Vti))
    }
}

/// The snapshots of a case of `D` dimensions as a scene has them.
pub fn asked<const D: usize>(case: &MarchAsked) -> Result<Vec<Snapshots>, Wrong> {
    let written = case.snapshot.as_deref().unwrap_or_default();
    if D == 1 && !written.is_empty() {
        let help = "a probe that watches a line sees the whole bar: watches = \"line\"";
        return Err(Wrong::new("snapshot", "a bar has no snapshots", help));
    }
    let of = |(index, one): (usize, &SnapshotAsked)| {
        let path = format!("snapshot[{index}]");
        one.check().map_err(|wrong| wrong.inside(&path))?;
        if case.probe.iter().any(|probe| probe.name == one.name) {
            let message = format!("a probe of this case is called \"{}\" too", one.name);
            return Err(Wrong::new(format!("{path}.name"), message, "give each its own name"));
        }
        Ok(Snapshots { name: one.name.clone(), times: one.at_s.0.clone() })
    };
    written.iter().enumerate().map(of).collect()
}

/// Refuses more files than a folder should have, and larger ones than a disk should be filled with.
pub fn check_files(case: &MarchAsked, scenes: &[Marched]) -> Result<(), Wrong> {
    let written = case.snapshot.as_deref().unwrap_or_default();
    let times: usize = written.iter().map(|one| one.at_s.0.len()).sum();
    let files = scenes.len().saturating_mul(written.iter().map(SnapshotAsked::files).sum());
    if files > MAX_FILES {
        let message = format!("{files} files of snapshots are asked for, at most {MAX_FILES} are written");
        return Err(Wrong::new("snapshot[0].at_s", message, "take fewer times, or one format"));
    }
    let per_time = |one: &Marched| one.plan.snapshot_bytes as f64 / times.max(1) as f64;
    let share: f64 = written.iter().map(|one| one.bytes_per_byte() * one.at_s.0.len() as f64).sum();
    let bytes = scenes.iter().map(per_time).sum::<f64>() * share;
    if bytes > MAX_BYTES as f64 {
        let gib = (1_u64 << 30) as f64;
        let message = format!(
            "the snapshots would be {:.1} GiB on disk, at most {} GiB are written by a case",
            bytes / gib,
            MAX_BYTES as f64 / gib
        );
        let help = "take fewer times or lattices, one format, or a larger spacing";
        return Err(Wrong::new("snapshot[0].at_s", message, help));
    }
    Ok(())
}

/// What snapshots of a scene are called: after their case, themselves, and the lattice where there are several.
fn base(place: &Place, snapshots: &str, scene: &Marched, alone: bool) -> String {
    let lattice = if alone { String::new() } else { format!(".{}", slug(scene.scene.lattice())) };
    format!("{}.{snapshots}{lattice}", place.case)
}

/// A figure for each name and scene.
pub fn figures(
    title: &str,
    written: &[SnapshotAsked],
    ran: &[(&Marched, &Record)],
    alone: bool,
    place: &Place,
) -> Vec<Figure> {
    let mut figures = Vec::new();
    for one in written.iter().filter(|one| one.pictured()) {
        for (scene, record) in ran {
            let taken: Vec<&Snapshot> =
                record.snapshots.iter().filter(|taken| taken.name == one.name).collect();
            let few: Vec<&Snapshot> = shown(taken.len()).into_iter().map(|index| taken[index]).collect();
            let of = if alone { String::new() } else { format!(", {}", record.plan.name) };
            let title = format!("{title}: {}{of}", one.name);
            figures.extend(figure(base(place, &one.name, scene, alone), title, &few, taken.len()));
        }
    }
    figures
}

/// The files of a scene's snapshots, which they take over.
pub fn files(
    written: &[SnapshotAsked],
    scene: &Marched,
    snapshots: Vec<Snapshot>,
    alone: bool,
    place: &Place,
) -> Vec<Attachment> {
    let mut files = Vec::new();
    let snapshots: Vec<Arc<Snapshot>> = snapshots.into_iter().map(Arc::new).collect();
    for one in written {
        let base = base(place, &one.name, scene, alone);
        let taken = || snapshots.iter().filter(|taken| taken.name == one.name);
        let file = |snapshot: &Snapshot| format!("{base}.{:03}", snapshot.index);
        if one.has(Format::Vti) {
            let names: Vec<(f64, String)> =
                taken().map(|taken| (taken.time, format!("{}.vti", file(taken)))).collect();
            let list = pvd(names.iter().map(|(time, name)| (*time, name.as_str())));
            files.push(Attachment::text(format!("{base}.pvd"), list));
            files.extend(taken().map(|taken| Attachment::vti(&file(taken), taken)));
        }
        if one.has(Format::Npy) {
            files.extend(taken().flat_map(|taken| Attachment::npy(&file(taken), taken)));
        }
    }
    files
}
