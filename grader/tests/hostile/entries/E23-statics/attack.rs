
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
