//! does = "Its program is larger than a program may be."
//! into = "sphere.rs"
//! within = ["hit"]
//! verdicts = ["not_compiled"]
//! says = "the limit is 64 MiB"
//!
//! [points]
//! camera = 0
//! triangle = 0
//! sphere = 0
//! bbox = 0
//! build = 0
//! traverse = 0

static BIG: [u8; 80 << 20] = [1; 80 << 20];
fn attack() {
    std::hint::black_box(&BIG);
}
