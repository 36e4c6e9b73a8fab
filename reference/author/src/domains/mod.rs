//! Domains: what the contract allows for the subject and the arguments of each function, divided into
//! classes. Items draw what varies beside their idea from a domain, and the coverage of the contract is
//! counted in classes.
//!
//! A correct method treats all classes alike. A wrong one often fails in one class only: for small
//! shapes, along an axis, from inside.

mod balance;
pub mod fields;
pub mod shape;
pub mod sphere;
pub mod triangle;

use protocol::Question;

pub use balance::Balance;

/// One way in which calls differ, divided into classes.
#[derive(Debug)]
pub struct Aspect<C: 'static> {
    /// What differs, such as `size`.
    pub name: &'static str,
    /// The names of the classes.
    pub classes: &'static [&'static str],
    /// Returns the class of a call, or `None` if the aspect does not apply to it.
    pub class: fn(&C) -> Option<usize>,
}

/// The aspects of the calls of a function.
pub trait Domain: Sync {
    /// The name of the function, as in [`protocol::AnyTable::name`].
    fn function(&self) -> &'static str;

    /// Returns the names of the aspects, each with its classes.
    fn aspects(&self) -> Vec<(&'static str, &'static [&'static str])>;

    /// Returns the classes of each call of a question about the function: one for each aspect that
    /// applies.
    fn classes(&self, question: &Question) -> Vec<Vec<Option<usize>>>;
}
