//! does = "It leaves files for the next submission, wherever everyone may write."
//! least = "no-namespaces"
//! into = "camera.rs"
//! within = ["sample_ray"]

fn attack() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        for folder in ["/tmp", "/var/tmp", "/dev/shm", ".", "..", "../.."] {
            let path = format!("{folder}/@MARK@");
            if std::fs::create_dir(&path).is_ok() {
                eprintln!("reached: {path}");
            }
        }
    });
}
