//! does = "It panics every time."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["panicked"]
//! slow = true
//!
//! [points]
//! camera = 0

fn attack() {
    panic!("no");
}
