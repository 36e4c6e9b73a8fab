//! does = "It starts other programs, and itself."
//! least = "no-namespaces"
//! into = "camera.rs"
//! within = ["sample_ray"]
//! slow = true

fn attack() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        for program in ["/bin/true", "/usr/bin/true", "/proc/self/exe", "sh"] {
            if std::process::Command::new(program).spawn().is_ok() {
                eprintln!("reached: {program}");
            }
        }
    });
}
