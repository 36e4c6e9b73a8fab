//! does = "It panics while it panics."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["crashed"]
//!
//! [points]
//! camera = 0

struct Again;
impl Drop for Again {
    fn drop(&mut self) {
        panic!("again");
    }
}
fn attack() {
    let _again = Again;
    panic!("once");
}
