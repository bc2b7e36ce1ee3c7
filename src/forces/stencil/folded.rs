//! A folded stencil on the nodes of a piece that have all their bonds, and the kernel that serves it.

use super::bondwise::Masked;
use super::few::{self, Few};
use super::line::Line;
use super::many::Many;
use super::quadrant::Quadrant;
use crate::field::Window;
use crate::forces::sink::Sink;
use crate::simd::Isa;

/// The bonds of nodes that have them all.
pub struct Folded<'a> {
    pub isa: Isa,
    pub quadrant: &'a Quadrant,
    pub runs: &'a [Masked],
    pub displacement: Window<'a>,
    /// From one component to the next, and from one row to the next; a bar has one row.
    pub stride: usize,
    pub row: usize,
    pub plane: bool,
}

impl Folded<'_> {
    /// Leaves the force on the nodes in a sink.
    pub fn serve(&self, sink: &mut impl Sink) {
        if self.plane { self.plane(sink) } else { self.bar(sink) }
    }

    fn bar(&self, sink: &mut impl Sink) {
        let Self { quadrant, runs, displacement, .. } = *self;
        macro_rules! by_reach {
            ($($reach:literal)*) => {
                match quadrant.reach {
                    $($reach => self.isa.run(Line::<_, $reach> { quadrant, runs, displacement, sink: sink.lend() }),)*
                    _ => self.isa.run(Line::<_, 0> { quadrant, runs, displacement, sink: sink.lend() }),
                }
            };
        }
        by_reach!(1 2 3 4);
    }

    fn plane(&self, sink: &mut impl Sink) {
        let Self { quadrant, runs, displacement, stride, row, .. } = *self;
        macro_rules! by_profile {
            ($($tops:literal)*) => {
                match few::profile(quadrant, self.isa.lanes()) {
                    $(Some($tops) => {
                        self.isa.run(Few::<_, $tops> { quadrant, runs, displacement, stride, row, sink: sink.lend() });
                    })*
                    _ => self.isa.run(Many { quadrant, runs, displacement, stride, row, sink: sink.lend() }),
                }
            };
        }
        few::profiles!(by_profile);
    }
}
