//! does = "It reads the environment, arguments and memory of other processes."
//! least = "no-namespaces"
//! into = "camera.rs"
//! within = ["sample_ray"]

fn attack() {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        for number in (1..64).chain([std::os::unix::process::parent_id()]) {
            for file in ["environ", "cmdline", "maps", "stat", "mem"] {
                if std::fs::File::open(format!("/proc/{number}/{file}")).is_ok() {
                    eprintln!("reached: {file} of {number}");
                }
            }
        }
    });
}
