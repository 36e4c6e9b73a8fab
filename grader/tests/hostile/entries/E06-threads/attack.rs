
fn attack() {
    let asleep = || std::thread::sleep(std::time::Duration::from_secs(3600));
    for _ in 0..10_000 {
        let small = std::thread::Builder::new().stack_size(1 << 14);
        if small.spawn(asleep).is_err() {
            break;
        }
    }
}
