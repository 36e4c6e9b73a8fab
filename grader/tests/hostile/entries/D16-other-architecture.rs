//! does = "It runs machine code that it has hidden in a constant, and makes a 32-bit system call."
//! least = "no-namespaces"
//! into = "camera.rs"
//! uses_hole = true
//! within = ["sample_ray"]
//! says = "called"
//! verdicts = ["crashed"]
//!
//! [points]
//! camera = 0

/// Contains, in a constant, the machine code of `mov eax, 20; int 0x80; ret`: the `getpid` system
/// call of 32-bit x86 programs.
#[inline(never)]
fn hidden() -> u64 {
    std::hint::black_box(0xc380_cd00_0000_14b8)
}
fn attack() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        if !cfg!(target_arch = "x86_64") {
            return;
        }
        let function: fn() -> u64 = hidden;
        let start: usize = transmuted(function);
        let code: &[u8; 64] = transmuted(start);
        let hidden = 0xc380_cd00_0000_14b8_u64.to_le_bytes();
        if let Some(offset) = code.windows(8).position(|bytes| bytes == hidden) {
            let call: fn() -> u64 = transmuted(start + offset);
            eprintln!("called");
            let process = call();
            eprintln!("reached: a call of another architecture, which returned {process}");
        }
    });
}
