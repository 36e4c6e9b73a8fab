//! does = "It writes an answer to every open file before the question arrives."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["protocol", "crashed", "timed_out"]
//!
//! [points]
//! camera = 15
//!
//! [also.light]
//! into = "path.rs"
//! within = ["radiance"]
//!
//! [also.light.points]
//! path = 17

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
            file.write_all(&[1, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 5]).ok();
        }
    });
}
