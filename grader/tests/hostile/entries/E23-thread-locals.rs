//! does = "Its thread-local variables leave no room for the stack, so it does not start."
//! # Without a sandbox, programs are linked dynamically, and this one starts.
//! least = "no-namespaces"
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["crashed", "timed_out"]
//! says = "the program could not be started"
//!
//! [points]
//! camera = 0
//! triangle = 0
//! sphere = 0
//! bbox = 0
//! build = 20
//! traverse = 20

const BYTES: usize = 100 << 20;
thread_local! {
    static BIG: std::cell::Cell<std::mem::MaybeUninit<[u8; BYTES]>> =
        const { std::cell::Cell::new(std::mem::MaybeUninit::uninit()) };
}
fn attack() {
    BIG.with(|big| _ = std::hint::black_box(big));
}
