//! does = "It exits with the code of a killed process."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["crashed"]
//! slow = true
//!
//! [points]
//! camera = 0

fn attack() {
    std::process::exit(137);
}
