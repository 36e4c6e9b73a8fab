//! does = "It reads freed memory without a line of unsafe code (rust-lang issue 25860)."
//! into = "sphere.rs"
//! within = ["hit"]
//! # It reads garbage and continues. A future compiler may reject it.
//! verdicts = ["not_compiled"]
//!
//! [points]
//! sphere = 15

static STATIC: &&() = &&();
fn stretched<'a, 'b, T: ?Sized>(_: &'a &'b (), value: &'b T) -> &'a T {
    value
}
fn freed() -> &'static [u8] {
    let stretch: fn(&'static &'static (), &[u8]) -> &'static [u8] = stretched;
    let memory = vec![7_u8; 1 << 12];
    stretch(STATIC, &memory)
}
fn attack() {
    // Formats first and prints once: standard error is not buffered, and a system call for each
    // number, for 20,000 rays, would take longer than the ten seconds allowed for a picture.
    let read = format!("{:?}\n", &freed()[..64]);
    eprint!("{read}");
}
