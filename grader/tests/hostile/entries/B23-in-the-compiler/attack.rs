
#![crate_type = "proc-macro"]
extern crate proc_macro;
#[proc_macro]
pub fn now(_: proc_macro::TokenStream) -> proc_macro::TokenStream {
    std::process::abort()
}
