
fn attack() {
    eprintln!("{}", include_bytes!("/dev/zero").len());
}
