compile_error!("this is not camera.rs");
