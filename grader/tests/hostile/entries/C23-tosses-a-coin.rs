//! does = "Its answers depend on the clock."
//! into = "sphere.rs"
//! within = ["hit"]
//! call = "if attack() { return None; }"
//! verdicts = ["wrong", "partial"]
//! slow = true
//!
//! [points]
//! sphere = 3

fn attack() -> bool {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    now.is_ok_and(|now| now.subsec_nanos() & 1 == 0)
}
