
#[repr(align(0x2000_0000))]
struct Aligned(#[allow(dead_code)] std::sync::Mutex<[u8; 1]>);
static ALIGNED: Aligned = Aligned(std::sync::Mutex::new([1]));
fn attack() {
    std::hint::black_box(&ALIGNED);
}
