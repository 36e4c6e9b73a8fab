//! does = "It has a 1 GiB local variable."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["crashed"]
//! slow = true
//!
//! [points]
//! camera = 0

fn attack() {
    let huge = std::hint::black_box([1_u8; 1 << 30]);
    eprintln!("{}", huge[7]);
}
