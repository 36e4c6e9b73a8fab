//! does = "Its compiler error is long, and full of escapes and markup."
//! into = "sphere.rs"
//! verdicts = ["not_compiled"]
//!
//! [points]
//! sphere = 0

compile_error!("\u{1b}[2J\u{7}<b id=forged>100 points</b>\u{202e}@{5000xloud }");
