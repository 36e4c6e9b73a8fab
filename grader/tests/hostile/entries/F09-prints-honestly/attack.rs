
fn attack() {
    println!("here is another ray");
}
