//! `hit`, which takes a ray and returns its closest hit, for triangles, spheres and trees.

use std::borrow::Cow;

use glam::UVec2;
use serde::{Deserialize, Serialize};

use super::{Function, Input, Output, Question, ResultText, Submission, Table, View};
use crate::answer::{Answer, ElementOutcome};
use crate::packed;
use crate::ray::{Ray, Trace};
use crate::shape::Shape;
use crate::submission::Aggregate;
use crate::tree::TreeNode;
use crate::value::{Fields, Record, Value, fields};
use crate::view::{ExamCamera, Sample};

/// Finds the closest hits of rays.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hit;

/// The geometry that rays hit, and how it is searched.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Geometry {
    /// Calls every shape's `hit` and takes the closest hit. No tree is involved.
    List {
        /// The shapes, tested one by one.
        #[serde(with = "packed")]
        shapes: Vec<Shape>,
    },
    /// Calls `Bvh::hit` on a tree from the exam.
    Tree {
        /// The primitives, in the order that the leaves index them.
        #[serde(with = "packed")]
        shapes: Vec<Shape>,
        /// The nodes, in any order.
        #[serde(with = "packed")]
        nodes: Vec<TreeNode>,
        /// The index of the root in `nodes`.
        root: u32,
    },
    /// Calls `Bvh::hit` on the tree returned by the submission's `Bvh::build`.
    BuiltTree {
        /// The primitives to build the tree over.
        #[serde(with = "packed")]
        shapes: Vec<Shape>,
        /// The maximum number of primitives in a leaf.
        max_leaf_size: u32,
    },
}

impl Geometry {
    /// Returns the shapes.
    pub fn shapes(&self) -> &[Shape] {
        match self {
            Geometry::List { shapes }
            | Geometry::Tree { shapes, .. }
            | Geometry::BuiltTree { shapes, .. } => shapes,
        }
    }
}

impl Function for Hit {
    type Subject = Geometry;
    type Input = Ray;
    type Output = Option<Trace>;

    fn name(subject: &Geometry) -> &'static str {
        match subject {
            Geometry::Tree { .. } | Geometry::BuiltTree { .. } => "Bvh::hit",
            Geometry::List { shapes } => match shapes.first() {
                Some(Shape::Sphere { .. }) => "Sphere::hit",
                Some(Shape::Triangle { .. } | Shape::FlatTriangle { .. }) | None => "Triangle::hit",
            },
        }
    }

    fn sentence(subject: &Geometry) -> &'static str {
        match subject {
            Geometry::List { .. } => "{ray}; {shapes}",
            Geometry::Tree { nodes, .. } if nodes.len() == 1 => {
                "{ray}; a tree from the exam: {nodes} node, root {root}, over {shapes}"
            }
            Geometry::Tree { .. } => {
                "{ray}; a tree from the exam: {nodes} nodes, root {root}, over {shapes}"
            }
            Geometry::BuiltTree { .. } => {
                "{ray}; your own tree over {shapes}, with at most {max_leaf_size} in each leaf"
            }
        }
    }

    fn question(table: Table<Self>) -> Question {
        Question::Hit(table)
    }

    fn calls<'a>(
        submission: &'a dyn Submission,
        subject: &'a Geometry,
    ) -> impl Fn(&Ray) -> Option<Trace> + 'a {
        let aggregate: Box<dyn Aggregate> = match subject {
            Geometry::List { shapes } => submission.primitive_list(shapes),
            Geometry::Tree {
                shapes,
                nodes,
                root,
            } => submission.prebuilt_tree(shapes, nodes, *root as usize),
            Geometry::BuiltTree {
                shapes,
                max_leaf_size,
            } => submission.build(shapes, *max_leaf_size as usize),
        };
        move |ray| aggregate.closest_hit(ray)
    }
}

impl Record for Geometry {
    fn names(&self) -> &'static [&'static str] {
        match self {
            Geometry::List { .. } => &["shapes"],
            Geometry::Tree { .. } => &["shapes", "nodes", "root"],
            Geometry::BuiltTree { .. } => &["shapes", "max_leaf_size"],
        }
    }

    fn value(&self, index: usize) -> Value<'_> {
        match (self, self.names()[index]) {
            (Geometry::Tree { nodes, .. }, "nodes") => Value::Nodes(Cow::Borrowed(nodes)),
            (Geometry::Tree { root, .. }, "root") => Value::Index(*root),
            (Geometry::BuiltTree { max_leaf_size, .. }, "max_leaf_size") => {
                Value::Count(*max_leaf_size)
            }
            _ => Value::Shapes(Cow::Borrowed(self.shapes())),
        }
    }

    fn set(&mut self, _: usize, value: Value<'_>) {
        match (self, value) {
            (
                Geometry::List { shapes }
                | Geometry::Tree { shapes, .. }
                | Geometry::BuiltTree { shapes, .. },
                Value::Shapes(new),
            ) => *shapes = new.into_owned(),
            (Geometry::Tree { nodes, .. }, Value::Nodes(new)) => *nodes = new.into_owned(),
            (Geometry::Tree { root, .. }, Value::Index(new)) => *root = new,
            (Geometry::BuiltTree { max_leaf_size, .. }, Value::Count(new)) => *max_leaf_size = new,
            _ => {}
        }
    }
}

impl Input for Ray {
    type View = ExamCamera;
}

impl View<Ray> for ExamCamera {
    fn film(&self) -> UVec2 {
        self.film
    }

    fn input(&self, sample: Sample) -> Ray {
        self.ray(sample)
    }
}

fields! {
    Trace {
        "distance": Length = distance,
        "position": Point = position,
        "normal": Direction = normal,
        "uv": Uv = uv,
        "origin": Point = origin,
        "shape": Index = shape,
    }
}

impl Output for Option<Trace> {
    type Record = Trace;

    const NAMES: &'static [&'static str] = <Trace as Fields>::NAMES;
    const RESULT_TEXT: ResultText = ResultText {
        record: "distance {distance}, position {position}, normal {normal}, uv {uv}, \
                 shape {shape}",
        present: "a hit at distance {distance}",
        absent: "no hit",
    };
    // 12 floats and a variable-length number.
    const MAX_BYTES: usize = 12 * size_of::<f32>() + 6;

    fn record(&self) -> Option<&Trace> {
        self.as_ref()
    }

    fn record_mut(&mut self) -> Option<&mut Trace> {
        self.as_mut()
    }

    fn answer(rows: Vec<ElementOutcome<Self>>) -> Answer {
        Answer::Hits(rows)
    }
}
