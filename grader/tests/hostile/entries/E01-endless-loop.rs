//! does = "It computes forever."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! arguments = ["--cpu-limit", "1"]
//! verdicts = ["timed_out"]
//!
//! [points]
//! camera = 0
//!
//! [also.light]
//! into = "direct.rs"
//! within = ["direct"]
//!
//! [also.light.points]
//! direct = 0

fn attack() {
    loop {
        std::hint::black_box(0);
    }
}
