//! The control program. If the system kills a submission's program but then runs the control
//! program to the end, the machine isn't to blame.

/// The most memory a program may use and still be considered small.
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
