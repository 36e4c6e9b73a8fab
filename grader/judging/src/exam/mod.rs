//! The exam: questions and their answer keys, in one self-contained file.
//!
//! This module is pure data. The grader sends the questions, and [`judge`](mod@crate::judge)
//! compares the answers.

mod key;
mod subset;

use protocol::{Question, Shape};
use serde::{Deserialize, Serialize};

use crate::assignment::{Assignment, Task};
use crate::drawing_data::DrawingData;
use crate::section::Section;
use crate::signatures::{KnownMistake, MistakeSignatures};
use crate::symptom::{Side, Symptom};

pub use key::{Aggregate, ExpectedRows, Key, Surface, TreeCheck};
pub use subset::question_subset;

/// An exam, worth 100 points in total.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exam {
    /// Version of the file format.
    pub schema: u32,
    /// Id of the assignment.
    pub assignment: String,
    /// Name of the exam, such as `practice`.
    pub id: String,
    /// The known mistakes. The items' signatures refer to them by index.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub mistakes: Vec<KnownMistake>,
    /// The items, in grading order. An item comes after the items it needs.
    pub items: Vec<Item>,
}

impl Exam {
    /// The version of the file format.
    pub const SCHEMA: u32 = 3;

    /// Creates an exam without known mistakes.
    pub fn new(assignment: &Assignment, id: &str, items: Vec<Item>) -> Self {
        Exam {
            schema: Exam::SCHEMA,
            assignment: assignment.id.to_owned(),
            id: id.to_owned(),
            mistakes: Vec::new(),
            items,
        }
    }

    /// Returns the assignment's tasks in grading order: a task is graded after the tasks that its
    /// items depend on, so the order is that of the tasks' first items. Tasks without items come
    /// last.
    pub fn tasks_in_order(&self, assignment: &Assignment) -> Vec<Task> {
        let first_item = |task: &Task| {
            let index = self.items.iter().position(|item| item.task == *task);
            index.unwrap_or(self.items.len())
        };
        let mut tasks: Vec<Task> = assignment.tasks().collect();
        tasks.sort_by_key(first_item);
        tasks
    }

    /// Returns an exam with the items that `wanted` selects and the items they need.
    pub fn with_needed_items(&self, wanted: impl Fn(&Item) -> bool) -> Exam {
        let dependents = self.items.iter().filter(|item| wanted(item));
        let needed: Vec<&String> = dependents.flat_map(|item| &item.needs).collect();
        self.filter_items(|item| wanted(item) || needed.contains(&&item.id))
    }

    /// Returns an exam with only the items that `wanted` selects.
    pub fn filter_items(&self, wanted: impl Fn(&Item) -> bool) -> Exam {
        let items = self.items.iter().filter(|item| wanted(item));
        Exam {
            schema: self.schema,
            assignment: self.assignment.clone(),
            id: self.id.clone(),
            mistakes: self.mistakes.clone(),
            items: items.cloned().collect(),
        }
    }
}

/// One idea, tested by one or more questions.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Item {
    /// The task's id, a dot, and a name, such as `sphere.from_inside`.
    pub id: String,
    /// One sentence that says what a correct solution must do. Students read it as feedback.
    pub title: String,
    /// The task that the points count towards.
    pub task: Task,
    /// Points for the item.
    pub points: u32,
    /// One or two sentences that tell a student where to look if the item fails.
    pub look: String,
    /// The symptoms that `look` and `section` are about. Empty if they are about all symptoms.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub look_fits: Vec<Symptom>,
    /// The handout section that teaches the item.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub section: Option<Section>,
    /// Ids of items from other tasks. The code that they test must work before this item can test
    /// its own task.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub needs: Vec<String>,
    /// The questions. The item earns the credit of its worst question.
    pub questions: Vec<ExamQuestion>,
    /// The answers produced by known mistakes, used to recognise the mistake behind a wrong answer.
    #[serde(default, skip_serializing_if = "MistakeSignatures::is_empty")]
    pub signatures: MistakeSignatures,
}

impl Item {
    /// Creates an item without texts, signatures or needed items.
    ///
    /// # Panics
    ///
    /// If the id doesn't begin with a task's id.
    pub fn new(id: &str, points: u32, questions: Vec<ExamQuestion>) -> Self {
        Item {
            id: id.to_owned(),
            title: String::new(),
            task: Task::in_id(id).expect("an item's id must begin with the name of its task"),
            points,
            look: String::new(),
            look_fits: Vec::new(),
            section: None,
            needs: Vec::new(),
            questions,
            signatures: MistakeSignatures::default(),
        }
    }

    /// Returns whether `look` and `section` are about this symptom. They assume that the answer is
    /// a number, unless `look_fits` says otherwise.
    pub fn has_look_for(&self, symptom: &Symptom) -> bool {
        let mut fits = self.look_fits.iter();
        let is_about_numbers = self.look_fits.is_empty();
        is_about_numbers && symptom.side != Some(Side::NotANumber)
            || fits.any(|fitting| fitting.includes(symptom))
    }

    /// Returns the number of elements in all questions of the item.
    pub fn count(&self) -> usize {
        let counts = self
            .questions
            .iter()
            .map(|question| question.question.count());
        counts.sum()
    }

    /// Returns the number of an element as shown to people, counting from 1 across all questions of
    /// the item. A rendered picture is one element, so all of its pixels share a number.
    pub fn number(&self, question: usize, element: usize) -> usize {
        let before = self.questions[..question].iter();
        let before: usize = before.map(|question| question.question.count()).sum();
        let last = self.questions[question].question.count().saturating_sub(1);
        before + element.min(last) + 1
    }

    /// Returns the indices of the question and the element with this number, or `None` if the
    /// number is out of range.
    pub fn element(&self, number: usize) -> Option<(usize, usize)> {
        let mut left = number.checked_sub(1)?;
        for (index, question) in self.questions.iter().enumerate() {
            let count = question.question.count();
            if left < count {
                return Some((index, left));
            }
            left -= count;
        }
        None
    }
}

/// A question and its answer key.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExamQuestion {
    /// The question, which is sent to the probe.
    pub question: Question,
    /// The answer key, which never leaves the grader.
    pub key: Key,
    /// Data for drawing the correct answer. It isn't sent to the probe and isn't judged.
    #[serde(default, skip_serializing_if = "DrawingData::is_none")]
    pub drawing_data: DrawingData,
}

impl ExamQuestion {
    /// Creates a question without drawing data.
    pub fn new(question: Question, key: Key) -> Self {
        ExamQuestion {
            question,
            key,
            drawing_data: DrawingData::None,
        }
    }

    /// Creates a question about a tree over these shapes. The cost of the submitted tree is judged
    /// if `sweep_cost` is given.
    pub fn tree(
        shapes: Vec<Shape>,
        max_leaf_size: u32,
        checks: &[TreeCheck],
        sweep_cost: Option<f64>,
    ) -> Self {
        let question = Question::Build {
            shapes,
            max_leaf_size,
        };
        let checks = checks.to_vec();
        ExamQuestion::new(question, Key::Tree { checks, sweep_cost })
    }

    /// Returns a question that consists of only this element and its key. A question with a single
    /// element is returned unchanged.
    ///
    /// # Panics
    ///
    /// If the element doesn't exist.
    pub fn single(&self, element: usize) -> ExamQuestion {
        ExamQuestion::new(
            question_subset(&self.question, element..element + 1),
            subset::single_key(&self.key, element),
        )
    }
}
