
fn attack() {
    eprintln!("{}", vec![1_u8; 1 << 60].len());
}
