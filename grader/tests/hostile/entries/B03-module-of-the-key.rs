//! does = "It declares the key file as a module."
//! least = "no-namespaces"
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["not_compiled", "blocked"]
//! slow = true
//!
//! [points]
//! camera = 0

#[path = "@KEY@"]
mod key;
fn attack() {}
