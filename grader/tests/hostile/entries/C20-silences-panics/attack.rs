
fn attack() {
    std::panic::set_hook(Box::new(|_| println!("passed")));
    panic!("no");
}
