//! does = "It needs infinitely many types."
//! into = "sphere.rs"
//! within = ["hit"]
//! verdicts = ["not_compiled"]
//! slow = true
//!
//! [points]
//! sphere = 0

fn deeper<T: Default + std::fmt::Debug>(depth: u32) {
    if depth > 0 {
        deeper::<Option<T>>(depth - 1);
    }
    eprintln!("{:?}", T::default());
}
fn attack() {
    deeper::<u8>(200);
}
