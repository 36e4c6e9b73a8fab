
fn attack() {
    let (sender, receiver) = std::sync::mpsc::channel::<()>();
    std::thread::spawn(|| panic!("gone"));
    receiver.recv().ok();
    drop(sender);
}
