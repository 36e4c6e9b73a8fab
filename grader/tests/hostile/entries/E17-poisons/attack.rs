
fn attack() {
    static STATE: std::sync::Mutex<u32> = std::sync::Mutex::new(0);
    let mut calls = STATE.lock().unwrap();
    *calls += 1;
    assert!(*calls > 1, "the first");
}
