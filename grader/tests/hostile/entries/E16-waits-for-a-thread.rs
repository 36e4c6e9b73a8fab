//! does = "It waits forever for a message from a thread that panicked."
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
    let (sender, receiver) = std::sync::mpsc::channel::<()>();
    std::thread::spawn(|| panic!("gone"));
    receiver.recv().ok();
    drop(sender);
}
