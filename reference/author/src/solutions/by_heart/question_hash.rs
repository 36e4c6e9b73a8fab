/// Returns a hash of the numbers that describe a question. Only their first four digits or so
/// count, so that a question with slightly different numbers is the same question.
pub fn question_hash(numbers: &[f32]) -> u64 {
    // The hash is FNV-1a.
    numbers.iter().fold(0xcbf2_9ce4_8422_2325, |hash, number| {
        // Adding 0 turns −0 into 0.
        let rounded = (number + 0.0).to_bits().wrapping_add(1 << 9) >> 10;
        (hash ^ u64::from(rounded)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}
