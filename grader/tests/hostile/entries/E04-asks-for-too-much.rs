//! does = "It allocates 2^60 bytes at once."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["out_of_memory"]
//!
//! [points]
//! camera = 0

fn attack() {
    let hoard = std::hint::black_box(vec![1_u8; 1 << 60]);
    eprintln!("{}", hoard[7]);
}
