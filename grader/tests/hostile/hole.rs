static STATIC: &&() = &&();

fn stretched<'a, 'b, T>(_: &'a &'b (), value: &'b mut T) -> &'a mut T {
    value
}

enum Either<A, B> {
    A(Option<Box<A>>),
    B(Option<Box<B>>),
}

#[inline(never)]
fn exchange<A: 'static, B: 'static>(either: &mut Either<A, B>, value: A) -> B {
    type Stretch<B> = for<'x> fn(&'static &'static (), &'x mut B) -> &'static mut B;
    let stretch: Stretch<Option<Box<B>>> = stretched;
    let Either::B(old) = either else {
        unreachable!()
    };
    let old = stretch(STATIC, old);
    *either = Either::A(Some(Box::new(value)));
    std::hint::black_box(either);
    *old.take().unwrap()
}

/// Converts a value to a different type without a line of unsafe code (rust-lang issue 25860): the
/// reference to the contents of the old variant outlives that variant.
fn transmuted<A: 'static, B: 'static>(value: A) -> B {
    exchange(std::hint::black_box(&mut Either::B(None)), value)
}
