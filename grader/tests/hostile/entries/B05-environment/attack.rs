
fn attack() {
    const _: () = assert!(option_env!("PATH").is_none() && option_env!("HOME").is_none());
    eprintln!("{:?} {:?}", option_env!("@VARIABLE@"), std::env::var("@VARIABLE@"));
}
