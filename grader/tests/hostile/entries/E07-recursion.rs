//! does = "It calls itself forever."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["crashed"]
//!
//! [points]
//! camera = 0

fn attack() {
    fn deeper(n: u64) -> u64 {
        std::hint::black_box(deeper(n + 1) + n)
    }
    eprintln!("{}", deeper(0));
}
