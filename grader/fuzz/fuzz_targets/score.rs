#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::Target::find("score")
    .expect("the target exists")
    .run(bytes));
