//! does = "It aborts."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["crashed"]
//! slow = true
//!
//! [points]
//! camera = 0

fn attack() {
    std::process::abort();
}
