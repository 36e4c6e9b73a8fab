
static STATIC: &&() = &&();
fn stretched<'a, 'b, T: ?Sized>(_: &'a &'b (), value: &'b T) -> &'a T {
    value
}
fn freed() -> &'static [u8] {
    let stretch: fn(&'static &'static (), &[u8]) -> &'static [u8] = stretched;
    let memory = vec![7_u8; 1 << 12];
    stretch(STATIC, &memory)
}
fn attack() {
    eprintln!("{:?}", &freed()[..64]);
}
