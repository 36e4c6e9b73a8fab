
pub static HUGE: [u8; 1 << 35] = [1; 1 << 35];
fn _used() -> u8 {
    HUGE[7]
}
