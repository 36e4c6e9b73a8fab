//! Counters of intersection tests. Each thread has its own counters, but this benchmark has only
//! one thread.

use std::cell::Cell;

thread_local! {
    static BOXES: Cell<u64> = const { Cell::new(0) };
    static PRIMITIVES: Cell<u64> = const { Cell::new(0) };
}

/// The numbers of intersection tests.
pub struct Count {
    pub boxes: u64,
    pub primitives: u64,
}

/// Runs `work`, and returns its result and the numbers of tests that it made.
pub fn count_tests<T>(work: impl FnOnce() -> T) -> (T, Count) {
    BOXES.set(0);
    PRIMITIVES.set(0);
    let result = work();
    let (boxes, primitives) = (BOXES.get(), PRIMITIVES.get());
    (result, Count { boxes, primitives })
}

/// Counts a test of a ray with a box.
pub fn count_box() {
    BOXES.set(BOXES.get() + 1);
}

/// Counts a test of a ray with a primitive.
pub fn count_primitive() {
    PRIMITIVES.set(PRIMITIVES.get() + 1);
}
