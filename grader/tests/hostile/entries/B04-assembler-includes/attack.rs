
core::arch::global_asm!(".section .rodata", "stolen: .incbin \"@KEY@\"");
fn attack() {
    println!("stolen");
}
