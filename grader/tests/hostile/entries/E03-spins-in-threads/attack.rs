
fn attack() {
    for _ in 0..16 {
        std::thread::spawn(|| loop {
            std::hint::black_box(0);
        });
    }
    loop {
        std::thread::park();
    }
}
