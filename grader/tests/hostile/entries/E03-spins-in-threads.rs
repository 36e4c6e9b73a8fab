//! does = "It computes forever, in many threads."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! arguments = ["--cpu-limit", "1"]
//! verdicts = ["timed_out"]
//! slow = true
//!
//! [points]
//! camera = 0

fn attack() {
    for _ in 0..16 {
        std::thread::spawn(|| loop {
            std::hint::black_box(0);
        });
    }
    loop {
        std::thread::park();
    }
}
