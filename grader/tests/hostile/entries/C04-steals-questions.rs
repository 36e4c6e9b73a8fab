//! does = "It reads the questions before the probe does."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! arguments = ["--cpu-limit", "1"]
//! verdicts = ["protocol", "crashed", "timed_out"]
//! wall = 120
//! slow = true
//!
//! [points]
//! camera = 15

fn attack() {
    use std::io::Read;
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        for number in 3..64 {
            let Ok(mut file) = std::fs::File::open(format!("/proc/self/fd/{number}")) else {
                continue;
            };
            std::thread::spawn(move || file.read(&mut [0; 1 << 16]));
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
    });
}
