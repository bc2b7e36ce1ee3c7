//! What cuts bonds, notches and holes, found by place: the body is covered with tiles that know what touches them, so that a
//! bond asks the few that are near and not all.

use crate::scene::{Hole, Notch};

/// Side of a tile, in spacings.
const SIDE: f64 = 16.0;

/// How far around itself a notch or a hole is known, in spacings: more than ties need.
const MARGIN: f64 = 1.0;

/// A notch or a hole.
#[derive(Debug, Clone, Copy)]
enum Obstacle {
    Notch(Notch),
    Hole(Hole),
}

/// Notches and holes of a body, with their images.
#[derive(Debug, Clone)]
pub struct Obstacles {
    all: Vec<Obstacle>,
    /// Places in `all` of what touches a tile, row by row.
    tiles: Vec<Vec<u32>>,
    /// Tiles along each axis.
    counts: [usize; 2],
    /// Δx in m.
    spacing: f64,
}

impl Obstacles {
    /// Of a body of a size in m, from the origin; what lies beyond it belongs to the tiles at its border.
    pub fn new(notches: Vec<Notch>, holes: Vec<Hole>, size: [f64; 2], spacing: f64) -> Self {
        let all: Vec<Obstacle> =
            notches.into_iter().map(Obstacle::Notch).chain(holes.into_iter().map(Obstacle::Hole)).collect();
        let count =
            |size: f64| if all.is_empty() { 0 } else { (size / (SIDE * spacing)).ceil().max(1.0) as usize };
        let counts = size.map(count);
        let mut obstacles = Self { tiles: vec![Vec::new(); counts[0] * counts[1]], all, counts, spacing };
        let margin = MARGIN * spacing;
        for (index, obstacle) in obstacles.all.clone().into_iter().enumerate() {
            let [from, to] = obstacle.bounds();
            for row in obstacles.tile(1, from[1] - margin)..=obstacles.tile(1, to[1] + margin) {
                let [low, high] = obstacles.band(row);
                let [left, right] = obstacle.width_between(low - margin, high + margin);
                for column in obstacles.tile(0, left - margin)..=obstacles.tile(0, right + margin) {
                    obstacles.tiles[row * counts[0] + column].push(index as u32);
                }
            }
        }
        obstacles
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// Whether one cuts the bond from a to b.
    pub fn cut(&self, a: [f64; 2], b: [f64; 2]) -> bool {
        let low = [0, 1].map(|axis| a[axis].min(b[axis]));
        let high = [0, 1].map(|axis| a[axis].max(b[axis]));
        self.near(low, high).any(|obstacle| obstacle.cuts(a, b, self.spacing))
    }

    /// Whether surely none cuts a bond that lies in a box, said from bounding boxes.
    pub fn clear(&self, low: [f64; 2], high: [f64; 2]) -> bool {
        let margin = MARGIN * self.spacing;
        self.near(low, high).all(|obstacle| {
            let [from, to] = obstacle.bounds();
            (0..2).any(|axis| high[axis] < from[axis] - margin || low[axis] > to[axis] + margin)
        })
    }

    /// Those that touch the tiles of a box; one may come several times.
    fn near(&self, low: [f64; 2], high: [f64; 2]) -> impl Iterator<Item = &Obstacle> {
        let tiles = |axis: usize| match self.counts[axis] {
            0 => 0..0,
            _ => self.tile(axis, low[axis])..self.tile(axis, high[axis]) + 1,
        };
        let (columns, rows) = (tiles(0), tiles(1));
        rows.flat_map(move |row| columns.clone().map(move |column| row * self.counts[0] + column))
            .flat_map(|tile| self.tiles[tile].iter().map(|&index| &self.all[index as usize]))
    }

    /// The tile of a coordinate, the first or the last beyond the body.
    fn tile(&self, axis: usize, at: f64) -> usize {
        ((at / (SIDE * self.spacing)).max(0.0) as usize).min(self.counts[axis] - 1)
    }

    /// From where to where a row of tiles reaches, in m; the first and the last go on without end.
    fn band(&self, row: usize) -> [f64; 2] {
        let at = |row: usize| row as f64 * SIDE * self.spacing;
        let low = if row == 0 { f64::NEG_INFINITY } else { at(row) };
        let high = if row + 1 == self.counts[1] { f64::INFINITY } else { at(row + 1) };
        [low, high]
    }
}

impl Obstacle {
    fn cuts(&self, a: [f64; 2], b: [f64; 2], spacing: f64) -> bool {
        match self {
            Self::Notch(notch) => notch.cuts(a, b, spacing),
            Self::Hole(hole) => hole.cuts(a, b, spacing),
        }
    }

    /// The corners of its box.
    fn bounds(&self) -> [[f64; 2]; 2] {
        match self {
            Self::Notch(notch) => notch.bounds(),
            Self::Hole(hole) => hole.bounds(),
        }
    }

    /// From where to where along x it reaches between two heights.
    fn width_between(&self, low: f64, high: f64) -> [f64; 2] {
        let [from, to] = self.bounds();
        match self {
            Self::Notch(notch) if to[1] > from[1] => {
                let at = |y: f64| {
                    let share = (y.clamp(from[1], to[1]) - notch.from[1]) / (notch.to[1] - notch.from[1]);
                    notch.from[0] + share * (notch.to[0] - notch.from[0])
                };
                let ends = [at(low), at(high)];
                [ends[0].min(ends[1]), ends[0].max(ends[1])]
            }
            _ => [from[0], to[0]],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: [f64; 2] = [0.11, 0.07];
    const SPACING: f64 = 1e-3;

    /// The n-th of a sequence that fills a square from −1 to 1 evenly (Roberts 2018, R₂).
    fn even(n: usize) -> [f64; 2] {
        [0.754_877_666_246_692_7, 0.569_840_290_998_053_2].map(|step| 2.0 * (n as f64 * step).fract() - 1.0)
    }

    /// In and around the body.
    fn place(n: usize) -> [f64; 2] {
        let at = even(n);
        [0, 1].map(|axis| SIZE[axis] * (0.5 + 0.8 * at[axis]))
    }

    /// Many notches and holes, some beyond the body; bonds everywhere.
    #[test]
    fn what_is_near_is_all_that_cuts() {
        let upright = |at: [f64; 2]| Notch { from: at, to: [at[0], at[1] + 0.02] };
        let level = |at: [f64; 2]| Notch { from: at, to: [at[0] - 0.03, at[1]] };
        let mut notches: Vec<Notch> =
            (0..40).map(|n| Notch { from: place(n), to: place(3 * n + 100) }).collect();
        notches.extend((500..520).flat_map(|n| [upright(place(n)), level(place(n + 50))]));
        let holes: Vec<Hole> =
            (1..11).map(|n| Hole { centre: place(700 + n), radius: n as f64 * 1e-3 }).collect();
        let obstacles = Obstacles::new(notches.clone(), holes.clone(), SIZE, SPACING);
        let mut cut = 0;
        for n in 0..20_000 {
            let (a, along) = (place(n), even(7 * n + 13));
            let b = [0, 1].map(|axis| a[axis] + 20.0 * SPACING * along[axis]);
            let by_all = notches.iter().any(|notch| notch.cuts(a, b, SPACING))
                || holes.iter().any(|hole| hole.cuts(a, b, SPACING));
            assert_eq!(obstacles.cut(a, b), by_all, "{a:?} {b:?}");
            let [low, high] = [f64::min, f64::max].map(|pick| [0, 1].map(|axis| pick(a[axis], b[axis])));
            assert!(!(by_all && obstacles.clear(low, high)), "{a:?} {b:?}");
            cut += u32::from(by_all);
        }
        assert!((1000..19_000).contains(&cut), "{cut}");
    }

    /// A diagonal touches the tiles along it, not all those of its box.
    #[test]
    fn tiles_know_what_touches_them_only() {
        let side = 64.0 * SIDE * SPACING;
        let diagonal = Notch { from: [0.0; 2], to: [side; 2] };
        let obstacles = Obstacles::new(vec![diagonal], Vec::new(), [side; 2], SPACING);
        let known = obstacles.tiles.iter().filter(|tile| !tile.is_empty()).count();
        assert!((64..256).contains(&known), "{known}");
        assert!(obstacles.clear([0.9 * side, 0.0], [side, 0.1 * side]));
    }

    #[test]
    fn nothing_cuts_nothing() {
        let none = Obstacles::new(Vec::new(), Vec::new(), SIZE, SPACING);
        assert!(none.is_empty() && !none.cut([0.0; 2], SIZE) && none.clear([0.0; 2], SIZE));
    }
}
