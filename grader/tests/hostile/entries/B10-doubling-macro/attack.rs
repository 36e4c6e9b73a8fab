
macro_rules! twice {
    ($($thing:tt)*) => { twice! { $($thing)* $($thing)* } };
}
twice! { fn }
