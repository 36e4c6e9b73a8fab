//! does = "It reads the key, passwords, its own program file and every user's folders."
//! least = "no-namespaces"
//! into = "camera.rs"
//! within = ["sample_ray"]
//!
//! [also.light]
//! into = "path.rs"
//! within = ["radiance"]

fn attack() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        for path in ["@KEY@", "/etc/passwd", "/etc/shadow", "/proc/self/exe", "@OUT@/score.json"] {
            if let Ok(bytes) = std::fs::read(path) {
                eprintln!("reached: {path}: {}", String::from_utf8_lossy(&bytes[..bytes.len().min(40)]));
            }
        }
        for folder in ["/", "/tmp", "/home", "/root", "/proc/self/fd", "."] {
            if std::fs::read_dir(folder).is_ok() {
                eprintln!("reached: {folder}");
            }
        }
    });
}
