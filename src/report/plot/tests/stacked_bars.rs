//! Stacked bars read back: lengths are the data, marks are the sums, the legend is whole, nothing leaves the frame.

use super::clip::Rect;
use super::reader::{Drawing, read};
use super::*;

const COLOURS: [&str; 5] = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9"];
const BLACK: &str = "#000000";
const WHITE: &str = "#FFFFFF";

/// Where the parts of `gallery::budget` lie, added by hand: from and to, bar by bar.
const PLACES: [[(f64, f64); 5]; 3] = [
    [(0.0, 6.3), (-3.1, 0.0), (6.3, 7.9), (-4.0, -3.1), (7.9, 9.0)],
    [(0.0, 2.9), (-2.2, 0.0), (2.9, 4.2), (-2.8, -2.2), (4.2, 5.0)],
    [(-1.7, 0.0), (-3.2, -1.7), (0.0, 1.2), (-3.8, -3.2), (1.2, 1.7)],
];
const SUMS: [f64; 3] = [5.0, 2.2, -2.1];

fn budget() -> StackedBars {
    let Panel::StackedBars(panel) = gallery::budget().panels.remove(0) else { panic!("bars") };
    panel
}

fn small(stacks: Vec<Stack>) -> StackedBars {
    StackedBars::new(Axis::linear("error (%)"), vec!["a".into(), "b".into(), "c".into()], "sum", stacks)
}

/// Areas of this colour inside the frame, from the top down.
fn areas(drawing: &Drawing, fill: &str) -> Vec<Rect> {
    let frame = drawing.frame();
    let one = drawing.polygons.iter().filter(|area| area.fill == fill).map(|area| area.extent());
    let mut inside: Vec<Rect> = one.filter(|area| area.left < frame.right && area.left > 0.0).collect();
    inside.sort_by(|a, b| a.top.total_cmp(&b.top));
    inside
}

/// From a value to its place, by the labels of two ticks.
fn scale(drawing: &Drawing, [a, b]: [f64; 2]) -> impl Fn(f64) -> f64 + use<> {
    let at = |value: f64| {
        let label = value.to_string().replace('-', "−");
        let tick = drawing.texts.iter().find(|text| text.words == label).expect("a tick");
        0.5 * (tick.extent.0 + tick.extent.2)
    };
    let (from, to) = (at(a), at(b));
    move |value| from + (value - a) / (b - a) * (to - from)
}

/// Half a unit each from the two ticks, the place itself, and the label's centre.
const ROUNDING: f64 = 2.0;

#[test]
fn lengths_are_the_data_and_marks_the_sums() {
    let drawing = read(&svg(&gallery::budget()).unwrap());
    let at = scale(&drawing, [-4.0, 8.0]);
    let near = |a: f64, value: f64| assert!((a - at(value)).abs() <= ROUNDING, "{a}, {value}: {}", at(value));
    for (slot, colour) in COLOURS.iter().enumerate() {
        let parts = areas(&drawing, colour);
        assert_eq!(parts.len(), 3, "one in each bar");
        for (part, places) in parts.iter().zip(PLACES) {
            near(part.left, places[slot].0);
            near(part.right, places[slot].1);
        }
    }
    let marks = areas(&drawing, BLACK);
    assert_eq!(marks.len(), 3);
    for ((mark, sum), bar) in marks.iter().zip(SUMS).zip(areas(&drawing, COLOURS[0])) {
        near(0.5 * (mark.left + mark.right), sum);
        assert!((mark.top + mark.bottom - bar.top - bar.bottom).abs() <= 2.0, "in the middle of its bar");
    }
    let frame = drawing.frame();
    let zero: Vec<_> = drawing.curves(BLACK).filter(|line| line.points.len() == 2).collect();
    assert_eq!(zero.len(), 1);
    assert_eq!([zero[0].points[0].1, zero[0].points[1].1], [frame.top, frame.bottom]);
    near(zero[0].points[0].0, 0.0);
}

#[test]
fn every_contribution_and_the_sum_are_in_the_legend_with_their_looks() {
    let drawing = read(&svg(&gallery::budget()).unwrap());
    let frame = drawing.frame();
    let names =
        ["lattice moduli", "dispersion and", "extraction", "reference", "boundary", "sum of contributions"];
    for (name, fill) in names.iter().zip(COLOURS.iter().chain([&BLACK])) {
        let text = drawing.texts.iter().find(|text| text.words == *name).expect(name);
        assert!(text.extent.0 > frame.right);
        let keys: Vec<Rect> =
            drawing.polygons.iter().filter(|a| a.fill == *fill).map(|a| a.extent()).collect();
        let key = keys.iter().find(|key| key.left > frame.right).expect(name);
        assert!(key.right < text.extent.0);
        assert!((key.top + key.bottom - text.extent.1 - text.extent.3).abs() <= 20.0, "{name}: on its line");
    }
    assert!(drawing.says("discretisation"), "the second line of a long name");
    // A contribution that is nowhere still has its name.
    let drawing = drawn(small(vec![Stack { label: "one".into(), parts: vec![Some(1.0), Some(0.0), None] }]));
    assert!(["a", "b", "c", "sum"].iter().all(|name| drawing.texts.iter().any(|text| text.words == *name)));
}

#[test]
fn what_an_axis_does_not_reach_is_cut_at_the_frame_and_said() {
    let mut panel = budget();
    panel.value = panel.value.range(-2.0, 3.0);
    let drawing = drawn(panel);
    let at = scale(&drawing, [-1.0, 2.0]);
    for (slot, colour) in COLOURS.iter().enumerate() {
        let expected: Vec<(f64, f64)> =
            PLACES.iter().map(|bar| bar[slot]).filter(|p| p.0 < 3.0 && p.1 > -2.0).collect();
        let parts = areas(&drawing, colour);
        assert_eq!(parts.len(), expected.len(), "{colour}");
        for (part, (from, to)) in parts.iter().zip(expected) {
            assert!((part.left - at(from.max(-2.0))).abs() <= ROUNDING);
            assert!((part.right - at(to.min(3.0))).abs() <= ROUNDING);
        }
    }
    // Five, four and two parts end beyond −2 or 3, and so do the sums of the first bar and the last.
    assert!(drawing.says("13 points outside the axes"));
    assert_eq!(areas(&drawing, BLACK).len(), 1);
}

#[test]
fn bars_and_their_lines_stay_in_the_frame() {
    for range in [None, Some((-2.0, 3.0)), Some((1.0, 4.0))] {
        let mut panel = budget();
        panel.value.range = range;
        let drawing = drawn(panel);
        let frame = drawing.frame();
        let bars = drawing.polygons.iter().filter(|area| COLOURS.contains(&area.fill.as_str()));
        let lines = drawing.curves(WHITE).chain(drawing.curves(BLACK)).map(|line| &line.points);
        let all = bars.map(|area| &area.points).chain(lines);
        let inside: Vec<_> = all.filter(|points| points[0].0 <= frame.right).collect();
        assert!(inside.len() > 10, "bars, hatches, edges: {}", inside.len());
        for points in inside {
            assert!(points.iter().all(|&point| frame.holds(point)), "{points:?} {frame:?}");
        }
    }
}

#[test]
fn what_is_not_finite_is_left_out_with_the_sum_and_said() {
    let stacks = vec![
        Stack::new("whole", [1.0, 2.0, -1.0]),
        Stack::new("not known", [1.0, f64::NAN, 3.0]),
        Stack { label: "no such part".into(), parts: vec![Some(-1.0), None, Some(4.0)] },
        Stack { label: "nothing".into(), parts: vec![None; 3] },
        Stack::new("infinite", [f64::INFINITY, f64::NEG_INFINITY, 1.0]),
    ];
    assert_eq!(stacks.iter().map(Stack::sum).collect::<Vec<_>>(), [Some(2.0), None, Some(3.0), None, None]);
    let drawing = drawn(small(stacks));
    let at = scale(&drawing, [0.0, 4.0]);
    let counts = [COLOURS[0], COLOURS[1], COLOURS[2], BLACK].map(|fill| areas(&drawing, fill).len());
    assert_eq!(counts, [3, 1, 4, 2]);
    // The third part of the second bar follows its first.
    let part = areas(&drawing, COLOURS[2])[1];
    assert!((part.left - at(1.0)).abs() <= ROUNDING && (part.right - at(4.0)).abs() <= ROUNDING);
    assert!(drawing.says("3 points missing or not finite, 2 sums with a part that is not finite."));
    let whole = drawn(small(vec![Stack { label: "b".into(), parts: vec![Some(1.0), None, Some(2.0)] }]));
    assert!(!whole.says("Not drawn"), "a part that a bar does not have is not missing");
}

#[test]
fn bars_of_one_sign_start_at_the_frame_and_no_bars_are_no_data() {
    for (sign, at_zero) in [(1.0, (|frame: Rect| frame.left) as fn(Rect) -> f64), (-1.0, |frame| frame.right)]
    {
        let drawing = drawn(small(vec![Stack::new("one", [sign, 2.0 * sign, sign])]));
        let frame = drawing.frame();
        let first = areas(&drawing, COLOURS[0])[0];
        assert!([first.left, first.right].contains(&at_zero(frame)));
        assert!(
            areas(&drawing, COLOURS[2]).iter().all(|last| last.left > frame.left && last.right < frame.right)
        );
    }
    for stacks in [vec![], vec![Stack::new("lost", [f64::NAN; 3])]] {
        assert!(drawn(small(stacks)).says("no data"));
    }
    let zero = drawn(small(vec![Stack::new("zero", [0.0; 3])]));
    assert!(!zero.says("no data") && !zero.says("Not drawn"));
    // Ends beyond f64 are drawn nowhere, and nothing breaks.
    assert!(drawn(small(vec![Stack::new("huge", [1e308, 1e308, -1e308])])).says("outside the axes"));
}

#[test]
fn bars_that_do_not_match_their_names_and_logarithms_are_refused() {
    let refused = |panel: StackedBars| svg(&Figure::new("bad", "Bad", "", panel)).unwrap_err();
    let shape = refused(small(vec![Stack::new("short", [1.0, 2.0])]));
    assert_eq!(shape, PlotError::Shape { what: "short".into(), found: 2, expected: 3 });
    let log = StackedBars { value: Axis::log("error (1)"), ..small(vec![]) };
    assert!(matches!(refused(log), PlotError::Range { .. }));
}
