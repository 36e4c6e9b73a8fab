//! does = "It prints a gigabyte to both streams, without a line break."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["timed_out"]
//! wall = 90
//!
//! [points]
//! camera = 15

fn attack() {
    use std::io::Write;
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        for _ in 0..(1 << 13) {
            std::io::stdout().write_all(&[b'x'; 1 << 16]).ok();
            std::io::stderr().write_all(&[b'y'; 1 << 16]).ok();
        }
    });
}
