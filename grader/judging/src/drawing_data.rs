//! What an exam tells of the right way beside the right answer, so that a report can draw it.
//! Nothing is judged by it, and no probe is told: this program knows no way itself.

use glam::Vec3;
use protocol::{Interval, Question, Rays, packed};
use serde::{Deserialize, Serialize};

/// The right way to the answers of one question.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum DrawingData {
    /// Nothing is told.
    #[default]
    #[serde(alias = "nothing")]
    None,
    /// To `BBox`: for each shot, when the ray is between the two planes of each axis, its times and
    /// its range left aside. Always or never, if it is parallel to them.
    Slabs(#[serde(with = "packed::text")] Vec<[Interval; 3]>),
    /// To `Traverse` with a list of rays: for each ray, one right walk.
    #[serde(alias = "walks")]
    Traversals(#[serde(with = "packed::text")] Vec<Vec<TraversalStep>>),
    /// To `Build`: the tree of the exact sweep.
    Sweep(#[serde(with = "packed::text")] Sweep),
}

/// A node that a walk comes to, in the order of coming there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TraversalStep {
    /// Its place among the nodes.
    pub node: u32,
    /// Whether it is entered: its children are looked at, or its primitives tested.
    pub is_entered: bool,
    /// When the ray, however far it counts, is in the node's box.
    pub span: Option<Interval>,
}

/// The upper levels of a tree, and its first partition.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sweep {
    /// Its nodes down to level [`Sweep::LEVELS`] - 1, in any order.
    pub nodes: Vec<LevelNode>,
    /// What parts the primitives of the root: the axis, and a place between the centers of both
    /// sides. None if there is but a leaf, or the primitives are parted by their number alone.
    pub plane: Option<(u8, f32)>,
}

impl Sweep {
    /// So many levels are told of, the root's among them.
    pub const LEVELS: u32 = 6;
}

/// A node, seen from its level.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct LevelNode {
    /// How far it is from the root, which is on level 0.
    pub level: u32,
    /// How many primitives are in nodes to the left of it.
    pub start: u32,
    /// How many primitives are below it.
    pub count: u32,
    /// Whether it is a leaf.
    pub is_leaf: bool,
    /// What it adds to the tree's SAH cost: its area divided by the root's; in a leaf, that times
    /// `count`.
    pub cost: f32,
}

impl DrawingData {
    /// Whether nothing is told.
    pub fn is_none(&self) -> bool {
        match self {
            DrawingData::None => true,
            DrawingData::Slabs(_) | DrawingData::Traversals(_) | DrawingData::Sweep(_) => false,
        }
    }

    /// What is wrong with it beside this question, if anything is.
    pub fn problem(&self, question: &Question) -> Option<String> {
        let count = question.count();
        match (self, question) {
            (DrawingData::None, _) => None,
            (DrawingData::Slabs(slabs), Question::BBox { .. }) => (slabs.len() != count)
                .then(|| format!("slabs are shown for {} of {count} shots", slabs.len())),
            (
                DrawingData::Traversals(walks),
                Question::Traverse {
                    nodes,
                    rays: Rays::List(_),
                    ..
                },
            ) => {
                let mut steps = walks.iter().flatten();
                match steps.find(|step| step.node as usize >= nodes.len()) {
                    Some(step) => Some(format!(
                        "a walk is shown through node {} of {}",
                        step.node,
                        nodes.len()
                    )),
                    None => (walks.len() != count)
                        .then(|| format!("walks are shown for {} of {count} rays", walks.len())),
                }
            }
            (DrawingData::Sweep(sweep), Question::Build { shapes, .. }) => {
                sweep.problem(shapes.len())
            }
            (DrawingData::Slabs(_) | DrawingData::Traversals(_) | DrawingData::Sweep(_), _) => {
                Some("what is shown beside it belongs to another question".to_owned())
            }
        }
    }
}

impl Sweep {
    fn problem(&self, primitives: usize) -> Option<String> {
        let is_wrong = |node: &&LevelNode| {
            let end = u64::from(node.start) + u64::from(node.count);
            node.level >= Sweep::LEVELS || end > primitives as u64 || !node.cost.is_finite()
        };
        let axis = self.plane.map_or(0, |(axis, _)| usize::from(axis));
        match self.nodes.iter().find(is_wrong) {
            Some(node) => Some(format!("the sweep's tree shown has no place for {node:?}")),
            None => (axis >= Vec3::AXES.len())
                .then(|| format!("the sweep shown parts along axis {axis} of 3")),
        }
    }
}

#[cfg(test)]
mod tests {
    use protocol::{Ray, Shape};

    use super::*;

    fn bbox() -> Question {
        let shot = (Ray::new(Vec3::ZERO, Vec3::X), Interval::AHEAD);
        Question::BBox {
            min: Vec3::NEG_ONE,
            max: Vec3::ONE,
            queries: vec![shot],
        }
    }

    fn traverse() -> Question {
        Question::Traverse {
            shapes: Vec::new(),
            nodes: Vec::new(),
            root: 0,
            rays: Rays::List(vec![Ray::new(Vec3::ZERO, Vec3::X)]),
        }
    }

    fn build() -> Question {
        let shape = Shape::Sphere {
            center: Vec3::ZERO,
            radius: 1.0,
            material: 0,
        };
        Question::Build {
            shapes: vec![shape],
            max_leaf_size: 1,
        }
    }

    fn sweep(node: LevelNode, axis: u8) -> DrawingData {
        DrawingData::Sweep(Sweep {
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
        let endless = LevelNode {
            cost: f32::NAN,
            ..LEAF
        };
        let cases = [
            (DrawingData::Slabs(vec![]), bbox(), "0 of 1 shots"),
            (DrawingData::Traversals(vec![]), traverse(), "0 of 1 rays"),
            (
                DrawingData::Traversals(vec![vec![step]]),
                traverse(),
                "node 7 of 0",
            ),
            (DrawingData::Traversals(vec![]), bbox(), "another question"),
            (sweep(high, 0), build(), "level: 6"),
            (sweep(many, 0), build(), "no place"),
            (sweep(endless, 0), build(), "NaN"),
            (sweep(LEAF, 3), build(), "axis 3"),
        ];
        for (shown, question, words) in cases {
            let problem = shown.problem(&question).unwrap_or_default();
            assert!(problem.contains(words), "{problem:?} and {words:?}");
        }
    }
}
