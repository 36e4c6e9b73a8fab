//! An honest program. If the system kills a submission's program, and then runs this one, the
//! machine is not the reason.

/// As much memory as a program may use and still count as a small one.
const BYTES: usize = 256 << 20;
const PAGE: usize = 4096;

fn main() {
    let mut memory = vec![0_u8; BYTES];
    for page in memory.chunks_mut(PAGE) {
        page[0] = 1;
    }
    let pages: usize = memory.iter().map(|&byte| usize::from(byte)).sum();
    assert_eq!(pages, BYTES / PAGE);
    println!("end");
}
