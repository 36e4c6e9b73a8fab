//! does = "It makes the assembler include the key."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["not_compiled", "blocked"]
//!
//! [points]
//! camera = 0

core::arch::global_asm!(".section .rodata", "stolen: .incbin \"@KEY@\"");
fn attack() {
    println!("stolen");
}
