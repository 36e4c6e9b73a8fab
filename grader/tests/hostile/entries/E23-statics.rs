//! does = "Its static variables exceed its memory limit, so it does not start."
//! into = "camera.rs"
//! within = ["sample_ray"]
//! verdicts = ["crashed", "timed_out"]
//!
//! [points]
//! camera = 0
//! triangle = 0
//! sphere = 0
//! bbox = 0
//! build = 20
//! traverse = 20

type Big = std::sync::Mutex<std::mem::MaybeUninit<[u8; 100 << 20]>>;
const BIG: Big = std::sync::Mutex::new(std::mem::MaybeUninit::uninit());
macro_rules! big {
    ($($name:ident)*) => {
        $(static $name: Big = BIG;)*
        fn attack() {
            std::hint::black_box(($(&$name,)*));
        }
    };
}
big! { A B C D E F G H I J K }
