//! does = "It never stops writing."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! arguments = ["--cpu-limit", "1"]
//! verdicts = ["protocol", "crashed", "timed_out"]
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
        let mut files: Vec<_> = open().collect();
        loop {
            for file in &mut files {
                file.write_all(&[0; 4096]).ok();
            }
        }
    });
}
