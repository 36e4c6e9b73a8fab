
struct Again;
impl Drop for Again {
    fn drop(&mut self) {
        panic!("again");
    }
}
fn attack() {
    let _again = Again;
    panic!("once");
}
