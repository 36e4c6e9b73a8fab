//! Records the tests made by a submission's traversal.
//!
//! The recording program is compiled from the same files as the drawing program, except that the
//! viewer has renamed `BBox::hit` and `Primitive::hit`, and that methods with the old names call
//! them and then [`box_test`] or [`primitive_test`]. This way, the submission's traversal runs
//! unchanged.

use std::cell::{Cell, RefCell};

use framework::submission::{Aggregate, Hierarchy};
use glam::Vec3;
use protocol::{Interval, Ray, Trace, TreeNode};

use crate::messages::{Follow, FollowedRay, Test, TestCounts};

thread_local! {
    /// The number of tests since the last [`take_counts`].
    static COUNTS: Cell<TestCounts> = const { Cell::new(TestCounts { boxes: 0, primitives: 0 }) };
    /// The recorded rays, if tests are being listed.
    static LIST: RefCell<Option<List>> = const { RefCell::new(None) };
    /// Whether tests are being listed. This flag spares counting an access to `LIST`.
    static LISTING: Cell<bool> = const { Cell::new(false) };
}

struct List {
    rays: Vec<FollowedRay>,
    /// The number of tests that may still be listed.
    left: u32,
}

/// Records a call of `BBox::hit`. Returns its result. `bbox` is the box with these corners. Only
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

/// Records a call of `Primitive::hit`. Returns its result. `shape` is the index of the shape.
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

/// Counts a test and adds it to the current ray. A test outside any ray isn't listed.
fn record(number: fn(&mut TestCounts) -> &mut u32, test: impl FnOnce() -> Test) {
    let add = |counts: &mut TestCounts| {
        let number = number(counts);
        *number = number.saturating_add(1);
    };
    let mut counts = COUNTS.get();
    add(&mut counts);
    COUNTS.set(counts);
    if !LISTING.get() {
        return;
    }
    LIST.with_borrow_mut(|list| {
        let Some(List { rays, left }) = list else {
            return;
        };
        let Some(ray) = rays.last_mut() else { return };
        add(&mut ray.counts);
        if *left > 0 {
            *left -= 1;
            ray.tests.push(test());
        }
    });
}

/// Returns the number of tests since the last call.
pub(crate) fn take_counts() -> TestCounts {
    COUNTS.take()
}

/// Starts listing tests.
pub(crate) fn start(follow: &Follow) {
    LIST.set(Some(List {
        rays: Vec::new(),
        left: follow.max_tests,
    }));
    LISTING.set(true);
}

/// Stops listing tests. Returns the rays.
pub(crate) fn finish() -> Vec<FollowedRay> {
    LISTING.set(false);
    LIST.take().map_or(Vec::new(), |list| list.rays)
}

/// A tree whose rays are listed.
pub(crate) struct Recorded(pub(crate) Box<dyn Hierarchy>);

impl Aggregate for Recorded {
    fn closest_hit(&self, ray: &Ray) -> Option<Trace> {
        let Recorded(tree) = self;
        if !LISTING.get() {
            return tree.closest_hit(ray);
        }
        LIST.with_borrow_mut(|list| {
            let rays = list.iter_mut().map(|list| &mut list.rays);
            rays.for_each(|rays| rays.push(FollowedRay::new(*ray)));
        });
        let hit = tree.closest_hit(ray);
        LIST.with_borrow_mut(|list| {
            if let Some(last) = list.as_mut().and_then(|list| list.rays.last_mut()) {
                last.hit = hit;
            }
        });
        hit
    }
}

impl Hierarchy for Recorded {
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
