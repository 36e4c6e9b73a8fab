//! does = "It includes the environment of another process."
//! least = "no-namespaces"
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["not_compiled", "blocked"]
//! slow = true
//!
//! [points]
//! camera = 0

fn attack() {
    eprintln!(concat!("reac", "hed: {:?}"), include_bytes!("/proc/1/environ"));
}
