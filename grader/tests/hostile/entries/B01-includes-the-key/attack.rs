
fn attack() {
    eprintln!(concat!("reac", "hed: {}"), include_str!("@KEY@"));
}
