compile_error!("this is not the given world.rs");
