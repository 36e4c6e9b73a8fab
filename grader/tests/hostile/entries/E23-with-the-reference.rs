//! does = "A program built from its own files starts, but one built from its `bvh.rs` and the reference's parts does not."
//! base = "starter"
//! into = "bvh.rs"
//! within = ["hit"]
//! verdicts = ["crashed", "unimplemented", "wrong", "timed_out"]
//!
//! [points]
//! camera = 0
//! triangle = 0
//! sphere = 0
//! bbox = 0
//! build = 0
//! traverse = 0

// In the program that is built with the reference's parts, this file belongs to the crate
// `submission`.
const BYTES: usize = if module_path!().as_bytes()[0] == b's' {
    100 << 20
} else {
    1
};
thread_local! {
    static BIG: std::cell::Cell<std::mem::MaybeUninit<[u8; BYTES]>> =
        const { std::cell::Cell::new(std::mem::MaybeUninit::uninit()) };
}
fn attack() {
    BIG.with(|big| _ = std::hint::black_box(big));
}
