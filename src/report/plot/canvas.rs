//! The one place that calls plotters: shapes in pixels as floating-point numbers become an SVG text.
//!
//! Plotters' own charts clamp what is outside, lose ticks and round to whole pixels, so only its SVG primitives are
//! used, on a grid ten times finer than a pixel. Its primitives know no dashes and no sets of rectangles; these are written
//! in afterwards.

use super::PlotError;
use super::clip::{Point, Rect};
use super::style::{Dash, Marker, Pen, Rgb, WHITE};
use plotters::backend::{DrawingBackend, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontTransform, IntoFont, RGBAColor, RGBColor, ShapeStyle, TextStyle};

/// Grid units per pixel.
const FINE: f64 = 10.0;

/// A line's look.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stroke {
    pub colour: Rgb,
    pub width: f64,
    pub dash: Dash,
}

impl Stroke {
    pub fn solid(colour: Rgb, width: f64) -> Self {
        Self { colour, width, dash: Dash::Solid }
    }
}

/// Which part of a text stands at its point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Align {
    Left,
    Centre,
    Right,
}

/// A line of text, its middle line at `at`.
#[derive(Debug, Clone)]
pub(super) struct Text {
    pub at: Point,
    pub text: String,
    pub size: f64,
    pub colour: Rgb,
    pub align: Align,
    pub bold: bool,
    /// Reads from bottom to top.
    pub upwards: bool,
}

enum Shape {
    Path(Vec<Point>, Stroke),
    Polygon(Vec<Point>, Rgb, f64),
    Cells(Vec<Rect>, Rgb),
    Circle(Point, f64, Rgb),
    Ring(Point, f64, Stroke),
    Text(Text),
}

/// A list of shapes in drawing order, in pixels, y downwards.
#[derive(Default)]
pub(super) struct Canvas {
    shapes: Vec<Shape>,
}

impl Canvas {
    pub fn path(&mut self, points: Vec<Point>, stroke: Stroke) {
        self.shapes.push(Shape::Path(points, stroke));
    }

    pub fn line(&mut self, a: Point, b: Point, stroke: Stroke) {
        self.path(vec![a, b], stroke);
    }

    pub fn polygon(&mut self, points: Vec<Point>, fill: Rgb, alpha: f64) {
        self.shapes.push(Shape::Polygon(points, fill, alpha));
    }

    pub fn rect(&mut self, r: Rect, fill: Rgb, alpha: f64) {
        let corners = vec![(r.left, r.top), (r.right, r.top), (r.right, r.bottom), (r.left, r.bottom)];
        self.polygon(corners, fill, alpha);
    }

    /// Rectangles of one colour as one element, with edges that leave no seam between neighbours.
    pub fn cells(&mut self, cells: Vec<Rect>, fill: Rgb) {
        self.shapes.push(Shape::Cells(cells, fill));
    }

    pub fn outline(&mut self, r: Rect, stroke: Stroke) {
        let top = (r.left, r.top);
        self.path(vec![top, (r.right, r.top), (r.right, r.bottom), (r.left, r.bottom), top], stroke);
    }

    pub fn circle(&mut self, centre: Point, radius: f64, fill: Rgb) {
        self.shapes.push(Shape::Circle(centre, radius, fill));
    }

    pub fn ring(&mut self, centre: Point, radius: f64, stroke: Stroke) {
        self.shapes.push(Shape::Ring(centre, radius, stroke));
    }

    pub fn text(&mut self, text: Text) {
        self.shapes.push(Shape::Text(text));
    }

    /// A marker of the pen's shape and colour.
    pub fn marker(&mut self, (x, y): Point, pen: Pen) {
        let Some(marker) = pen.marker else { return };
        let colour = pen.colour;
        let thick = Stroke::solid(colour, 2.0);
        let r = 4.2;
        match marker {
            Marker::Circle => self.circle((x, y), r, colour),
            Marker::Ring => self.ring((x, y), r, thick),
            Marker::Square => {
                let r = 3.8;
                self.rect(Rect { left: x - r, top: y - r, right: x + r, bottom: y + r }, colour, 1.0);
            }
            Marker::Diamond => {
                let r = 5.4;
                self.polygon(vec![(x, y - r), (x + r, y), (x, y + r), (x - r, y)], colour, 1.0);
            }
            Marker::Triangle => {
                self.polygon(vec![(x - 5.0, y + 4.0), (x + 5.0, y + 4.0), (x, y - 5.0)], colour, 1.0)
            }
            Marker::TriangleDown => {
                self.polygon(vec![(x - 5.0, y - 4.0), (x + 5.0, y - 4.0), (x, y + 5.0)], colour, 1.0);
            }
            Marker::Cross => {
                self.line((x - r, y - r), (x + r, y + r), thick);
                self.line((x - r, y + r), (x + r, y - r), thick);
            }
            Marker::Plus => {
                let r = 5.2;
                self.line((x - r, y), (x + r, y), thick);
                self.line((x, y - r), (x, y + r), thick);
            }
        }
    }

    /// The SVG text, `width` by `height` pixels, with its own white ground and a name and description for readers
    /// who cannot see it.
    pub fn finish(
        self,
        width: f64,
        height: f64,
        id: &str,
        title: &str,
        about: &str,
    ) -> Result<String, PlotError> {
        let (wide, high) = ((width * FINE).ceil() as u32, (height * FINE).ceil() as u32);
        let mut raw = String::new();
        let mut backend = SVGBackend::with_string(&mut raw, (wide, high));
        let ground = vec![(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
        draw(&mut backend, &Shape::Polygon(ground, WHITE, 1.0))?;
        for shape in &self.shapes {
            draw(&mut backend, shape)?;
        }
        backend.present().map_err(drawing)?;
        drop(backend);
        let id: String = id.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
        let head = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"0 0 {wide} {high}\" role=\"img\" aria-labelledby=\"{id}-title {id}-about\" \
             stroke-linejoin=\"round\">\n<title id=\"{id}-title\">{}</title>\n<desc id=\"{id}-about\">{}</desc>\n",
            escape(title),
            escape(about)
        );
        Ok(head + &self.completed(&raw))
    }

    /// Plotters' elements with the dashes and cells they cannot carry, one line each, without its `svg` head.
    fn completed(&self, raw: &str) -> String {
        let mut strokes = self.shapes.iter().filter_map(|shape| match shape {
            Shape::Path(_, stroke) => Some(stroke),
            _ => None,
        });
        // Plotters wrote the white ground first.
        let mut fills = std::iter::once(None).chain(self.shapes.iter().filter_map(|shape| match shape {
            Shape::Polygon(..) => Some(None),
            Shape::Cells(cells, fill) => Some(Some((cells, *fill))),
            _ => None,
        }));
        let mut out = String::with_capacity(raw.len());
        for line in raw.lines().skip(1) {
            let line = line.replace(" opacity=\"1\"", "");
            // Text is escaped, so only an element can begin a line like this.
            if line.starts_with("<polyline")
                && let Some(stroke) = strokes.next()
                && stroke.dash != Dash::Solid
            {
                let lengths: Vec<String> =
                    stroke.dash.lengths().iter().map(|l| format!("{:.0}", l * stroke.width * FINE)).collect();
                let dashes = format!("<polyline stroke-dasharray=\"{}\"", lengths.join(" "));
                out.push_str(&line.replacen("<polyline", &dashes, 1));
            } else if line.starts_with("<polygon")
                && let Some(Some((cells, fill))) = fills.next()
            {
                out.push_str(&path_of(cells, fill));
            } else {
                out.push_str(&line);
            }
            out.push('\n');
        }
        out
    }
}

fn draw(backend: &mut SVGBackend<'_>, shape: &Shape) -> Result<(), PlotError> {
    match shape {
        Shape::Path(points, stroke) => backend.draw_path(points.iter().map(fine), &lined(stroke)),
        Shape::Polygon(points, fill, alpha) => {
            backend.fill_polygon(points.iter().map(fine), &rgba(*fill, *alpha))
        }
        // A polygon that is no more than a place in the order of drawing.
        Shape::Cells(_, fill) => backend.fill_polygon([(0, 0)], &rgba(*fill, 1.0)),
        Shape::Circle(centre, radius, fill) => {
            backend.draw_circle(fine(centre), (radius * FINE).round() as u32, &rgba(*fill, 1.0), true)
        }
        Shape::Ring(centre, radius, stroke) => {
            backend.draw_circle(fine(centre), (radius * FINE).round() as u32, &lined(stroke), false)
        }
        Shape::Text(text) => {
            let across = match text.align {
                Align::Left => HPos::Left,
                Align::Centre => HPos::Center,
                Align::Right => HPos::Right,
            };
            // Plotters divides a font's size by 1.24 when it writes SVG.
            let mut font = ("sans-serif", text.size * FINE * 1.24).into_font();
            if text.bold {
                font = font.style(plotters::style::FontStyle::Bold);
            }
            if text.upwards {
                font = font.transform(FontTransform::Rotate270);
            }
            let (r, g, b) = text.colour;
            let colour = RGBColor(r, g, b);
            let style = TextStyle::from(font).color(&colour).pos(Pos::new(across, VPos::Center));
            backend.draw_text(&clean(&text.text), &style, fine(&text.at))
        }
    }
    .map_err(drawing)
}

/// One path through all rectangles, each from the corner of the one before.
fn path_of(cells: &[Rect], (r, g, b): Rgb) -> String {
    let mut path = format!("<path fill=\"#{r:02X}{g:02X}{b:02X}\" shape-rendering=\"crispEdges\" d=\"");
    let mut from = (0, 0);
    for cell in cells {
        let (start, end) = (fine(&(cell.left, cell.top)), fine(&(cell.right, cell.bottom)));
        let (wide, high) = (end.0 - start.0, end.1 - start.1);
        path += &format!("m{} {}h{wide}v{high}h{}z", start.0 - from.0, start.1 - from.1, -wide);
        from = start;
    }
    path + "\"/>"
}

fn fine(point: &Point) -> (i32, i32) {
    ((point.0 * FINE).round() as i32, (point.1 * FINE).round() as i32)
}

fn rgba((r, g, b): Rgb, alpha: f64) -> RGBAColor {
    RGBColor(r, g, b).mix(alpha)
}

fn lined(stroke: &Stroke) -> ShapeStyle {
    ShapeStyle {
        color: rgba(stroke.colour, 1.0),
        filled: false,
        stroke_width: (stroke.width * FINE).round() as u32,
    }
}

fn drawing(error: impl std::fmt::Display) -> PlotError {
    PlotError::Drawing(error.to_string())
}

/// Without the characters that XML forbids and those that would break a line.
fn clean(text: &str) -> String {
    text.chars()
        .map(|c| if c.is_whitespace() { ' ' } else { c })
        .filter(|c| !c.is_control() && !matches!(c, '\u{FFFE}' | '\u{FFFF}'))
        .collect()
}

fn escape(text: &str) -> String {
    clean(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
