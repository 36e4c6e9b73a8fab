//! does = "It leaks some memory with every ray."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["out_of_memory"]
//! slow = true
//!
//! [points]
//! camera = 15

fn attack() {
    std::mem::forget(vec![1_u8; 1 << 14]);
}
