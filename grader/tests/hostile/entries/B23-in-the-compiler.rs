//! does = "It tries to be a procedural macro, which runs in the compiler."
//! into = "sphere.rs"
//! verdicts = ["not_compiled"]
//! slow = true
//!
//! [points]
//! sphere = 0

#![crate_type = "proc-macro"]
extern crate proc_macro;
#[proc_macro]
pub fn now(_: proc_macro::TokenStream) -> proc_macro::TokenStream {
    std::process::abort()
}
