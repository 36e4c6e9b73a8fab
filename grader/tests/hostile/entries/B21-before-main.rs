//! does = "It runs code before `main`."
//! into = "sphere.rs"
//! verdicts = ["not_compiled"]
//! slow = true
//!
//! [points]
//! sphere = 0

#[used]
#[unsafe(link_section = ".init_array")]
static FIRST: extern "C" fn() = first;
extern "C" fn first() {
    std::process::exit(0);
}
