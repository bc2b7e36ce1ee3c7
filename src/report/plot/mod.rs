//! Figures as SVG text: curves, polar plots, heat maps, rasters, dot charts and stacked bars from plain data.
//!
//! [`svg`] is a pure function: the same figure gives the same text. Legends stand outside the plots, curves are cut at
//! the frame, a value that is missing or not finite is a gap, and a line under the figure says what was left out.
//!
//! ```
//! use pd_verify::report::plot::{Axis, Figure, Lines, Series, svg};
//!
//! let points = (0..=100).map(|i| 0.01 * f64::from(i)).map(|k| (k, k.sin())).collect();
//! let panel = Lines::new(
//!     Axis::linear("wavenumber k (1/m)"),
//!     Axis::linear("ω/c (1/m)"),
//!     vec![Series::line("lattice", points), Series::reference("local", vec![(0.0, 0.0), (1.0, 1.0)])],
//! );
//! let figure = Figure::new("dispersion", "Dispersion in a bar", "Frequency over wavenumber.", panel);
//! assert!(svg(&figure)?.contains("<svg"));
//! # Ok::<(), pd_verify::report::plot::PlotError>(())
//! ```

mod axis;
mod canvas;
mod clip;
mod colour_scale;
mod dots;
mod fill;
mod frame;
mod heat_map;
mod layout;
mod left_out;
mod legend;
mod lines;
mod number;
mod polar;
mod raster;
mod slope;
mod stacked_bars;
mod style;
#[cfg(test)]
mod tests;
mod text;
mod ticks;

pub use axis::{Axis, Scale};
pub use colour_scale::Colours;
pub use dots::{Category, Dot, Dots};
pub use heat_map::HeatMap;
pub use layout::svg;
pub use lines::{Band, Guide, Lines, Series};
pub use polar::Polar;
pub use raster::Raster;
pub use stacked_bars::{Stack, StackedBars};
pub use style::{Colour, Dash, Marker, Style};

/// One or several panels under one title.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// File name without ending; unique in a page.
    pub id: String,
    pub title: String,
    /// Not drawn: for the page, and for readers who cannot see the figure.
    pub caption: String,
    pub panels: Vec<Panel>,
    /// Panels beside each other.
    pub columns: usize,
}

impl Figure {
    /// A figure with one panel.
    pub fn new(
        id: impl Into<String>,
        title: impl Into<String>,
        caption: impl Into<String>,
        panel: impl Into<Panel>,
    ) -> Self {
        let panels = vec![panel.into()];
        Self { id: id.into(), title: title.into(), caption: caption.into(), panels, columns: 1 }
    }

    /// With one more panel.
    pub fn panel(mut self, panel: impl Into<Panel>) -> Self {
        self.panels.push(panel.into());
        self
    }

    /// With this many panels beside each other.
    pub fn columns(mut self, columns: usize) -> Self {
        self.columns = columns;
        self
    }
}

/// One plot of a figure.
#[derive(Debug, Clone, PartialEq)]
pub enum Panel {
    Lines(Lines),
    Polar(Polar),
    HeatMap(HeatMap),
    Raster(Raster),
    Dots(Dots),
    StackedBars(StackedBars),
}

impl From<Lines> for Panel {
    fn from(panel: Lines) -> Self {
        Self::Lines(panel)
    }
}

impl From<Polar> for Panel {
    fn from(panel: Polar) -> Self {
        Self::Polar(panel)
    }
}

impl From<HeatMap> for Panel {
    fn from(panel: HeatMap) -> Self {
        Self::HeatMap(panel)
    }
}

impl From<Raster> for Panel {
    fn from(panel: Raster) -> Self {
        Self::Raster(panel)
    }
}

impl From<Dots> for Panel {
    fn from(panel: Dots) -> Self {
        Self::Dots(panel)
    }
}

impl From<StackedBars> for Panel {
    fn from(panel: StackedBars) -> Self {
        Self::StackedBars(panel)
    }
}

/// Why a figure cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlotError {
    /// There is nothing to draw.
    #[error("the figure has no panels")]
    Empty,
    /// A range that no axis can show.
    #[error("axis `{axis}` cannot run from {lo} to {hi}")]
    Range { axis: String, lo: f64, hi: f64 },
    /// Rows, columns or groups do not match their names.
    #[error("{what}: {found} values for {expected} names")]
    Shape { what: String, found: usize, expected: usize },
    /// A slope triangle outside a doubly logarithmic plot.
    #[error("slope `{label}` needs a finite order and two logarithmic axes")]
    Slope { label: String },
    /// The drawing library refused.
    #[error("drawing failed: {0}")]
    Drawing(String),
}
