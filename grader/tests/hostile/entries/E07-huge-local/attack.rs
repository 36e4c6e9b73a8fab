
fn attack() {
    let huge = std::hint::black_box([1_u8; 1 << 30]);
    eprintln!("{}", huge[7]);
}
