//! does = "It answers some questions, then exits."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["crashed"]
//!
//! [points]
//! camera = 15

fn attack() {
    use std::sync::atomic::{AtomicU32, Ordering};
    static ASKED: AtomicU32 = AtomicU32::new(0);
    if ASKED.fetch_add(1, Ordering::Relaxed) == 100 {
        std::process::exit(0);
    }
}
