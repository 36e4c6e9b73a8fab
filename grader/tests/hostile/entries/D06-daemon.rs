//! does = "It leaves a process running in a separate session."
//! least = "no-namespaces"
//! into = "camera.rs"
//! within = ["sample_ray"]
//!
//! [also.light]
//! into = "material.rs"
//! within = ["reflect"]

fn attack() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        let daemon = "setsid sh -c 'sleep 300' >/dev/null 2>&1 &";
        let mut shell = std::process::Command::new("/bin/sh");
        if shell.args(["-c", daemon]).status().is_ok() {
            eprintln!("reached: a shell");
        }
    });
}
