//! does = "It starts as many threads as it can, and leaves them running."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! arguments = ["--cpu-limit", "2"]
//! verdicts = ["timed_out", "out_of_memory", "crashed", "panicked"]
//! wall = 90
//! slow = true
//!
//! [points]
//! camera = 15

fn attack() {
    let asleep = || std::thread::sleep(std::time::Duration::from_secs(3600));
    for _ in 0..10_000 {
        let small = std::thread::Builder::new().stack_size(1 << 14);
        if small.spawn(asleep).is_err() {
            break;
        }
    }
}
