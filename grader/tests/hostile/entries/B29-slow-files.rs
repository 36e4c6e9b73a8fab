//! does = "Each attempt to compile it finds another file that takes a long time."
//! into = "sphere.rs"
//! also_into = ["bbox.rs"]
//! within = ["hit"]
//! verdicts = ["not_compiled"]
//! says = "the compiler was stopped"
//! wall = 200
//! slow = true
//!
//! [points]
//! camera = 0
//! triangle = 0
//! sphere = 0
//! bbox = 0
//! build = 0
//! traverse = 0

// The error in `sphere.rs` is found late, and hides the endless constant in `bbox.rs`.
const IS_SPHERE: bool = module_path!().len() == "probe::sphere".len();
#[allow(long_running_const_eval)]
const SLOW: usize = {
    let mut n = 0_u64;
    while IS_SPHERE && n < 60_000_000 {
        n += 1;
    }
    IS_SPHERE as usize
};
static _WRONG: [u8; 0] = [0; SLOW];
struct Late<T>(#[allow(dead_code)] T);
impl<T> Late<T> {
    #[allow(long_running_const_eval)]
    const ENDLESS: u32 = {
        let mut n = 0_u32;
        while n < 2 {
            n = (n + 1) % 2;
        }
        n
    };
}
fn attack() {
    eprintln!("{}", Late::<u8>::ENDLESS);
}
