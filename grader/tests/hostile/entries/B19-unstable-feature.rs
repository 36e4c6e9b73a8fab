//! does = "It uses an unstable feature."
//! into = "sphere.rs"
//! verdicts = ["not_compiled"]
//! slow = true
//!
//! [points]
//! sphere = 0

#![feature(asm_experimental_arch)]
