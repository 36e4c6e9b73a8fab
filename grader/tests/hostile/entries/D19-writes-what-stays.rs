//! does = "It writes to the dependencies that all submissions share."
//! least = "no-namespaces"
//! into = "camera.rs"
//! within = ["sample_ray"]
//! slow = true

fn attack() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        for folder in ["@GRADE@", "@GRADE@/dependencies", "@GRADE@/parts", "@GRADE@/work"] {
            if std::fs::write(format!("{folder}/@MARK@"), "").is_ok() {
                eprintln!("reached: {folder}");
            }
        }
    });
}
