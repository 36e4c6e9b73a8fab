
fn attack() {
    let hoard = std::hint::black_box(vec![1_u8; 1 << 60]);
    eprintln!("{}", hoard[7]);
}
