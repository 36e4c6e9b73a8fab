//! Two counters. One thread is all that there is here.

use std::cell::Cell;

thread_local! {
    static BOXES: Cell<u64> = const { Cell::new(0) };
    static PRIMITIVES: Cell<u64> = const { Cell::new(0) };
}

/// How often a ray was tested.
pub struct Count {
    pub boxes: u64,
    pub primitives: u64,
}

/// What `work` returns, and what was tested meanwhile.
pub fn count_tests<T>(work: impl FnOnce() -> T) -> (T, Count) {
    BOXES.set(0);
    PRIMITIVES.set(0);
    let result = work();
    let (boxes, primitives) = (BOXES.get(), PRIMITIVES.get());
    (result, Count { boxes, primitives })
}

/// A ray is tested with a box.
pub fn count_box() {
    BOXES.set(BOXES.get() + 1);
}

/// A ray is tested with a primitive.
pub fn count_primitive() {
    PRIMITIVES.set(PRIMITIVES.get() + 1);
}
