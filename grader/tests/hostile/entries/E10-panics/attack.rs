
fn attack() {
    panic!("no");
}
