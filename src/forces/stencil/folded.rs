//! A folded stencil on the nodes of a piece that have all their bonds, and the kernel that serves it.

use super::bondwise::Masked;
use super::few::Few;
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
                    $($reach => self.isa.run(Line::<_, $reach> { quadrant, runs, displacement, sink }),)*
                    _ => self.isa.run(Line::<_, 0> { quadrant, runs, displacement, sink }),
                }
            };
        }
        by_reach!(1 2 3 4);
    }

    fn plane(&self, sink: &mut impl Sink) {
        let Self { quadrant, runs, displacement, stride, row, .. } = *self;
        macro_rules! by_profile {
            ($($tops:literal)*) => {
                match quadrant.profile() {
                    $(Some($tops) => {
                        self.isa.run(Few::<_, $tops> { quadrant, runs, displacement, stride, row, sink });
                    })*
                    _ => self.isa.run(Many { quadrant, runs, displacement, stride, row, sink }),
                }
            };
        }
        // Every family of a horizon that reaches at most four nodes, whatever the volume rule.
        by_profile!(0x1 0x11 0x12 0x122 0x222 0x223 0x1233 0x2333 0x2334 0x12344 0x13344 0x23444 0x34444);
    }
}
