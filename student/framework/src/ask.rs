//! How a submission is asked for one element of an answer.

/// Answers elements: any closure does.
///
/// A trait of its own, and not `FnMut`: a closure behind `dyn FnMut` is compiled twice, once more for
/// `FnOnce`, with all that is inlined into it, and every submission waits for that.
pub trait Ask<Element, Answer> {
    /// The answer to one element.
    fn ask(&mut self, element: Element) -> Answer;
}

impl<Element, Answer, F: FnMut(Element) -> Answer> Ask<Element, Answer> for F {
    fn ask(&mut self, element: Element) -> Answer {
        self(element)
    }
}
