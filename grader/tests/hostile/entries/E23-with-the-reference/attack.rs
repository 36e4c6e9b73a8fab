
// The program with the reference's parts contains this file in the crate `submission`.
const BYTES: usize = if module_path!().as_bytes()[0] == b's' {
    100 << 20
} else {
    1
};
thread_local! {
    static BIG: std::cell::Cell<std::mem::MaybeUninit<[u8; BYTES]>> =
        const { std::cell::Cell::new(std::mem::MaybeUninit::uninit()) };
}
fn attack() {
    BIG.with(|big| _ = std::hint::black_box(big));
}
