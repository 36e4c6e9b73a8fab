//! does = "It replaces a system function."
//! into = "sphere.rs"
//! verdicts = ["not_compiled"]
//!
//! [points]
//! sphere = 0

#[unsafe(no_mangle)]
pub extern "C" fn write(_: i32, _: *const u8, count: usize) -> usize {
    count
}
