//! does = "It includes the key as code, so that a compiler error quotes it."
//! least = "no-namespaces"
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["not_compiled", "blocked"]
//!
//! [points]
//! camera = 0

fn attack() {
    include!("@KEY@");
}
