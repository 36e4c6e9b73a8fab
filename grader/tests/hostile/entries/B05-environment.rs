//! does = "It reads a variable of the grader's environment at compile time, and prints it. With a PATH or a home folder, it would not compile."
//! into = "sphere.rs"
//! within = ["hit"]

fn attack() {
    const _: () = assert!(option_env!("PATH").is_none() && option_env!("HOME").is_none());
    eprintln!("{:?} {:?}", option_env!("@VARIABLE@"), std::env::var("@VARIABLE@"));
}
