
fn attack() {
    std::mem::forget(vec![1_u8; 1 << 14]);
}
