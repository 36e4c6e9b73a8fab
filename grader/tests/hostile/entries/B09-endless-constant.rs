//! does = "It computes a constant forever while it is being compiled."
//! into = "sphere.rs"
//! within = ["hit"]
//! verdicts = ["not_compiled"]
//! wall = 200
//! slow = true
//!
//! [points]
//! camera = 0
//! triangle = 0
//! sphere = 0
//! bbox = 0
//! build = 0
//! traverse = 0

#[allow(long_running_const_eval)]
const FOR_EVER: u32 = {
    let mut n = 0_u32;
    while n < 2 {
        n = (n + 1) % 2;
    }
    n
};
fn attack() {
    eprintln!("{FOR_EVER}");
}
