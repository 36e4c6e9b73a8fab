//! does = "Its macro doubles in size with each expansion."
//! into = "sphere.rs"
//! verdicts = ["not_compiled"]
//! wall = 300
//! slow = true
//!
//! [points]
//! camera = 0
//! triangle = 0
//! sphere = 0
//! bbox = 0
//! build = 0
//! traverse = 0

macro_rules! twice {
    ($($thing:tt)*) => { twice! { $($thing)* $($thing)* } };
}
twice! { fn }
