
fn attack() {
    loop {
        std::thread::park();
    }
}
