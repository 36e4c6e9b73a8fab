//! does = "Its first panic poisons a lock that all later calls need."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["panicked"]
//!
//! [points]
//! camera = 0

fn attack() {
    static STATE: std::sync::Mutex<u32> = std::sync::Mutex::new(0);
    let mut calls = STATE.lock().unwrap();
    *calls += 1;
    assert!(*calls > 1, "the first");
}
