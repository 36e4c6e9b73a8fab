//! does = "Its program has a 32 GiB static."
//! into = "sphere.rs"
//! verdicts = ["not_compiled"]
//! wall = 120
//! slow = true
//!
//! [points]
//! sphere = 0

pub static HUGE: [u8; 1 << 35] = [1; 1 << 35];
fn _used() -> u8 {
    HUGE[7]
}
