//! does = "Its children keep all pipes open and never exit."
//! least = "no-namespaces"
//! into = "camera.rs"
//! within = ["sample_ray"]
//! slow = true

fn attack() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        for _ in 0..20 {
            if std::process::Command::new("/bin/sleep").arg("300").spawn().is_ok() {
                eprintln!("reached: a child");
            }
        }
    });
}
