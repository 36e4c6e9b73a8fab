//! does = "It replaces the panic message, and claims to have passed."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["panicked"]
//! slow = true
//!
//! [points]
//! camera = 0

fn attack() {
    std::panic::set_hook(Box::new(|_| println!("passed")));
    panic!("no");
}
