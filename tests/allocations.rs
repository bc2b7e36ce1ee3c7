//! The time loop allocates nothing: some hundred steps go by without a single request for memory.

#[path = "conformance/bodies.rs"]
#[allow(dead_code)]
mod bodies;

use bodies::{effect, scene};
use pd_verify::constraints::{Edge, Edges};
use pd_verify::forces::{Damping, Traction};
use pd_verify::kernel::Kernel;
use pd_verify::lattice::Lattice;
use pd_verify::march::March;
use pd_verify::model::Model;
use pd_verify::partial_volume::VolumeRule;
use pd_verify::plan::Plan;
use pd_verify::scene::{Initial, Notch, Operator, Rotations, Scene, Shape};
use serde_json::json;
use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The system's allocator, which counts how often any thread asks for memory.
struct Counting;

static ASKED: AtomicUsize = AtomicUsize::new(0);

// SAFETY: every call is passed on as it came.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ASKED.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the caller keeps what `GlobalAlloc` asks of it.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        // SAFETY: likewise.
        unsafe { System.dealloc(memory, layout) }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ASKED.fetch_add(1, Ordering::Relaxed);
        // SAFETY: likewise.
        unsafe { System.realloc(memory, layout, size) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// One body is marched at a time: the count is that of the whole process.
static ALONE: Mutex<()> = Mutex::new(());

/// How often memory was asked for while a march goes on by so many steps.
fn asked<const D: usize>(march: &mut March<'_, D>, steps: u64) -> usize {
    let before = ASKED.load(Ordering::Relaxed);
    march.advance_to(march.step() + steps);
    ASKED.load(Ordering::Relaxed) - before
}

/// Marches a scene on so many threads. What a thread makes once, when it first has work, is not the loop's: of some rounds one
/// at least asks for nothing, where a loop that asks in its steps asks in all of them.
fn allocates_nothing<const D: usize>(scene: &Scene<D>, threads: usize) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let plan = Plan::of(scene).unwrap();
        let model = Model::new(scene).unwrap();
        let mut march = March::new(&model, scene, plan.time_step_s);
        let rounds: Vec<usize> = (0..6).map(|_| asked(&mut march, 100)).collect();
        assert!(march.is_finite() && march.displacement().iter().any(|u| *u != 0.0));
        assert!(rounds.contains(&0), "{} on {threads} threads: asked {rounds:?} times", scene.name);
    });
}

fn lattice(m: f64) -> Lattice {
    Lattice { kernel: Kernel::Gaussian { p: 2.0 }, m, volume_rule: VolumeRule::Linear, calibrated: true }
}

/// A bar of several pieces of work.
fn bar() -> Scene<1> {
    let displacement = vec![Initial { component: 0, amplitude: 1e-6, shape: Shape::Linear { along: 0 } }];
    Scene { name: "bar".into(), displacement, ..scene(lattice(3.0), [30_000]) }
}

/// A plate of several, in which nodes of all kinds are.
fn plate() -> Scene<2> {
    let displacement = vec![Initial { component: 0, amplitude: 1e-6, shape: Shape::Linear { along: 1 } }];
    let plate = scene::<2>(lattice(3.0), [200, 150]);
    let [width, height] = plate.size();
    let notch = Notch { from: [0.0, 0.5 * height], to: [0.5 * width, 0.5 * height] };
    let history = json!({ "shape": "sine", "period_s": 1e-5 });
    let pull = json!({ "edge": "top", "axis": "y", "stress_pa": 1e6, "history": history });
    Scene {
        name: "plate".into(),
        displacement,
        edges: Edges([[Edge::Free, Edge::MirrorOdd], [Edge::MirrorOdd, Edge::Free]]),
        notches: vec![notch],
        effects: vec![effect::<2, Traction>(pull), effect::<2, Damping>(json!({ "rate_per_s": 1e3 }))],
        ..plate
    }
}

#[test]
fn the_time_loop_allocates_nothing() {
    let _alone = ALONE.lock().unwrap();
    for threads in [1, 2] {
        for operator in [Operator::Stencil, Operator::Bonds] {
            for rotations in [Rotations::Small, Rotations::Finite] {
                allocates_nothing(&Scene { operator, rotations, ..bar() }, threads);
                allocates_nothing(&Scene { operator, rotations, ..plate() }, threads);
            }
        }
    }
}

/// The counter sees what is asked for, on other threads too.
#[test]
fn what_is_allocated_is_counted() {
    let _alone = ALONE.lock().unwrap();
    let before = ASKED.load(Ordering::Relaxed);
    let boxes: Vec<Box<usize>> = (0..100).map(Box::new).collect();
    let elsewhere = std::thread::spawn(|| (0..100).map(Box::new).collect::<Vec<Box<usize>>>());
    assert_eq!(boxes.len() + elsewhere.join().unwrap().len(), 200);
    assert!(ASKED.load(Ordering::Relaxed) - before >= 200);
}
