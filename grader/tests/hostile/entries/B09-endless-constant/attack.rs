
#[allow(long_running_const_eval)]
const FOR_EVER: u32 = {
    let mut n = 0_u32;
    while n < 2 {
        n = (n + 1) % 2;
    }
    n
};
fn attack() {
    eprintln!("{FOR_EVER}");
}
