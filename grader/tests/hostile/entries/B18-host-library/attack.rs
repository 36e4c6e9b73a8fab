
#[link(name = "c", kind = "static")]
unsafe extern "C" {
    fn getuid() -> u32;
}
