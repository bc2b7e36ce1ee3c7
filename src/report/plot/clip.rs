//! Curves cut at the plot's frame: what is outside is not drawn, what is missing leaves a gap.

/// A point on the canvas: right, down.
pub(super) type Point = (f64, f64);

/// A rectangle on the canvas.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rect {
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
}

impl Rect {
    pub fn width(&self) -> f64 {
        self.right - self.left
    }

    pub fn height(&self) -> f64 {
        self.bottom - self.top
    }

    /// Whether the point is inside or on the edge; a NaN is not.
    pub fn holds(&self, (x, y): Point) -> bool {
        (self.left..=self.right).contains(&x) && (self.top..=self.bottom).contains(&y)
    }
}

/// The visible parts of the line through the points. A point that is not finite ends a part; a point with no
/// neighbour is a part of its own.
pub(super) fn clip(points: &[Point], frame: Rect) -> Vec<Vec<Point>> {
    let mut parts: Vec<Vec<Point>> = Vec::new();
    let finite = |i: usize| points.get(i).is_some_and(|p| p.0.is_finite() && p.1.is_finite());
    for i in 0..points.len() {
        if !finite(i) {
            continue;
        }
        let alone = !finite(i + 1) && (i == 0 || !finite(i - 1));
        if alone && frame.holds(points[i]) {
            parts.push(vec![points[i]]);
        }
        if !finite(i + 1) {
            continue;
        }
        let Some((a, b)) = clip_segment(points[i], points[i + 1], frame) else { continue };
        // A part goes on only where this segment starts at the very point where the last one ended.
        match parts.last_mut() {
            Some(part) if i > 0 && finite(i - 1) && part.last() == Some(&a) => part.push(b),
            _ => parts.push(vec![a, b]),
        }
    }
    parts
}

/// The part of a segment inside the frame, if any (Liang and Barsky, ACM Trans. Graph. 3, 1984).
fn clip_segment(a: Point, b: Point, frame: Rect) -> Option<(Point, Point)> {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    let edges =
        [(-dx, a.0 - frame.left), (dx, frame.right - a.0), (-dy, a.1 - frame.top), (dy, frame.bottom - a.1)];
    for (speed, room) in edges {
        if speed == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if speed < 0.0 {
            enter = enter.max(room / speed);
        } else {
            leave = leave.min(room / speed);
        }
    }
    if enter > leave || !dx.is_finite() || !dy.is_finite() {
        return None;
    }
    // The clamp removes only the rounding of `a + t d`: with far endpoints that can be more than a pixel.
    let at = |t: f64| {
        let x = (a.0 + t * dx).clamp(frame.left, frame.right);
        let y = (a.1 + t * dy).clamp(frame.top, frame.bottom);
        (x, y)
    };
    let start = if enter == 0.0 { a } else { at(enter) };
    let end = if leave == 1.0 { b } else { at(leave) };
    Some((start, end))
}

/// The line with fewer points, nowhere farther than `tolerance` from the given one (Ramer, Douglas, Peucker).
pub(super) fn simplify(points: &[Point], tolerance: f64) -> Vec<Point> {
    if points.len() < 3 {
        return points.to_vec();
    }
    let mut keep = vec![false; points.len()];
    keep[0] = true;
    keep[points.len() - 1] = true;
    let mut open = vec![(0, points.len() - 1)];
    while let Some((first, last)) = open.pop() {
        let (mut far, mut worst) = (first, tolerance);
        for (i, &point) in points.iter().enumerate().take(last).skip(first + 1) {
            let distance = distance_to_segment(point, points[first], points[last]);
            if distance > worst {
                (far, worst) = (i, distance);
            }
        }
        if far != first {
            keep[far] = true;
            open.push((first, far));
            open.push((far, last));
        }
    }
    points.iter().zip(keep).filter(|(_, keep)| *keep).map(|(point, _)| *point).collect()
}

fn distance_to_segment(p: Point, a: Point, b: Point) -> f64 {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let square = dx * dx + dy * dy;
    let t = if square > 0.0 { ((p.0 - a.0) * dx + (p.1 - a.1) * dy) / square } else { 0.0 };
    let t = t.clamp(0.0, 1.0);
    let (x, y) = (p.0 - a.0 - t * dx, p.1 - a.1 - t * dy);
    (x * x + y * y).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FRAME: Rect = Rect { left: 0.0, top: 0.0, right: 10.0, bottom: 10.0 };

    #[test]
    fn a_line_through_the_frame_is_cut_where_it_crosses() {
        let parts = clip(&[(-5.0, 0.0), (15.0, 10.0)], FRAME);
        assert_eq!(parts, vec![vec![(0.0, 2.5), (10.0, 7.5)]]);
    }

    #[test]
    fn a_line_past_a_corner_is_not_drawn() {
        assert!(clip(&[(-5.0, 1.0), (1.0, -5.0)], FRAME).is_empty());
    }

    #[test]
    fn leaving_and_coming_back_makes_two_parts() {
        let parts = clip(&[(1.0, 5.0), (3.0, 15.0), (5.0, 5.0)], FRAME);
        assert_eq!(parts, vec![vec![(1.0, 5.0), (2.0, 10.0)], vec![(4.0, 10.0), (5.0, 5.0)]]);
    }

    #[test]
    fn nan_makes_a_gap_and_a_lonely_point_stays() {
        let nan = (f64::NAN, 1.0);
        let parts = clip(&[(1.0, 1.0), (2.0, 1.0), nan, (4.0, 1.0), nan, (6.0, 1.0), (7.0, 1.0)], FRAME);
        assert_eq!(parts, vec![vec![(1.0, 1.0), (2.0, 1.0)], vec![(4.0, 1.0)], vec![(6.0, 1.0), (7.0, 1.0)]]);
    }

    #[test]
    fn far_away_points_do_not_leave_the_frame() {
        for part in clip(&[(5.0, 5.0), (1e17, 3e17), (-1e17, 5.0)], FRAME) {
            assert!(part.iter().all(|&p| FRAME.holds(p)), "{part:?}");
        }
    }

    #[test]
    fn simplifying_keeps_corners_and_drops_what_is_straight() {
        let points = [(0.0, 0.0), (1.0, 0.001), (2.0, 0.0), (3.0, 0.0), (3.0, 4.0)];
        assert_eq!(simplify(&points, 0.01), vec![(0.0, 0.0), (3.0, 0.0), (3.0, 4.0)]);
    }
}
