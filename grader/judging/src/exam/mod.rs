//! What is asked and what counts as right: one self-contained file.
//!
//! Pure data. Who asks is the grader, who compares is `judge`.

mod key;

use std::fmt;

use protocol::Question;
use serde::{Deserialize, Serialize};

use crate::drawing_data::DrawingData;
use crate::section::Section;
use crate::signatures::{KnownMistake, MistakeSignatures};

pub use key::{ExpectedHit, HitCheck, Key, RayCheck, Surface, TreeCheck};

/// The six things to write, in lecture order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Task {
    /// `Camera::sample_ray`
    Camera,
    /// `Triangle::hit`
    Triangle,
    /// `Sphere::hit`
    Sphere,
    /// `BBox::hit`
    #[serde(rename = "bbox")]
    BBox,
    /// `Bvh::build`
    Build,
    /// `Bvh::hit`
    Traverse,
}

impl Task {
    /// All tasks, in lecture order.
    pub const ALL: [Task; 6] = [
        Task::Camera,
        Task::Triangle,
        Task::Sphere,
        Task::BBox,
        Task::Build,
        Task::Traverse,
    ];

    /// What the command line and files call it.
    pub fn id(self) -> &'static str {
        match self {
            Task::Camera => "camera",
            Task::Triangle => "triangle",
            Task::Sphere => "sphere",
            Task::BBox => "bbox",
            Task::Build => "build",
            Task::Traverse => "traverse",
        }
    }

    /// What people read.
    pub fn title(self) -> &'static str {
        match self {
            Task::Camera => "Task 1: camera rays",
            Task::Triangle => "Task 2: triangles",
            Task::Sphere => "Task 2: spheres",
            Task::BBox => "Task 3: boxes",
            Task::Build => "Task 3: building a BVH",
            Task::Traverse => "Task 3: walking a BVH",
        }
    }

    /// The file of a submission that holds it.
    pub fn file(self) -> &'static str {
        match self {
            Task::Camera => "camera.rs",
            Task::Triangle => "triangle.rs",
            Task::Sphere => "sphere.rs",
            Task::BBox => "bbox.rs",
            Task::Build | Task::Traverse => "bvh.rs",
        }
    }

    /// The method to write.
    pub fn method(self) -> &'static str {
        match self {
            Task::Camera => "sample_ray",
            Task::Triangle | Task::Sphere | Task::BBox | Task::Traverse => "hit",
            Task::Build => "build",
        }
    }

    /// The points that all its items add up to.
    pub fn points(self) -> u32 {
        match self {
            Task::Camera | Task::Sphere => 15,
            Task::Triangle | Task::Build | Task::Traverse => 20,
            Task::BBox => 10,
        }
    }
}

impl fmt::Display for Task {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.id())
    }
}

/// A whole exam: 100 points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exam {
    /// The version of this format.
    pub schema: u32,
    /// Such as `practice`.
    pub id: String,
    /// The mistakes that the items' tells speak of.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub mistakes: Vec<KnownMistake>,
    /// What is asked, in the order of asking: an item comes after those that it needs.
    pub items: Vec<Item>,
}

impl Exam {
    /// Some of its items, and those that they rest on.
    pub fn with_needed_items(&self, wanted: impl Fn(&Item) -> bool) -> Exam {
        let needing = self.items.iter().filter(|item| wanted(item));
        let needed: Vec<&String> = needing.flat_map(|item| &item.needs).collect();
        self.filter_items(|item| wanted(item) || needed.contains(&&item.id))
    }

    /// Some of its items.
    pub fn filter_items(&self, wanted: impl Fn(&Item) -> bool) -> Exam {
        let items = self.items.iter().filter(|item| wanted(item));
        Exam {
            schema: self.schema,
            id: self.id.clone(),
            mistakes: self.mistakes.clone(),
            items: items.cloned().collect(),
        }
    }
}

/// One idea, asked in several ways.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Item {
    /// The task's id, a dot, and a name: `sphere.from_inside`.
    pub id: String,
    /// What must hold, in words: the feedback.
    pub title: String,
    /// Whose points it counts for.
    pub task: Task,
    /// What it is worth.
    pub points: u32,
    /// Where to look if it is wrong; one or two sentences for students.
    pub look: String,
    /// What teaches it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub section: Option<Section>,
    /// Items of other tasks without which this one says nothing of its own task.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub needs: Vec<String>,
    /// What is asked. Every one must be right: the item's points are those of the worst.
    pub questions: Vec<ExamQuestion>,
    /// What known mistakes answer.
    #[serde(default, skip_serializing_if = "MistakeSignatures::is_empty")]
    #[serde(alias = "tells")]
    pub signatures: MistakeSignatures,
}

impl Item {
    /// How many elements its questions have together.
    pub fn count(&self) -> usize {
        let counts = self.questions.iter().map(|asked| asked.question.count());
        counts.sum()
    }

    /// What people call an element of a question: counted from 1 over all questions. A picture
    /// that is asked for as a whole has one number for all of its pixels.
    pub fn number(&self, question: usize, element: usize) -> usize {
        let before = self.questions[..question].iter();
        let before: usize = before.map(|asked| asked.question.count()).sum();
        let last = self.questions[question].question.count().saturating_sub(1);
        before + element.min(last) + 1
    }

    /// The question, and the element of it, that have this number.
    pub fn element(&self, number: usize) -> Option<(usize, usize)> {
        let mut left = number.checked_sub(1)?;
        for (question, asked) in self.questions.iter().enumerate() {
            let count = asked.question.count();
            if left < count {
                return Some((question, left));
            }
            left -= count;
        }
        None
    }
}

/// A question and its key.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ExamQuestion {
    /// What the probe is told.
    pub question: Question,
    /// What it is never told.
    pub key: Key,
    /// The right way there, for a drawing; neither told nor judged by.
    #[serde(default, skip_serializing_if = "DrawingData::is_none")]
    #[serde(alias = "shown")]
    pub drawing_data: DrawingData,
}

impl ExamQuestion {
    /// Of which nothing is shown beside its key.
    pub fn new(question: Question, key: Key) -> Self {
        ExamQuestion {
            question,
            key,
            drawing_data: DrawingData::None,
        }
    }
}
