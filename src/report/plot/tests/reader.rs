//! Reads back the SVG that the figures are written as, and refuses what is not well-formed.

use crate::report::plot::clip::Rect;
use crate::report::plot::text::width;

/// What was found in a picture, in its own units (ten to a pixel).
#[derive(Debug, Default)]
pub struct Drawing {
    pub size: (f64, f64),
    pub polylines: Vec<Polyline>,
    /// Filled areas; the first is the ground.
    pub polygons: Vec<Polygon>,
    pub texts: Vec<Words>,
    /// Centre and radius of what is not filled.
    pub rings: Vec<(f64, f64, f64)>,
    /// Rectangles drawn together, with their colour.
    pub cells: Vec<(String, Rect)>,
    filled: Vec<String>,
}

#[derive(Debug)]
pub struct Polyline {
    pub points: Vec<(f64, f64)>,
    pub stroke: String,
}

#[derive(Debug)]
pub struct Polygon {
    pub points: Vec<(f64, f64)>,
    pub fill: String,
}

impl Polygon {
    /// The smallest upright rectangle around it.
    pub fn extent(&self) -> Rect {
        let (x, y) = (self.points.iter().map(|p| p.0), self.points.iter().map(|p| p.1));
        let (left, right) = (x.clone().fold(f64::INFINITY, f64::min), x.fold(f64::NEG_INFINITY, f64::max));
        let (top, bottom) = (y.clone().fold(f64::INFINITY, f64::min), y.fold(f64::NEG_INFINITY, f64::max));
        Rect { left, top, right, bottom }
    }
}

#[derive(Debug)]
pub struct Words {
    pub words: String,
    /// Left, top, right, bottom by the estimated width.
    pub extent: (f64, f64, f64, f64),
}

impl Words {
    pub fn overlaps(&self, other: &Self) -> bool {
        let (a, b) = (self.extent, other.extent);
        a.0 < b.2 && b.0 < a.2 && a.1 < b.3 && b.1 < a.3
    }
}

impl Drawing {
    /// Lines of this colour.
    pub fn curves<'a>(&'a self, stroke: &'a str) -> impl Iterator<Item = &'a Polyline> {
        self.polylines.iter().filter(move |line| line.stroke == stroke)
    }

    /// How many filled circles have this colour.
    pub fn circles(&self, fill: &str) -> usize {
        self.filled.iter().filter(|one| *one == fill).count()
    }

    /// The first closed rectangle that is drawn as a line of the frame's colour.
    pub fn frame(&self) -> Rect {
        let closed = |line: &&Polyline| line.points.len() == 5 && line.points[0] == line.points[4];
        let line = self.curves("#282828").find(closed);
        let points = &line.expect("a frame").points;
        Rect { left: points[0].0, top: points[0].1, right: points[2].0, bottom: points[2].1 }
    }

    pub fn says(&self, words: &str) -> bool {
        self.texts.iter().any(|text| text.words.contains(words))
    }
}

/// Reads a picture; panics where it is not well-formed.
pub fn read(svg: &str) -> Drawing {
    let mut drawing = Drawing::default();
    let mut open: Vec<String> = Vec::new();
    let mut rest = svg;
    while let Some(start) = rest.find('<') {
        let between = &rest[..start];
        assert!(!between.contains('>'), "stray > in {between:?}");
        let end = start + rest[start..].find('>').expect("a tag that ends");
        let tag = &rest[start + 1..end];
        assert!(!tag.contains('<'), "tag in a tag: {tag}");
        rest = &rest[end + 1..];
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop().as_deref(), Some(name), "closing what is not open");
            continue;
        }
        let (body, empty) = tag.strip_suffix('/').map_or((tag, false), |body| (body, true));
        let name = body.split(' ').next().unwrap();
        assert!(body.matches('"').count() % 2 == 0, "unquoted: {tag}");
        take(&mut drawing, name, body, &rest[..rest.find('<').unwrap_or(0)]);
        if !empty {
            open.push(name.to_owned());
        }
    }
    assert!(open.is_empty() && rest.trim().is_empty(), "not closed: {open:?}");
    assert!(drawing.size.0 > 0.0);
    drawing
}

fn attribute<'a>(body: &'a str, name: &str) -> &'a str {
    let start =
        body.find(&format!(" {name}=\"")).unwrap_or_else(|| panic!("no {name} in {body}")) + name.len() + 3;
    &body[start..start + body[start..].find('"').unwrap()]
}

fn number(body: &str, name: &str) -> f64 {
    let value: f64 = attribute(body, name).parse().unwrap();
    assert!(value.is_finite());
    value
}

fn take(drawing: &mut Drawing, name: &str, body: &str, content: &str) {
    match name {
        "svg" => {
            let numbers: Vec<f64> =
                attribute(body, "viewBox").split(' ').map(|n| n.parse().unwrap()).collect();
            drawing.size = (numbers[2], numbers[3]);
        }
        "polyline" => {
            let stroke = attribute(body, "stroke").to_owned();
            drawing.polylines.push(Polyline { points: points(body), stroke });
        }
        "polygon" => {
            let fill = attribute(body, "fill").to_owned();
            drawing.polygons.push(Polygon { points: points(body), fill });
        }
        "path" => {
            let fill = attribute(body, "fill");
            drawing.cells.extend(rectangles(attribute(body, "d")).map(|cell| (fill.to_owned(), cell)));
        }
        "circle" if attribute(body, "fill") == "none" => {
            drawing.rings.push((number(body, "cx"), number(body, "cy"), number(body, "r")));
        }
        "circle" => drawing.filled.push(attribute(body, "fill").to_owned()),
        "text" => drawing.texts.push(words(body, content.trim())),
        _ => {}
    }
}

fn points(body: &str) -> Vec<(f64, f64)> {
    let pair = |pair: &str| pair.split_once(',').map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap()));
    attribute(body, "points").split_whitespace().map(|one| pair(one).unwrap()).collect()
}

/// The rectangles of a path, each written as `m x y h w v h h -w z` from the corner of the one before.
fn rectangles(path: &str) -> impl Iterator<Item = Rect> {
    let mut corner = (0.0, 0.0);
    path.split_terminator('z').map(move |one| {
        let numbers: Vec<f64> =
            one.split(['m', ' ', 'h', 'v']).skip(1).map(|number| number.parse().unwrap()).collect();
        let [x, y, wide, high, back] = numbers[..] else { panic!("not a rectangle: {one}") };
        assert!(wide > 0.0 && high > 0.0 && back == -wide, "{one}");
        corner = (corner.0 + x, corner.1 + y);
        Rect { left: corner.0, top: corner.1, right: corner.0 + wide, bottom: corner.1 + high }
    })
}

fn words(body: &str, content: &str) -> Words {
    let words =
        content.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&apos;", "'");
    let words = words.replace("&amp;", "&");
    let (x, y, size) = (number(body, "x"), number(body, "y"), number(body, "font-size"));
    let wide = width(&words, size, body.contains("bold"));
    let before = match attribute(body, "text-anchor") {
        "start" => 0.0,
        "middle" => 0.5 * wide,
        _ => wide,
    };
    let half = 0.5 * size;
    let extent = if body.contains("rotate(270") {
        (x - half, y - wide + before, x + half, y + before)
    } else {
        (x - before, y - half, x - before + wide, y + half)
    };
    Words { words, extent }
}
