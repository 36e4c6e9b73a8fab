//! does = "It sleeps forever."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! arguments = ["--cpu-limit", "1"]
//! verdicts = ["timed_out"]
//! wall = 120
//! slow = true
//!
//! [points]
//! camera = 0

fn attack() {
    loop {
        std::thread::park();
    }
}
