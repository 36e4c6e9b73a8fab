
const BYTES: usize = 100 << 20;
thread_local! {
    static BIG: std::cell::Cell<std::mem::MaybeUninit<[u8; BYTES]>> =
        const { std::cell::Cell::new(std::mem::MaybeUninit::uninit()) };
}
fn attack() {
    BIG.with(|big| _ = std::hint::black_box(big));
}
