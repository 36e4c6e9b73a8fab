
fn attack() {
    eprintln!(concat!("reac", "hed: {:?}"), &include_bytes!("/etc/passwd")[..8]);
}
