//! In which order pieces of work make several steps in one pass over memory.
//!
//! A task (k, p) makes step k of a pass on piece p: it reads the displacements of level k on the pieces within `lag` of p
//! and writes those of level k + 1 on p, over level k − 1, since two fields take turns. The body is cut into bands, one for
//! each thread. First every band by itself makes what does not need the others, a trapezoid that shrinks by `lag` pieces
//! with each level at each end where another band follows; within a band, step k follows step k − 1 at a distance of `lag`
//! pieces, so that what one has written the next finds in the cache. Then the wedges between bands are filled. What
//! is done at once never touches what another task reads: shown by the tests below, for all shapes.

use std::ops::Range;

/// A pass over a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Schedule {
    pub pieces: usize,
    /// How far a task looks, in pieces.
    pub lag: usize,
    /// Steps in the pass.
    pub levels: usize,
    /// Threads at most.
    pub bands: usize,
}

impl Schedule {
    /// The pass with as many bands and levels as fit, at most those asked for.
    pub fn new(pieces: usize, lag: usize, levels: usize, bands: usize) -> Self {
        let bands = bands.clamp(1, pieces);
        // The trapezoids of inner bands shrink at both ends, and wedges must not meet.
        let most = if bands == 1 { levels } else { 1 + pieces / bands / (2 * lag) };
        Self { pieces, lag, levels: levels.clamp(1, most), bands }
    }

    /// The pieces of a band.
    fn band(&self, band: usize) -> Range<usize> {
        band * self.pieces / self.bands..(band + 1) * self.pieces / self.bands
    }

    /// The tasks of a band, in order; those of different bands may run at once.
    pub fn trapezoid(&self, band: usize) -> impl Iterator<Item = (usize, usize)> + use<> {
        let (own, lag, levels) = (self.band(band), self.lag, self.levels);
        let below = if band == 0 { 0 } else { lag };
        let above = if band + 1 == self.bands { 0 } else { lag };
        let fronts = own.start..own.end + (levels - 1) * lag;
        fronts.flat_map(move |front| {
            let task = move |level: usize| (level, front.wrapping_sub(level * lag));
            let own = own.clone();
            (0..levels).map(task).filter(move |(level, piece)| {
                (own.start + level * below..own.end - level * above).contains(piece)
            })
        })
    }

    /// The tasks between a band and the next, in order; those of different wedges may run at once, after all trapezoids.
    pub fn wedge(&self, band: usize) -> impl Iterator<Item = (usize, usize)> + use<> {
        let (at, lag) = (self.band(band).end, self.lag);
        (1..self.levels)
            .flat_map(move |level| (at - level * lag..at + level * lag).map(move |piece| (level, piece)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Does the tasks on two fields that hold levels in place of displacements, and fails where a task does not find what it
    /// needs.
    fn follow(
        schedule: &Schedule,
        fields: &mut [Vec<usize>; 2],
        tasks: impl Iterator<Item = (usize, usize)>,
    ) -> usize {
        let mut done = 0;
        for (level, piece) in tasks {
            let near = piece.saturating_sub(schedule.lag)..(piece + schedule.lag + 1).min(schedule.pieces);
            for seen in near {
                assert_eq!(fields[level % 2][seen], level, "{schedule:?}: ({level}, {piece}) sees {seen}");
            }
            fields[(level + 1) % 2][piece] = level + 1;
            done += 1;
        }
        done
    }

    fn shapes() -> impl Iterator<Item = Schedule> {
        let sizes = [1, 2, 3, 7, 16, 40, 101];
        sizes.into_iter().flat_map(|pieces| {
            (1..4).flat_map(move |lag| {
                (1..9).flat_map(move |levels| {
                    (1..7).map(move |bands| Schedule::new(pieces, lag, levels, bands))
                })
            })
        })
    }

    #[test]
    fn every_task_finds_its_level_and_all_are_done() {
        for schedule in shapes() {
            // Bands one after the other in either order: none needs or spoils what another does at the same time.
            for backwards in [false, true] {
                let mut fields = [vec![0; schedule.pieces], vec![usize::MAX; schedule.pieces]];
                let order = |count: usize| (0..count).map(move |n| if backwards { count - 1 - n } else { n });
                let mut done = 0;
                for band in order(schedule.bands) {
                    done += follow(&schedule, &mut fields, schedule.trapezoid(band));
                }
                for band in order(schedule.bands - 1) {
                    done += follow(&schedule, &mut fields, schedule.wedge(band));
                }
                assert_eq!(done, schedule.pieces * schedule.levels, "{schedule:?}");
                assert!(fields[schedule.levels % 2].iter().all(|level| *level == schedule.levels));
            }
        }
    }

    /// What a task reads and writes: (field, piece).
    fn touched(
        schedule: &Schedule,
        tasks: impl Iterator<Item = (usize, usize)>,
    ) -> [std::collections::HashSet<(usize, usize)>; 2] {
        let mut sets = [std::collections::HashSet::new(), std::collections::HashSet::new()];
        for (level, piece) in tasks {
            let near = piece.saturating_sub(schedule.lag)..(piece + schedule.lag + 1).min(schedule.pieces);
            sets[0].extend(near.map(|seen| (level % 2, seen)));
            sets[1].insert(((level + 1) % 2, piece));
        }
        sets
    }

    #[test]
    fn what_runs_at_once_writes_nothing_that_others_touch() {
        for schedule in shapes().filter(|schedule| schedule.bands > 1) {
            let bands: Vec<_> =
                (0..schedule.bands).map(|band| touched(&schedule, schedule.trapezoid(band))).collect();
            let wedges: Vec<_> =
                (0..schedule.bands - 1).map(|band| touched(&schedule, schedule.wedge(band))).collect();
            for parts in [bands, wedges] {
                for (a, one) in parts.iter().enumerate() {
                    for other in parts.iter().skip(a + 1) {
                        assert!(
                            one[1].is_disjoint(&other[1]) && one[1].is_disjoint(&other[0]),
                            "{schedule:?}"
                        );
                        assert!(one[0].is_disjoint(&other[1]), "{schedule:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_schedule_without_distance_is_caught() {
        let schedule = Schedule::new(40, 2, 4, 2);
        let hasty = Schedule { lag: 1, ..schedule };
        let mut fields = [vec![0; 40], vec![usize::MAX; 40]];
        let caught = std::panic::catch_unwind(move || follow(&schedule, &mut fields, hasty.trapezoid(0)));
        assert!(caught.is_err());
    }
}
