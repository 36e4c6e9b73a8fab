//! does = "It sleeps now and then, in all items of two tasks."
//! into = "bvh.rs"
//! within = ["build", "hit"]
//! verdicts = ["timed_out"]
//! wall = 120
//! slow = true
//!
//! [points]
//! build = 20
//! traverse = 20

/// Sleeps at the start of each item. A pause since the last call means that a new item has started,
/// because hardly any time passes between the questions of an item.
fn attack() {
    static LAST: std::sync::Mutex<Option<std::time::Instant>> = std::sync::Mutex::new(None);
    let mut last = LAST.lock().unwrap();
    if last.is_none_or(|last| last.elapsed().as_micros() > 60) {
        std::thread::sleep(std::time::Duration::from_millis(1_400));
    }
    *last = Some(std::time::Instant::now());
}
