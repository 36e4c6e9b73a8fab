//! does = "It announces a frame, and sends nothing."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! arguments = ["--cpu-limit", "1"]
//! verdicts = ["protocol", "crashed", "timed_out"]
//! wall = 120
//! slow = true
//!
//! [points]
//! camera = 15

/// Returns every file that this process has open for writing.
fn open() -> impl Iterator<Item = std::fs::File> {
    let open = (0..64).map(|number| format!("/proc/self/fd/{number}"));
    open.filter_map(|path| std::fs::OpenOptions::new().write(true).open(path).ok())
}
fn attack() {
    use std::io::Write;
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        for mut file in open() {
            file.write_all(&[200, 0, 0, 0, 1, 2]).ok();
        }
        std::thread::sleep(std::time::Duration::from_secs(3600));
    });
}
