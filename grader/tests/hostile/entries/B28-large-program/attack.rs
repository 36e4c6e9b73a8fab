
static BIG: [u8; 80 << 20] = [1; 80 << 20];
fn attack() {
    std::hint::black_box(&BIG);
}
