compile_error!("this is not the given lib.rs");
