//! Domains: the subjects and arguments that the contract allows for each function, divided into
//! classes. Whatever isn't part of the idea that an item tests is picked at random from a domain.
//! The coverage of the contract is counted per class.
//!
//! A correct method treats all classes alike. A wrong one often fails for a single class, such as
//! small shapes, rays along an axis, or rays that start inside.

mod aimed;
mod balance;
pub mod bbox;
pub mod build;
pub mod camera;
pub mod classes;
pub mod fields;
pub mod light;
mod placed;
pub mod previous_call;
pub mod shape;
pub mod sphere;
mod tables;
pub mod traverse;
pub mod triangle;

use std::fmt::Debug;

use judging::exam::ExamQuestion;
use protocol::Question;

use crate::seed::Rng;

pub use aimed::Aimed;
pub use balance::Balance;
pub use placed::Placed;
pub use tables::{Change, Generator, SubjectCalls};

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

impl<C> Aspect<C> {
    /// Creates an aspect with this name, the names of its classes, and a function that classifies a
    /// call or returns `None` if the aspect does not apply to it.
    pub const fn new(
        name: &'static str,
        classes: &'static [&'static str],
        class: fn(&C) -> Option<usize>,
    ) -> Self {
        Aspect {
            name,
            classes,
            class,
        }
    }
}

/// A call to a function that may return nothing.
pub trait Call: Copy + 'static {
    /// The value that the function is called on.
    type Subject: Copy;
    /// The arguments.
    type Input: Copy;

    /// Creates a call that isn't preceded by another call.
    fn new(subject: Self::Subject, input: Self::Input) -> Self;

    /// Returns the value that the function is called on.
    fn subject(&self) -> Self::Subject;

    /// Returns the arguments.
    fn input(&self) -> Self::Input;

    /// Returns whether the correct answer is not `None`.
    fn is_hit(&self) -> bool;

    /// Returns this hit with a different range of distances, which may turn it into a miss.
    fn with_other_range(&self, rng: &mut Rng) -> Option<Self>;
}

/// The domain of a function.
#[derive(Debug)]
pub struct FunctionDomain<C: 'static> {
    /// The name of the function, as in [`protocol::AnyTable::name`].
    pub function: &'static str,
    /// The aspects of its calls, in groups.
    pub aspects: &'static [&'static [Aspect<C>]],
    /// The pairs of aspects whose classes are tested in all combinations.
    pub pairs: &'static [[&'static str; 2]],
    /// The fields, of the subject and the arguments, that some call has as its only change since
    /// the previous call.
    pub fields: &'static [&'static str],
    /// Returns the calls in a question about the function.
    pub calls: fn(&Question) -> Vec<C>,
    /// The classes that the exam need not test.
    pub not_asked: &'static [UntestedClasses],
}

/// Classes that the exam need not test, and the reason. An empty list stands for all aspects,
/// classes or columns.
#[derive(Debug)]
pub struct UntestedClasses {
    aspects: &'static [&'static str],
    classes: &'static [&'static str],
    columns: &'static [&'static str],
    /// The reason.
    pub why: &'static str,
}

/// Declares that an exam need not test these aspects.
pub const fn not_asked(aspects: &'static [&'static str]) -> UntestedClasses {
    UntestedClasses {
        aspects,
        classes: &[],
        columns: &[],
        why: "",
    }
}

impl UntestedClasses {
    /// Limits the declaration to these classes.
    pub const fn classes(self, classes: &'static [&'static str]) -> Self {
        UntestedClasses { classes, ..self }
    }

    /// Limits the declaration to these columns of the coverage table.
    pub const fn columns(self, columns: &'static [&'static str]) -> Self {
        UntestedClasses { columns, ..self }
    }

    /// States the reason.
    pub const fn because(self, why: &'static str) -> Self {
        UntestedClasses { why, ..self }
    }

    /// Returns whether this declaration says that `class` of `aspect` need not be tested in
    /// `column`.
    pub fn is_about(&self, aspect: &str, class: &str, column: &str) -> bool {
        let has = |list: &[&str], name: &str| list.is_empty() || list.contains(&name);
        has(self.aspects, aspect) && has(self.classes, class) && has(self.columns, column)
    }
}

/// An aspect of the first call on a subject. It applies only if calls on another subject come
/// before that call.
const SUBJECT_BEFORE: (&str, &[&str]) = ("first call", &["after another subject"]);

/// The domain of any function.
pub trait Domain: Debug + Sync {
    /// The name of the function.
    fn function(&self) -> &'static str;

    /// Returns the name and the classes of each aspect.
    fn aspects(&self) -> Vec<(&'static str, &'static [&'static str])>;

    /// Returns the pairs of aspects whose classes are tested in all combinations.
    fn pairs(&self) -> &'static [[&'static str; 2]];

    /// Returns the classes that the exam need not test.
    fn not_asked(&self) -> &'static [UntestedClasses];

    /// For each call in a question about the function, returns its class for each aspect that
    /// applies. `before` is the item's previous question, if any.
    fn classes(&self, question: &Question, before: Option<&Question>) -> Vec<Vec<Option<usize>>>;

    /// For each call in a question about the function, returns its class for the last aspect: the
    /// only field in which it differs from the previous call. See
    /// [`only_changes`](previous_call::only_changes).
    fn only_changes(
        &self,
        asked: &ExamQuestion,
        before: Option<&ExamQuestion>,
    ) -> Vec<Option<usize>>;
}

impl<C> FunctionDomain<C> {
    /// Creates a domain without aspects. `calls` returns the calls in a question about the
    /// function.
    pub const fn new(function: &'static str, calls: fn(&Question) -> Vec<C>) -> Self {
        FunctionDomain {
            function,
            aspects: &[],
            pairs: &[],
            fields: &[],
            calls,
            not_asked: &[],
        }
    }

    fn all_aspects(&self) -> impl Iterator<Item = &'static Aspect<C>> {
        self.aspects.iter().copied().flatten()
    }
}

impl<C: Debug> Domain for FunctionDomain<C> {
    fn function(&self) -> &'static str {
        self.function
    }

    fn aspects(&self) -> Vec<(&'static str, &'static [&'static str])> {
        let aspects = self.all_aspects();
        let aspects = aspects.map(|aspect| (aspect.name, aspect.classes));
        let only_change = (!self.fields.is_empty()).then_some((previous_call::NAME, self.fields));
        aspects.chain([SUBJECT_BEFORE]).chain(only_change).collect()
    }

    fn pairs(&self) -> &'static [[&'static str; 2]] {
        self.pairs
    }

    fn not_asked(&self) -> &'static [UntestedClasses] {
        self.not_asked
    }

    fn classes(&self, question: &Question, before: Option<&Question>) -> Vec<Vec<Option<usize>>> {
        let calls_of = |question: &Question| {
            let table = question.table();
            let is_other = table.is_some_and(|table| table.name() != self.function);
            if is_other {
                Vec::new()
            } else {
                (self.calls)(question)
            }
        };
        let is_after_another = before.is_some_and(|before| !calls_of(before).is_empty());
        let calls = calls_of(question);
        let classes = calls.iter().enumerate().map(|(index, call)| {
            let aspects = self.all_aspects();
            let classes = aspects.map(|aspect| (aspect.class)(call));
            let of_first = (index == 0 && is_after_another).then_some(0);
            classes.chain([of_first]).collect()
        });
        classes.collect()
    }

    fn only_changes(
        &self,
        asked: &ExamQuestion,
        before: Option<&ExamQuestion>,
    ) -> Vec<Option<usize>> {
        let table = asked.question.table();
        let is_other = table.is_none_or(|table| table.name() != self.function);
        if is_other || self.fields.is_empty() {
            return Vec::new();
        }
        previous_call::only_changes(self.fields, asked, before)
    }
}
