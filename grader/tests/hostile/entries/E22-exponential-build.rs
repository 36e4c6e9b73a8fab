//! does = "Its tree builder takes 2^n steps."
//! into = "bvh.rs"
//! within = ["build"]
//! arguments = ["--cpu-limit", "1"]
//! verdicts = ["timed_out", "blocked"]
//! wall = 90
//! slow = true
//!
//! [points]
//! build = 0
//! traverse = 20

fn attack() {
    fn both(n: u32) -> u64 {
        std::hint::black_box(if n == 0 { 1 } else { both(n - 1) + both(n - 1) })
    }
    eprintln!("{}", both(60));
}
