
fn attack() {
    eprintln!("{:?} {:?}", option_env!("@VARIABLE@"), std::env::var("@VARIABLE@"));
}
