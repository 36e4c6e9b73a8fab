//! does = "It writes an answer to every file descriptor, through a soundness hole."
//! into = "camera.rs"
//! uses_hole = true
//! within = ["sample_ray"]
//! says = "called"
//! verdicts = ["protocol", "crashed", "timed_out"]
//!
//! [points]
//! camera = 15

fn attack() {
    use std::io::Write;
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        eprintln!("called");
        for number in 1..16_i32 {
            let mut file: std::fs::File = transmuted(number);
            file.write_all(&[1, 0, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 5]).ok();
            std::mem::forget(file);
        }
    });
}
