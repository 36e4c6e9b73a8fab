//! Records the tests made by a submission's traversal.
//!
//! The recording program is compiled from the same files as the drawing program, except that the
//! viewer has renamed `BBox::hit` and `Primitive::hit`. New methods with the old names call the
//! renamed methods and then [`box_test`] or [`primitive_test`]. This way, the submission's
//! traversal runs unchanged.

use std::cell::{Cell, RefCell};

use framework::render::path_log;
use framework::submission::{Aggregate, Hierarchy};
use glam::Vec3;
use protocol::{Interval, Ray, Trace, TreeNode};

use crate::messages::{RecordedRay, Test, TestCounts};

thread_local! {
    /// The recorded rays, if tests are being listed.
    static LIST: RefCell<Option<List>> = const { RefCell::new(None) };
    /// Whether tests are being listed. If they aren't, this flag saves each test an access to
    /// `LIST`.
    static LISTING: Cell<bool> = const { Cell::new(false) };
}

struct List {
    rays: Vec<RecordedRay>,
    /// The number of tests that may still be listed.
    left: u32,
    /// The maximum number of rays to trace.
    max_rays: u32,
}

/// Records a call to `BBox::hit` and returns its result. `bbox` is the box with these corners. Only
/// its address is used.
pub fn box_test<B>(
    bbox: &B,
    [min, max]: [Vec3; 2],
    times: Interval,
    inside: Option<Interval>,
) -> Option<Interval> {
    record(
        |counts| &mut counts.boxes,
        || Test::Box {
            min,
            max,
            times,
            inside,
            address: std::ptr::from_ref(bbox).addr() as u64,
        },
    );
    inside
}

/// Records a call to `Primitive::hit` and returns its result. `shape` is the index of the shape.
pub fn primitive_test(shape: u32, ray: &Ray, hit: Option<Trace>) -> Option<Trace> {
    record(
        |counts| &mut counts.primitives,
        || Test::Primitive {
            shape,
            range: ray.range,
            distance: hit.map(|trace| trace.distance),
        },
    );
    hit
}

/// Counts a test and adds it to the current ray, if there is one.
fn record(number: fn(&mut TestCounts) -> &mut u32, test: impl FnOnce() -> Test) {
    if !LISTING.get() {
        return;
    }
    LIST.with_borrow_mut(|list| {
        let Some(List { rays, left, .. }) = list else {
            return;
        };
        let Some(ray) = rays.last_mut() else { return };
        let number = number(&mut ray.counts);
        *number = number.saturating_add(1);
        if *left > 0 {
            *left -= 1;
            ray.tests.push(test());
        }
    });
}

/// Starts recording. At most `max_tests` tests are listed, and at most `max_rays` rays are traced.
pub(crate) fn start(max_tests: u32, max_rays: u32) {
    LIST.set(Some(List {
        rays: Vec::new(),
        left: max_tests,
        max_rays,
    }));
    LISTING.set(true);
}

/// Stops listing tests and returns the recorded rays.
pub(crate) fn finish() -> Vec<RecordedRay> {
    LISTING.set(false);
    LIST.take().map_or(Vec::new(), |list| list.rays)
}

/// A tree that records the rays that traverse it.
pub(crate) struct RecordingTree(pub(crate) Box<dyn Hierarchy>);

impl Aggregate for RecordingTree {
    fn closest_hit(&self, ray: &Ray) -> Option<Trace> {
        let RecordingTree(tree) = self;
        if !LISTING.get() {
            return tree.closest_hit(ray);
        }
        let is_traced = LIST.with_borrow_mut(|list| {
            let Some(List { rays, max_rays, .. }) = list else {
                return true;
            };
            rays.push(RecordedRay::new(*ray, path_log::step_count()));
            rays.len() <= *max_rays as usize
        });
        if !is_traced {
            return None;
        }
        let hit = tree.closest_hit(ray);
        LIST.with_borrow_mut(|list| {
            if let Some(last) = list.as_mut().and_then(|list| list.rays.last_mut()) {
                last.hit = hit;
            }
        });
        hit
    }
}

impl Hierarchy for RecordingTree {
    fn root(&self) -> usize {
        self.0.root()
    }

    fn node_count(&self) -> usize {
        self.0.node_count()
    }

    fn node(&self, index: usize) -> TreeNode {
        self.0.node(index)
    }

    fn primitive_count(&self) -> usize {
        self.0.primitive_count()
    }

    fn shape(&self, index: usize) -> u32 {
        self.0.shape(index)
    }
}
