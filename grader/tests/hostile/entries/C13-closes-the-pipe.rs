//! does = "It closes every file descriptor through a soundness hole, and keeps running."
//! into = "camera.rs"
//! uses_hole = true
//! within = ["sample_ray"]
//! says = "called"
//! verdicts = ["crashed", "timed_out"]
//!
//! [points]
//! camera = 0

fn attack() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        eprintln!("called");
        for number in 0..16_i32 {
            drop(transmuted::<i32, std::fs::File>(number));
        }
        std::thread::sleep(std::time::Duration::from_secs(600));
    });
}
