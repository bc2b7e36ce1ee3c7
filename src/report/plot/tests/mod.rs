//! Figures drawn and read back: what must be inside is inside, what is missing is missing and said so.

mod gallery;
mod reader;
mod stacked_bars;

use super::*;
use reader::{Drawing, read};

fn drawn(panel: impl Into<Panel>) -> Drawing {
    read(&svg(&Figure::new("test", "Test", "A test.", panel)).unwrap())
}

fn lines(series: Vec<Series>) -> Lines {
    Lines::new(Axis::linear("x (m)"), Axis::linear("y (m)"), series)
}

/// Colour of the palette's first slot.
const FIRST: &str = "#0072B2";

#[test]
fn every_figure_is_well_formed_and_the_same_each_time() {
    for figure in gallery::all() {
        let text = svg(&figure).unwrap();
        assert_eq!(text, svg(&figure).unwrap());
        let drawing = read(&text);
        assert!(text.contains("role=\"img\"") && text.contains("<desc"), "{}", figure.id);
        assert_eq!(drawing.texts.iter().filter(|one| one.words == figure.title).count(), {
            usize::from(figure.id != "wordy")
        });
    }
}

#[test]
fn nothing_leaves_the_picture() {
    for figure in gallery::all() {
        let drawing = read(&svg(&figure).unwrap());
        let (wide, high) = drawing.size;
        let areas = drawing.polygons.iter().flat_map(|area| &area.points);
        for (x, y) in drawing.polylines.iter().flat_map(|line| &line.points).chain(areas) {
            assert!((0.0..=wide).contains(x) && (0.0..=high).contains(y), "{}: {x} {y}", figure.id);
        }
        for text in &drawing.texts {
            let (left, top, right, bottom) = text.extent;
            assert!(left >= 0.0 && right <= wide && top >= 0.0 && bottom <= high, "{}: {text:?}", figure.id);
        }
    }
}

#[test]
fn curves_are_cut_at_the_frame() {
    let panel = Lines::new(
        Axis::linear("x (m)").range(0.0, 1.0),
        Axis::linear("y (m)").range(0.0, 1.0),
        vec![Series::line("steep", vec![(-1.0, -2.0), (2.0, 4.0)])],
    );
    let drawing = drawn(panel);
    let frame = drawing.frame();
    let curve = drawing.curves(FIRST).next().unwrap();
    assert_eq!(curve.points.len(), 2);
    assert_eq!(curve.points[0], (frame.left, frame.bottom));
    assert_eq!(curve.points[1].1, frame.top);
    assert!((curve.points[1].0 - 0.5 * (frame.left + frame.right)).abs() <= 1.0);
    assert!(drawing.says("2 points outside the axes"));
}

#[test]
fn a_curve_that_only_passes_by_is_not_drawn() {
    let panel = Lines::new(
        Axis::linear("x (m)").range(0.0, 1.0),
        Axis::linear("y (m)").range(0.0, 1.0),
        vec![Series::both("above", vec![(0.0, 2.0), (1.0, 3.0)])],
    );
    let drawing = drawn(panel);
    let frame = drawing.frame();
    assert!(drawing.curves(FIRST).all(|key| key.points.iter().all(|&(x, _)| x > frame.right)));
    assert!(drawing.says("no data"));
}

#[test]
fn nan_is_a_gap() {
    let gap = vec![(0.0, 0.0), (1.0, 1.0), (2.0, f64::NAN), (3.0, 1.0), (4.0, 0.5)];
    let whole = gap.iter().map(|&(x, y)| (x, if y.is_nan() { 5.0 } else { y })).collect();
    // One more line is the key in the legend.
    assert_eq!(drawn(lines(vec![Series::line("whole", whole)])).curves(FIRST).count(), 2);
    let drawing = drawn(lines(vec![Series::line("gap", gap)]));
    assert_eq!(drawing.curves(FIRST).count(), 3);
    assert!(drawing.says("1 point missing or not finite"));
}

#[test]
fn what_a_logarithm_cannot_show_is_said_and_not_drawn() {
    let points = vec![(1.0, 1e-3), (2.0, 0.0), (3.0, -1.0), (4.0, 1e-1)];
    let panel = Lines::new(Axis::linear("x (m)"), Axis::log("error (1)"), vec![Series::markers("e", points)]);
    let drawing = drawn(panel);
    assert!(drawing.says("2 points not positive (logarithmic axis)"));
    // Two in the frame and one in the legend.
    assert_eq!(drawing.circles(FIRST), 3);
}

#[test]
fn complete_data_has_no_note() {
    assert!(!drawn(lines(vec![Series::line("all", vec![(0.0, 0.0), (1.0, 1.0)])])).says("Not drawn"));
}

#[test]
fn a_log_axis_under_one_decade_has_labels() {
    let narrow = Series::line("narrow", vec![(0.0, 1.2), (1.0, 1.9)]);
    let drawing = drawn(Lines::new(Axis::linear("x (m)"), Axis::log("ratio (1)"), vec![narrow]));
    for label in ["1.2", "1.4", "1.6", "1.8"] {
        assert!(drawing.texts.iter().any(|text| text.words == label), "{label}");
    }
    let tiny = Series::line("tiny", vec![(0.0, 1e-16), (1.0, 1e-14)]);
    let drawing = drawn(Lines::new(Axis::linear("x (m)"), Axis::log("error (1)"), vec![tiny]));
    for label in ["10⁻¹⁶", "10⁻¹⁵", "10⁻¹⁴"] {
        assert!(drawing.texts.iter().any(|text| text.words == label), "{label}");
    }
}

#[test]
fn the_legend_is_outside_the_frame() {
    for figure in [gallery::dispersion(), gallery::convergence(), gallery::wordy()] {
        let drawing = read(&svg(&figure).unwrap());
        let frame = drawing.frame();
        let Panel::Lines(panel) = &figure.panels[0] else { panic!("lines") };
        for series in &panel.series {
            let start = series.label.split(' ').next().unwrap();
            let names: Vec<_> = drawing.texts.iter().filter(|text| text.words.starts_with(start)).collect();
            assert!(names.iter().any(|n| n.extent.0 > frame.right || n.extent.1 > frame.bottom), "{start}");
        }
    }
}

#[test]
fn texts_do_not_lie_on_each_other() {
    for figure in gallery::all() {
        let drawing = read(&svg(&figure).unwrap());
        for (i, a) in drawing.texts.iter().enumerate() {
            for b in &drawing.texts[i + 1..] {
                assert!(!a.overlaps(b), "{}: {a:?} and {b:?}", figure.id);
            }
        }
    }
}

#[test]
fn panels_share_a_legend_only_where_it_means_the_same() {
    let panel = |name: &str| lines(vec![Series::line(name, vec![(0.0, 0.0), (1.0, 1.0)])]);
    let count = |a: &str, b: &str| {
        let figure = Figure::new("two", "Two", "", panel(a)).panel(panel(b)).columns(2);
        let drawing = read(&svg(&figure).unwrap());
        drawing.texts.iter().filter(|text| [a, b].contains(&text.words.as_str())).count()
    };
    assert_eq!((count("same", "same"), count("one", "other")), (1, 2));
}

#[test]
fn a_slope_triangle_has_its_slope() {
    let points: Vec<(f64, f64)> = (0..4).map(|i| 10f64.powi(-i)).map(|h| (h, h * h)).collect();
    let panel = Lines::new(Axis::log("h (m)"), Axis::log("error (1)"), vec![Series::line("e", points)])
        .guide(Guide::Slope { order: 2.0, label: "order 2".into() });
    let drawing = drawn(panel);
    let curve = drawing.curves(FIRST).next().unwrap();
    let triangle = drawing.polylines.iter().find(|line| line.points.len() == 4).unwrap();
    let slope = |a: (f64, f64), b: (f64, f64)| (b.1 - a.1) / (b.0 - a.0);
    let ratio = slope(triangle.points[0], triangle.points[2])
        / slope(curve.points[0], curve.points[curve.points.len() - 1]);
    assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
}

#[test]
fn a_polar_curve_stays_in_its_disc() {
    let points = (0..=360).map(|a| (f64::from(a), f64::from(a) / 100.0)).collect();
    let radial = Axis::linear("error (%)").range(1.0, 2.0);
    let drawing = drawn(Polar::new(radial, vec![Series::line("spiral", points)]));
    let &(cx, cy, radius) = drawing.rings.iter().max_by(|a, b| a.2.total_cmp(&b.2)).unwrap();
    let curve = drawing.curves(FIRST).next().unwrap();
    let far = |&(x, y): &(f64, f64)| (x - cx).hypot(y - cy);
    assert!(curve.points.iter().all(|point| far(point) <= radius + 2.0));
    assert!(curve.points.iter().any(|point| far(point) > radius - 2.0));
    assert!(drawing.says("outside the axes"));
}

#[test]
fn cells_without_a_value_are_hatched_and_the_rest_is_printed() {
    let drawing = read(&svg(&gallery::orders()).unwrap());
    assert!(drawing.says("Hatched: no value."));
    assert!(drawing.says("1 point missing or not finite"));
    let printed = |words: &str| drawing.texts.iter().any(|text| text.words == words);
    assert!(printed("2.32") && !printed("NaN") && !printed("–"));
}

#[test]
fn the_cells_of_a_raster_fill_its_frame_once() {
    for figure in [gallery::space_time(), gallery::fields()] {
        let drawing = read(&svg(&figure).unwrap());
        let frame = drawing.frame();
        let inside: Vec<_> = drawing.cells.iter().filter(|(_, cell)| cell.left < frame.right).collect();
        let area: f64 = inside.iter().map(|(_, cell)| cell.width() * cell.height()).sum();
        assert!((area - frame.width() * frame.height()).abs() < 1.0, "{}: {area}", figure.id);
        for (_, cell) in inside {
            assert!(frame.holds((cell.left, cell.top)) && frame.holds((cell.right, cell.bottom)));
        }
    }
}

#[test]
fn a_raster_shows_low_y_below_and_missing_cells_grey() {
    let values = vec![vec![Some(0.0), Some(1.0)], vec![Some(f64::NAN), None]];
    let field =
        |values| Raster::new(Axis::linear("x (m)"), Axis::linear("t (s)"), Axis::linear("u (m)"), values);
    let drawing = drawn(field(values));
    let frame = drawing.frame();
    let (wide, high) = (0.5 * frame.width(), 0.5 * frame.height());
    let cell = |x: f64, y: f64| {
        let at = (frame.left + x * wide, frame.bottom - y * high);
        drawing.cells.iter().find(|(_, cell)| cell.holds(at)).unwrap().0.clone()
    };
    assert_eq!([cell(0.5, 1.5), cell(1.5, 1.5)], ["#B0B0B0"; 2]);
    assert_eq!([cell(0.5, 0.5), cell(1.5, 0.5)], ["#440154", "#FDE725"], "the ends of the scale");
    assert!(drawing.says("Grey: no value.") && drawing.says("1 point missing or not finite"));
    let note = |value: f64| drawn(field(vec![vec![Some(value); 3]])).says("no value");
    assert_eq!([note(2.0), note(f64::INFINITY)], [false, true]);
}

#[test]
fn a_raster_to_scale_has_the_shape_of_its_body() {
    for (length, height) in [(0.1, 0.08), (0.2, 0.03), (0.02, 0.1)] {
        let place = |end: f64| Axis::linear("x (m)").range(0.0, end);
        let values = vec![vec![Some(1.0), None]; 2];
        let raster = Raster::new(place(length), place(height), Axis::linear("u (m)"), values);
        let frame = drawn(raster.clone().to_scale()).frame();
        // In whole tenths of pixels.
        let apart = |frame: clip::Rect| (frame.width() - frame.height() * length / height).abs();
        assert!(apart(frame) <= 2.0 * (1.0 + length / height), "{frame:?}");
        assert!(frame.height() <= 4001.0 && (frame.width() > 5000.0 || frame.height() > 3990.0), "{frame:?}");
        assert!(apart(drawn(raster).frame()) > 80.0);
    }
}

#[test]
fn a_space_time_plot_is_a_small_file() {
    let text = svg(&gallery::space_time()).unwrap();
    assert!(text.len() < 150_000, "{} bytes for 200 × 150 cells", text.len());
    assert!(text.contains("crispEdges"));
}

#[test]
fn impossible_figures_are_refused() {
    let none = Figure { panels: Vec::new(), ..gallery::orders() };
    assert_eq!(svg(&none), Err(PlotError::Empty));
    let refused = |panel: Panel| svg(&Figure::new("bad", "Bad", "", panel)).unwrap_err();
    let map = HeatMap::new(("x", vec!["a".into()]), ("y", vec!["b".into()]), Axis::linear("v"), vec![vec![]]);
    assert!(matches!(refused(map.into()), PlotError::Shape { found: 0, expected: 1, .. }));
    let raster = |rows| Raster::new(Axis::linear("x"), Axis::linear("y"), Axis::linear("v"), rows);
    assert_eq!(refused(raster(vec![]).into()), PlotError::Empty);
    assert!(matches!(
        refused(raster(vec![vec![None; 2], vec![None]]).into()),
        PlotError::Shape { found: 1, expected: 2, .. }
    ));
    let dots = Dots::new(Axis::linear("v"), vec!["g".into()], vec![Category::new("c", [1.0, 2.0])]);
    assert!(matches!(refused(dots.into()), PlotError::Shape { found: 2, expected: 1, .. }));
    let slope = lines(vec![]).guide(Guide::Slope { order: 2.0, label: "2".into() });
    assert!(matches!(refused(slope.into()), PlotError::Slope { .. }));
    let range = Lines::new(Axis::log("x").range(0.0, 1.0), Axis::linear("y"), vec![]);
    assert!(matches!(refused(range.into()), PlotError::Range { .. }));
}
