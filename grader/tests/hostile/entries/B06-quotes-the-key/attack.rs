
fn attack() {
    include!("@KEY@");
}
