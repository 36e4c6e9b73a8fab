//! does = "It exits at the first question with a code that means success."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["crashed"]
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
    std::process::exit(0);
}
