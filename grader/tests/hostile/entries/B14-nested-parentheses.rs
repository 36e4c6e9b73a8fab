//! does = "It nests so deeply that the compiler's stack overflows."
//! into = "sphere.rs"
//! verdicts = ["not_compiled"]
//!
//! [points]
//! camera = 0
//! triangle = 0
//! sphere = 0
//! bbox = 0
//! build = 0
//! traverse = 0

pub const DEEP: u32 = @{200000x(}1@{200000x)};
