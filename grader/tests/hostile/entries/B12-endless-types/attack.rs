
fn deeper<T: Default + std::fmt::Debug>(depth: u32) {
    if depth > 0 {
        deeper::<Option<T>>(depth - 1);
    }
    eprintln!("{:?}", T::default());
}
fn attack() {
    deeper::<u8>(200);
}
