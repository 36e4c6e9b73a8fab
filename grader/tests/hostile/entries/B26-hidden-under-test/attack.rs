
#[cfg(test)]
compile_error!("this is a test");
#[cfg(debug_assertions)]
compile_error!("this is a debug build");
