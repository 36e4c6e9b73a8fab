//! does = "Its static variable has the largest possible alignment, so it might not start."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["crashed", "timed_out", "not_compiled"]
//! slow = true
//!
//! [points]
//! camera = 0
//! triangle = 0
//! sphere = 0
//! bbox = 0
//! build = 20
//! traverse = 20

#[repr(align(0x2000_0000))]
struct Aligned(#[allow(dead_code)] std::sync::Mutex<[u8; 1]>);
static ALIGNED: Aligned = Aligned(std::sync::Mutex::new([1]));
fn attack() {
    std::hint::black_box(&ALIGNED);
}
