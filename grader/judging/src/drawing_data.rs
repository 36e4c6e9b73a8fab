//! Data for drawings that explain the correct answer, such as the order in which a correct
//! traversal visits the nodes.
//!
//! The data is stored in the exam file because the grader contains no solution that could compute
//! it. It isn't judged and isn't sent to the probe.

use glam::Vec3;
use protocol::{Geometry, Interval, LightQuestion, Question, Rows, packed};
use serde::{Deserialize, Serialize};

/// The intermediate steps that lead to the correct answers to one question.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum DrawingData {
    /// No data.
    #[default]
    None,
    /// Data for tables of `BBox::hit`: for each query and each axis, the interval that the ray
    /// spends between the two planes, ignoring the query's `times` and the ray's range. If the ray
    /// is parallel to the planes, the interval is unbounded or empty.
    Slabs(#[serde(with = "packed::text")] Vec<[Interval; 3]>),
    /// Data for tables of hits in a tree from the exam: one correct traversal per ray.
    Traversals(#[serde(with = "packed::text")] Vec<Vec<TraversalStep>>),
    /// Data for `Build` questions: the tree of the exact SAH sweep.
    Sweep(#[serde(with = "packed::text")] UpperLevels),
    /// Data for tables of `radiance`: one correct path per ray.
    Paths(#[serde(with = "packed::text")] Vec<Vec<PathStep>>),
}

/// One hit of a path. Steps are listed in order.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PathStep {
    /// The kind of surface that the path hits.
    pub hit: PathHit,
    /// Position of the hit in world space, or a point on the ray if it hits nothing.
    pub position: Vec3,
    /// The factor for light from here: the product of all earlier attenuations, divided by the
    /// probabilities of survival.
    pub throughput: Vec3,
    /// The light that the path adds here, multiplied by the throughput.
    pub light: Vec3,
}

/// A kind of surface that a path hits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum PathHit {
    /// Nothing, so the path leaves the scene.
    Nothing,
    /// A matte surface.
    Matte,
    /// A mirror.
    Mirror,
    /// Glass.
    Glass,
    /// A light.
    Light,
}

/// One node that a traversal reaches. Steps are listed in order.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TraversalStep {
    /// Index of the node in the tree's list of nodes.
    pub node: u32,
    /// Whether the node is entered, i.e. whether its children are visited or its primitives are
    /// tested.
    pub is_entered: bool,
    /// Interval during which the ray is inside the node's box, ignoring the ray's range.
    pub span: Option<Interval>,
}

/// The upper levels of a tree, and the split of its root.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct UpperLevels {
    /// The nodes down to level [`UpperLevels::LEVELS`] - 1, in any order.
    pub nodes: Vec<LevelNode>,
    /// The plane that splits the root's primitives, described by its axis and a coordinate between
    /// the centres of the primitives on either side. `None` if the root is a leaf, or if no plane
    /// separates the centres.
    pub plane: Option<(u8, f32)>,
}

impl UpperLevels {
    /// Number of stored levels, including the root's.
    pub const LEVELS: u32 = 6;
}

/// A node and its level in the tree.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LevelNode {
    /// Distance from the root, which is at level 0.
    pub level: u32,
    /// Number of primitives in the nodes to the left of this node.
    pub start: u32,
    /// Number of primitives below the node.
    pub count: u32,
    /// Whether the node is a leaf.
    pub is_leaf: bool,
    /// The node's contribution to the tree's SAH cost: its area divided by the root's area, times
    /// `count` if it is a leaf.
    pub cost: f32,
}

/// The error message for data that belongs to a different kind of question.
const OTHER_KIND: &str = "the drawing data is for a different kind of question";

impl DrawingData {
    /// Returns whether this is [`DrawingData::None`].
    pub fn is_none(&self) -> bool {
        match self {
            DrawingData::None => true,
            DrawingData::Slabs(_)
            | DrawingData::Traversals(_)
            | DrawingData::Sweep(_)
            | DrawingData::Paths(_) => false,
        }
    }

    /// Returns the reason the data doesn't fit `question`, or `None` if it fits.
    pub fn problem(&self, question: &Question) -> Option<String> {
        let count = question.count();
        match (self, question) {
            (DrawingData::None, _) => None,
            (DrawingData::Slabs(slabs), Question::BBoxHit(_)) => {
                (slabs.len() != count).then(|| {
                    format!(
                        "the drawing data has slabs for {} of {count} queries",
                        slabs.len()
                    )
                })
            }
            (DrawingData::Traversals(traversals), Question::Hit(table)) => {
                let (Geometry::Tree { nodes, .. }, Rows::List(_)) = (&table.subject, &table.rows)
                else {
                    return Some(OTHER_KIND.to_owned());
                };
                let mut steps = traversals.iter().flatten();
                match steps.find(|step| step.node as usize >= nodes.len()) {
                    Some(step) => Some(format!(
                        "the drawing data visits node {} of a tree with {} nodes",
                        step.node,
                        nodes.len()
                    )),
                    None => (traversals.len() != count).then(|| {
                        format!(
                            "the drawing data has traversals for {} of {count} rays",
                            traversals.len()
                        )
                    }),
                }
            }
            (DrawingData::Sweep(sweep), Question::Build { shapes, .. }) => {
                sweep.problem(shapes.len())
            }
            (DrawingData::Paths(paths), Question::Light(LightQuestion::Radiance(_))) => {
                (paths.len() != count).then(|| {
                    format!(
                        "the drawing data has {} paths for {count} rays",
                        paths.len()
                    )
                })
            }
            (
                DrawingData::Slabs(_)
                | DrawingData::Traversals(_)
                | DrawingData::Sweep(_)
                | DrawingData::Paths(_),
                _,
            ) => Some(OTHER_KIND.to_owned()),
        }
    }
}

impl UpperLevels {
    fn problem(&self, primitives: usize) -> Option<String> {
        let is_wrong = |node: &&LevelNode| {
            let end = u64::from(node.start) + u64::from(node.count);
            node.level >= UpperLevels::LEVELS || end > primitives as u64 || !node.cost.is_finite()
        };
        let axis = self.plane.map_or(0, |(axis, _)| usize::from(axis));
        match self.nodes.iter().find(is_wrong) {
            Some(node) => Some(format!("the drawing data has an invalid node {node:?}")),
            None => (axis >= Vec3::AXES.len()).then(|| {
                format!("the drawing data splits along axis {axis}, which does not exist")
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use protocol::light::transport::{PathStart, Room};
    use protocol::{Ray, Table};

    use super::*;
    use crate::tests::{boxes, sphere};

    fn bbox() -> Question {
        boxes(Vec3::NEG_ONE, Vec3::ONE, &[Ray::new(Vec3::ZERO, Vec3::X)])
    }

    fn traverse() -> Question {
        let tree = Geometry::Tree {
            shapes: Vec::new(),
            nodes: Vec::new(),
            root: 0,
        };
        Question::hits(tree, vec![Ray::new(Vec3::ZERO, Vec3::X)])
    }

    fn build() -> Question {
        Question::Build {
            shapes: vec![sphere(Vec3::ZERO, 1.0)],
            max_leaf_size: 1,
        }
    }

    fn radiance() -> Question {
        let room = Room {
            scene: String::new(),
            map: None,
        };
        let start = PathStart {
            ray: Ray::new(Vec3::ZERO, Vec3::X),
            seed: 0,
            bounces: 1,
        };
        LightQuestion::Radiance(Table::of_list(room, vec![start])).into()
    }

    fn sweep(node: LevelNode, axis: u8) -> DrawingData {
        DrawingData::Sweep(UpperLevels {
            nodes: vec![node],
            plane: Some((axis, 0.0)),
        })
    }

    const LEAF: LevelNode = LevelNode {
        level: 0,
        start: 0,
        count: 1,
        is_leaf: true,
        cost: 1.0,
    };

    #[test]
    fn accepts_data_that_fits_its_question() {
        let slabs = DrawingData::Slabs(vec![[Interval::AHEAD; 3]]);
        assert_eq!(slabs.problem(&bbox()), None);
        assert_eq!(
            DrawingData::Traversals(vec![vec![]]).problem(&traverse()),
            None
        );
        assert_eq!(sweep(LEAF, 2).problem(&build()), None);
        assert_eq!(DrawingData::None.problem(&build()), None);
        assert_eq!(DrawingData::Paths(vec![vec![]]).problem(&radiance()), None);
    }

    #[test]
    fn reports_data_that_does_not_fit() {
        let step = TraversalStep {
            node: 7,
            is_entered: true,
            span: None,
        };
        let high = LevelNode { level: 6, ..LEAF };
        let many = LevelNode {
            start: u32::MAX,
            count: u32::MAX,
            ..LEAF
        };
        let not_finite = LevelNode {
            cost: f32::NAN,
            ..LEAF
        };
        let cases = [
            (DrawingData::Slabs(vec![]), bbox(), "0 of 1 queries"),
            (DrawingData::Traversals(vec![]), traverse(), "0 of 1 rays"),
            (
                DrawingData::Traversals(vec![vec![step]]),
                traverse(),
                "node 7 of a tree with 0 nodes",
            ),
            (
                DrawingData::Traversals(vec![]),
                bbox(),
                "a different kind of question",
            ),
            (sweep(high, 0), build(), "level: 6"),
            (sweep(many, 0), build(), "invalid node"),
            (sweep(not_finite, 0), build(), "NaN"),
            (sweep(LEAF, 3), build(), "axis 3"),
            (DrawingData::Paths(vec![]), radiance(), "0 paths for 1 rays"),
            (
                DrawingData::Paths(vec![vec![]]),
                build(),
                "a different kind of question",
            ),
        ];
        for (shown, question, text) in cases {
            let problem = shown.problem(&question).unwrap_or_default();
            assert!(problem.contains(text), "{problem:?} and {text:?}");
        }
    }
}
