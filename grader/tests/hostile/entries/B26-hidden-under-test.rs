//! does = "It does not compile in tests and debug builds."
//! into = "sphere.rs"
//! slow = true

#[cfg(test)]
compile_error!("this is a test");
#[cfg(debug_assertions)]
compile_error!("this is a debug build");
