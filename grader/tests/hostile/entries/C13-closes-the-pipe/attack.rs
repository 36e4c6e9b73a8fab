
fn attack() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        eprintln!("called");
        for number in 0..16_i32 {
            drop(transmuted::<i32, std::fs::File>(number));
        }
        std::thread::sleep(std::time::Duration::from_secs(600));
    });
}
