//! does = "It includes the bytes of a file on the machine."
//! least = "no-namespaces"
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["not_compiled", "blocked"]
//! slow = true
//!
//! [points]
//! camera = 0

fn attack() {
    eprintln!(concat!("reac", "hed: {:?}"), &include_bytes!("/etc/passwd")[..8]);
}
