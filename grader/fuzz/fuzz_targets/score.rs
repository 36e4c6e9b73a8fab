#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| fuzz::Target::named("score")
    .expect("a target")
    .run(bytes));
