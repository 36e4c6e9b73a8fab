//! does = "It includes the key as text."
//! least = "no-namespaces"
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["not_compiled", "blocked"]
//!
//! [points]
//! camera = 0
//!
//! [also.light]
//! into = "lights.rs"
//! within = ["point"]
//!
//! [also.light.points]
//! lights = 0

fn attack() {
    eprintln!(concat!("reac", "hed: {}"), include_str!("@KEY@"));
}
