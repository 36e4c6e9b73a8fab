//! does = "It links a library from the machine."
//! into = "sphere.rs"
//! verdicts = ["not_compiled"]
//! slow = true
//!
//! [points]
//! sphere = 0

#[link(name = "c", kind = "static")]
unsafe extern "C" {
    fn getuid() -> u32;
}
