//! does = "It includes an endless file."
//! # At lower levels, the compiler reads it until memory runs out, and grading stops with an error.
//! least = "no-namespaces"
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["not_compiled", "blocked"]
//! slow = true
//!
//! [points]
//! camera = 0

fn attack() {
    eprintln!("{}", include_bytes!("/dev/zero").len());
}
