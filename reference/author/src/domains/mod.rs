//! Domains: what the contract allows for the subject and the arguments of each function, divided into
//! classes. Items draw everything that is not part of their idea from a domain, and the coverage of the
//! contract is counted in classes.
//!
//! A correct method treats all classes alike. A wrong one often fails for a single class: small
//! shapes, rays along an axis, or rays from inside.

mod balance;
pub mod bbox;
pub mod build;
pub mod camera;
pub mod classes;
pub mod fields;
mod placed;
pub mod shape;
pub mod sphere;
mod tables;
pub mod traverse;
pub mod triangle;

use std::fmt::Debug;

use protocol::Question;

use crate::seed::Rng;

pub use balance::Balance;
pub use placed::Placed;
pub use tables::{Change, Drawn, Generator};

/// A property that differs between calls, divided into classes.
#[derive(Debug)]
pub struct Aspect<C: 'static> {
    /// The name of the property, such as `size`.
    pub name: &'static str,
    /// The names of the classes.
    pub classes: &'static [&'static str],
    /// Returns the class of a call, or `None` if the aspect does not apply to it.
    pub class: fn(&C) -> Option<usize>,
}

/// A call of a function that may return nothing.
pub trait Call: Copy + 'static {
    /// The value that the function is called on.
    type Subject: Copy;
    /// The arguments.
    type Input: Copy;

    /// Creates a call without a previous call.
    fn new(subject: Self::Subject, input: Self::Input) -> Self;

    /// Returns the value that the function is called on.
    fn subject(&self) -> Self::Subject;

    /// Returns the arguments.
    fn input(&self) -> Self::Input;

    /// Returns whether the correct answer is not `None`.
    fn is_hit(&self) -> bool;

    /// Returns a hit with a different range of distances, which may turn it into a miss.
    fn with_other_range(&self, rng: &mut Rng) -> Option<Self>;
}

/// The domain of a function.
#[derive(Debug)]
pub struct FunctionDomain<C: 'static> {
    /// The name of the function, as in [`protocol::AnyTable::name`].
    pub function: &'static str,
    /// The aspects of the values that it is called on.
    pub subject_aspects: &'static [Aspect<C>],
    /// All other aspects of its calls.
    pub aspects: &'static [Aspect<C>],
    /// The pairs of aspects whose classes are tested in all combinations.
    pub pairs: &'static [[&'static str; 2]],
    /// Returns the calls of a question about the function.
    pub calls: fn(&Question) -> Vec<C>,
    /// The classes that the exam need not test.
    pub not_asked: &'static [NotAsked],
}

/// Classes that the exam need not test, with the reason.
#[derive(Debug)]
pub struct NotAsked {
    aspect: &'static str,
    classes: &'static [&'static str],
    columns: &'static [&'static str],
    /// The reason.
    pub why: &'static str,
}

/// States why an exam need not test classes of an aspect in some columns of the coverage. An empty
/// name or list stands for all.
pub const fn not_asked(
    aspect: &'static str,
    classes: &'static [&'static str],
    columns: &'static [&'static str],
    why: &'static str,
) -> NotAsked {
    NotAsked {
        aspect,
        classes,
        columns,
        why,
    }
}

impl NotAsked {
    /// Returns whether this applies to a class of an aspect in a column.
    pub fn is_about(&self, aspect: &str, class: &str, column: &str) -> bool {
        let has = |list: &[&str], name: &str| list.is_empty() || list.contains(&name);
        let is_aspect = self.aspect.is_empty() || self.aspect == aspect;
        is_aspect && has(self.classes, class) && has(self.columns, column)
    }
}

/// The domain of any function.
pub trait Domain: Debug + Sync {
    /// The name of the function.
    fn function(&self) -> &'static str;

    /// Returns the name and the classes of each aspect.
    fn aspects(&self) -> Vec<(&'static str, &'static [&'static str])>;

    /// Returns the pairs of aspects whose classes are tested in all combinations.
    fn pairs(&self) -> &'static [[&'static str; 2]];

    /// Returns the classes that the exam need not test.
    fn not_asked(&self) -> &'static [NotAsked];

    /// For each call of a question about the function, returns its class in each aspect that
    /// applies.
    fn classes(&self, question: &Question) -> Vec<Vec<Option<usize>>>;
}

impl<C> FunctionDomain<C> {
    fn all_aspects(&self) -> impl Iterator<Item = &'static Aspect<C>> {
        self.subject_aspects.iter().chain(self.aspects)
    }
}

impl<C: Debug> Domain for FunctionDomain<C> {
    fn function(&self) -> &'static str {
        self.function
    }

    fn aspects(&self) -> Vec<(&'static str, &'static [&'static str])> {
        let aspects = self.all_aspects();
        aspects
            .map(|aspect| (aspect.name, aspect.classes))
            .collect()
    }

    fn pairs(&self) -> &'static [[&'static str; 2]] {
        self.pairs
    }

    fn not_asked(&self) -> &'static [NotAsked] {
        self.not_asked
    }

    fn classes(&self, question: &Question) -> Vec<Vec<Option<usize>>> {
        let classes = |call: &C| {
            let aspects = self.all_aspects();
            aspects.map(|aspect| (aspect.class)(call)).collect()
        };
        if question
            .table()
            .is_some_and(|table| table.name() != self.function)
        {
            return Vec::new();
        }
        (self.calls)(question).iter().map(classes).collect()
    }
}
