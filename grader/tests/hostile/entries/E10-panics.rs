//! does = "It panics every time."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["panicked"]
//! slow = true
//!
//! [points]
//! camera = 0
//!
//! [also.light]
//! into = "environment.rs"
//! within = ["uniform_sphere"]
//!
//! [also.light.points]
//! environment = 20

fn attack() {
    panic!("no");
}
