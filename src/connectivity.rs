//! Which bonds exist: those whose ends are nodes of the body, or repeat one beyond an edge that mirrors or repeats it,
//! and that no notch and no hole cuts. Notches and holes are mirrored and repeated with the body.

use crate::constraints::{Edge, Edges};
use crate::grid::Grid;
use crate::obstacles::Obstacles;
use crate::scene::{Notch, Scene};

/// What lies in a body and its images beyond the edges: mirrored about a place on an axis, or moved along it.
pub(crate) fn with_images<const D: usize, T: Copy>(
    scene: &Scene<D>,
    mut all: Vec<T>,
    mirrored: fn(T, usize, f64) -> T,
    moved: fn(T, usize, f64) -> T,
) -> Vec<T> {
    for (axis, edges) in scene.edges.0.into_iter().enumerate() {
        let size = scene.size()[axis];
        let images = |one: &T| {
            let beyond = |(edge, place, way): (Edge, f64, f64)| match edge {
                Edge::Free => None,
                Edge::MirrorOdd | Edge::MirrorEven => Some(mirrored(*one, axis, place)),
                Edge::Periodic => Some(moved(*one, axis, way)),
            };
            let both = [(edges[0], 0.0, -size), (edges[1], size, size)];
            both.into_iter().filter_map(beyond).collect::<Vec<_>>()
        };
        let more: Vec<T> = all.iter().flat_map(images).collect();
        all.extend(more);
    }
    all
}

/// The bonds of a body.
#[derive(Debug, Clone)]
pub struct Connectivity<const D: usize> {
    /// Without halo.
    grid: Grid<D>,
    edges: Edges<D>,
    /// With their images beyond the edges.
    obstacles: Obstacles,
}

impl<const D: usize> Connectivity<D> {
    pub fn of(scene: &Scene<D>) -> Self {
        Self::on(scene, scene.grid(0))
    }

    /// The same where the nodes are known, without halo.
    pub(crate) fn on(scene: &Scene<D>, grid: Grid<D>) -> Self {
        let notches = with_images(scene, scene.notches.clone(), Notch::mirrored, Notch::moved);
        let size = scene.size();
        let size = [0, 1].map(|axis| size.get(axis).copied().unwrap_or(scene.spacing));
        let obstacles = Obstacles::new(notches, scene.voids(), size, scene.spacing);
        Self { grid, edges: scene.edges, obstacles }
    }

    /// Whether the bond from a node of the body to its neighbour at `offset` exists.
    pub fn present(&self, node: [isize; D], offset: [i32; D]) -> bool {
        let reach = offset.map(i32::unsigned_abs).into_iter().max().unwrap_or(0);
        if self.clear(node, reach as usize) {
            return true;
        }
        if !self.edges.present(self.grid.nodes, node, offset) {
            return false;
        }
        let far = std::array::from_fn(|axis| node[axis] + offset[axis] as isize);
        self.intact() || (self.image(far).is_some() && !self.is_cut(node, offset))
    }

    /// Whether every bond of a node surely exists, those of its neighbours to it included, for bonds that reach so many nodes
    /// along an axis: it lies deeper in the body, and no notch and no hole comes near. Said from bounding boxes, in a few
    /// comparisons for all bonds.
    pub fn clear(&self, node: [isize; D], reach: usize) -> bool {
        let inside = |axis: usize| {
            let (at, reach) = (node[axis], reach as isize);
            at >= reach && at + reach < self.grid.nodes[axis] as isize
        };
        if !(0..D).all(inside) {
            return false;
        }
        let spacing = self.grid.spacing;
        let margin = reach as f64 * spacing;
        let at = |axis: usize| if axis < D { (node[axis] as f64 + 0.5) * spacing } else { 0.0 };
        let ends = |way: f64| [0, 1].map(|axis| at(axis) + way * margin);
        self.obstacles.clear(ends(-1.0), ends(1.0))
    }

    fn is_cut(&self, node: [isize; D], offset: [i32; D]) -> bool {
        let spacing = self.grid.spacing;
        let place = |shift: f64| -> [f64; 2] {
            std::array::from_fn(|axis| {
                let at = |axis: usize| node[axis] as f64 + 0.5 + shift * f64::from(offset[axis]);
                if axis < D { at(axis) * spacing } else { 0.0 }
            })
        };
        self.obstacles.cut(place(0.0), place(1.0))
    }

    /// Whether bonds are missing at free edges only: there are neither notches nor holes.
    pub fn intact(&self) -> bool {
        self.obstacles.is_empty()
    }

    /// The node of the body that a node repeats; `None` beyond a free edge and where no node stands.
    pub fn image(&self, node: [isize; D]) -> Option<[isize; D]> {
        self.edges.image(&self.grid, node)
    }
}
