//! Trees, judged by what must hold of every one of them and by their cost: there is no one right
//! tree.

use glam::DVec3;
use protocol::{Outcome, Shape, Tree, TreeNode};

use crate::describe;
use crate::exam::TreePart;
use crate::judge::{Failure, How, Judgement, Share};

/// Full marks up to so many times the cost of the exact sweep, and half marks.
const FULL: f64 = 1.12;
const HALF: f64 = 1.25;
/// How far a box may exceed what it holds, in diagonals.
const LOOSE: f64 = 1e-4;
/// How far a primitive may stick out of its box, in diagonals: what rounding explains.
const ROUNDING: f64 = 1e-5;

pub(super) fn judge(
    judged: &[TreePart],
    sweep_cost: Option<f64>,
    shapes: &[Shape],
    max_leaf_size: u32,
    answer: &Outcome<Tree>,
) -> Judgement {
    let tree = match answer {
        Outcome::Value(tree) => tree,
        Outcome::Panicked(panic) => {
            return Judgement::wrong(Failure {
                element: 0,
                how: How::Panicked(panic.clone()),
                count: None,
            });
        }
        Outcome::GivenUp => return Judgement::protocol("given up"),
    };
    let cells = match cells(shapes, tree) {
        Ok(cells) => cells,
        Err(mistake) => return wrong(mistake),
    };
    let mistake = judged
        .iter()
        .find_map(|part| part_mistake(*part, &cells, shapes, max_leaf_size));
    match (mistake, sweep_cost) {
        (Some(mistake), _) => wrong(mistake),
        (None, None) => Judgement::RIGHT,
        // A cost is only that of this tree if the tree holds every primitive once.
        (None, Some(sweep)) => match partition_mistake(&cells, shapes.len()) {
            Some(mistake) => wrong(mistake),
            None => by_cost(cost(&cells) / sweep),
        },
    }
}

/// What is wrong with a tree, in the words of a report.
struct Mistake {
    what: &'static str,
    got: String,
    wanted: String,
}

fn wrong(mistake: Mistake) -> Judgement {
    Judgement::wrong(Failure {
        element: 0,
        how: How::Wrong {
            what: mistake.what.to_owned(),
            got: mistake.got,
            wanted: mistake.wanted,
        },
        count: None,
    })
}

fn by_cost(ratio: f64) -> Judgement {
    if ratio <= FULL {
        return Judgement::RIGHT;
    }
    let judgement = wrong(Mistake {
        what: "SAH cost",
        got: format!("{ratio:.2} times that of the best split at every node"),
        wanted: format!("at most {FULL:.2} times ({HALF:.2} for half the points)"),
    });
    Judgement {
        share: if ratio <= HALF {
            Share::HALF
        } else {
            Share::NONE
        },
        ..judgement
    }
}

/// A node that is reached from the root.
struct Cell<'a> {
    place: u32,
    node: &'a TreeNode,
    /// The places of the primitives below, as the submission ordered them; only of a leaf.
    leaf: Option<Vec<usize>>,
    /// How many primitives are below.
    count: usize,
    /// The tightest box around them.
    needs: Bounds,
}

/// All nodes that are reached from the root, parents before children.
fn cells<'a>(shapes: &[Shape], tree: &'a Tree) -> Result<Vec<Cell<'a>>, Mistake> {
    if tree.nodes.is_empty() {
        if shapes.is_empty() {
            return Ok(Vec::new());
        }
        return Err(Mistake {
            what: "nodes",
            got: "no node at all".to_owned(),
            wanted: format!("a tree over {} primitives", shapes.len()),
        });
    }
    // A primitive is known by its material. One that nobody gave us is in no place.
    let places: std::collections::BTreeMap<u32, usize> =
        shapes.iter().map(Shape::material).zip(0..).collect();
    let order: Vec<Option<usize>> = tree
        .order
        .iter()
        .map(|material| places.get(material).copied())
        .collect();

    let mut reached = vec![false; tree.nodes.len()];
    let mut cells = Vec::new();
    let mut children = Vec::new();
    let mut open = vec![(tree.root, "root")];
    while let Some((place, whose)) = open.pop() {
        let node = tree.nodes.get(place as usize).ok_or_else(|| Mistake {
            what: whose,
            got: format!("node {place} of {}", tree.nodes.len()),
            wanted: "the place of a node".to_owned(),
        })?;
        if std::mem::replace(&mut reached[place as usize], true) {
            return Err(Mistake {
                what: "nodes",
                got: format!("node {place} is reached twice"),
                wanted: "a tree: one way to each node".to_owned(),
            });
        }
        let leaf = node
            .is_leaf()
            .then(|| leaf(node, place, &order))
            .transpose()?;
        if leaf.is_none() {
            children.push((cells.len(), [node.l, node.r]));
            open.extend([(node.l, "child l"), (node.r, "child r")]);
        }
        let mut needs = Bounds::EMPTY;
        for &primitive in leaf.iter().flatten() {
            needs.enclose(Bounds::around(&shapes[primitive]));
        }
        cells.push(Cell {
            place,
            node,
            count: leaf.as_ref().map_or(0, Vec::len),
            leaf,
            needs,
        });
    }

    // Children come after their parents: from the last to the first, each is complete.
    let mut by_place = vec![usize::MAX; tree.nodes.len()];
    for (index, cell) in cells.iter().enumerate() {
        by_place[cell.place as usize] = index;
    }
    for (parent, pair) in children.into_iter().rev() {
        for child in pair.map(|place| by_place[place as usize]) {
            let (count, needs) = (cells[child].count, cells[child].needs);
            cells[parent].count += count;
            cells[parent].needs.enclose(needs);
        }
    }
    Ok(cells)
}

fn leaf(node: &TreeNode, place: u32, order: &[Option<usize>]) -> Result<Vec<usize>, Mistake> {
    let start = node.start as usize;
    let listed = order.get(start..start.saturating_add(node.size as usize));
    let listed = listed.and_then(|listed| listed.iter().copied().collect::<Option<Vec<_>>>());
    listed.ok_or_else(|| Mistake {
        what: "leaves",
        got: format!(
            "leaf {place} holds primitives {start} to {} of {}",
            start as u64 + u64::from(node.size),
            order.len()
        ),
        wanted: "a range of the tree's own primitives".to_owned(),
    })
}

fn part_mistake(
    part: TreePart,
    cells: &[Cell],
    shapes: &[Shape],
    max_leaf_size: u32,
) -> Option<Mistake> {
    let most = max_leaf_size as usize;
    match part {
        TreePart::Partition => partition_mistake(cells, shapes.len()),
        TreePart::Contains => cells.iter().find_map(|cell| {
            let slack = ROUNDING * cell.needs.diagonal();
            let holds = cell.needs.is_within(Bounds::of(cell.node), slack);
            (cell.count > 0 && !holds).then(|| cell.box_mistake("box too small"))
        }),
        TreePart::Tight => cells.iter().find_map(|cell| {
            let slack = LOOSE * cell.needs.diagonal();
            let tight = Bounds::of(cell.node).is_within(cell.needs, slack);
            (cell.count > 0 && !tight).then(|| cell.box_mistake("box too large"))
        }),
        TreePart::LeafSize => {
            let leaf = cells
                .iter()
                .find(|cell| cell.leaf.is_some() && cell.count > most)?;
            Some(Mistake {
                what: "leaf size",
                got: format!("leaf {} holds {} primitives", leaf.place, leaf.count),
                wanted: format!("at most {most}"),
            })
        }
        TreePart::Stops => {
            let node = cells
                .iter()
                .find(|cell| cell.leaf.is_none() && cell.count <= most)?;
            Some(Mistake {
                what: "splits",
                got: format!(
                    "node {} was split over {} primitives",
                    node.place, node.count
                ),
                wanted: format!("a leaf, as soon as there are at most {most}"),
            })
        }
    }
}

fn partition_mistake(cells: &[Cell], primitives: usize) -> Option<Mistake> {
    let mut leaves_of = vec![0; primitives];
    for &primitive in cells.iter().filter_map(|cell| cell.leaf.as_ref()).flatten() {
        leaves_of[primitive] += 1;
    }
    let (primitive, leaves) = leaves_of
        .iter()
        .enumerate()
        .find(|(_, leaves)| **leaves != 1)?;
    Some(Mistake {
        what: "leaves",
        got: format!("primitive {primitive} of {primitives} is in {leaves} leaves"),
        wanted: "each primitive in exactly one".to_owned(),
    })
}

/// Σ S/S_root over interior nodes + Σ n · S/S_root over leaves (C_trav = C_isect = 1), with the
/// boxes that the primitives need: MacDonald and Booth, "Heuristics for ray tracing using space
/// subdivision", The Visual Computer 6, 1990, section 3.
fn cost(cells: &[Cell]) -> f64 {
    let Some(root) = cells.first() else {
        return 0.0;
    };
    let cost = |cell: &Cell| match &cell.leaf {
        None => cell.needs.area(),
        Some(leaf) => cell.needs.area() * leaf.len() as f64,
    };
    cells.iter().map(cost).sum::<f64>() / root.needs.area()
}

impl Cell<'_> {
    fn box_mistake(&self, what: &'static str) -> Mistake {
        let corners = |min, max| format!("{} to {}", describe::point(min), describe::point(max));
        Mistake {
            what,
            got: format!(
                "node {}: {}",
                self.place,
                corners(self.node.min, self.node.max)
            ),
            wanted: corners(self.needs.min.as_vec3(), self.needs.max.as_vec3()),
        }
    }
}

/// A box in f64, so that the judge's own rounding does not matter.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    min: DVec3,
    max: DVec3,
}

impl Bounds {
    const EMPTY: Bounds = Bounds {
        min: DVec3::INFINITY,
        max: DVec3::NEG_INFINITY,
    };

    fn of(node: &TreeNode) -> Self {
        Bounds {
            min: node.min.as_dvec3(),
            max: node.max.as_dvec3(),
        }
    }

    fn around(shape: &Shape) -> Self {
        let corners = |corners: [glam::Vec3; 3]| {
            let [a, b, c] = corners.map(|corner| corner.as_dvec3());
            Bounds {
                min: a.min(b).min(c),
                max: a.max(b).max(c),
            }
        };
        match *shape {
            Shape::Triangle { vertices, .. } => corners(vertices.map(|vertex| vertex.position)),
            Shape::Facet {
                corners: points, ..
            } => corners(points),
            Shape::Sphere { center, radius, .. } => Bounds {
                min: center.as_dvec3() - f64::from(radius),
                max: center.as_dvec3() + f64::from(radius),
            },
        }
    }

    fn enclose(&mut self, other: Bounds) {
        self.min = self.min.min(other.min);
        self.max = self.max.max(other.max);
    }

    fn diagonal(self) -> f64 {
        (self.max - self.min).length()
    }

    fn area(self) -> f64 {
        let size = self.max - self.min;
        2.0 * (size.x * size.y + size.y * size.z + size.z * size.x)
    }

    /// Whether this box lies in `outer`, give or take `slack` and the last bits of an f32. Never
    /// of a box with a NaN.
    fn is_within(self, outer: Bounds, slack: f64) -> bool {
        let last_bits = self.min.abs().max(self.max.abs()) * 2.0 * f64::from(f32::EPSILON);
        let slack = DVec3::splat(slack) + last_bits;
        self.min.cmpge(outer.min - slack).all() && self.max.cmple(outer.max + slack).all()
    }
}

#[cfg(test)]
mod tests {
    use glam::{Vec3, vec3};

    use super::*;

    /// Unit spheres in a row, two apart.
    fn row(count: u32) -> Vec<Shape> {
        let ball = |i| Shape::Sphere {
            center: vec3(2.0 * i as f32, 0.0, 0.0),
            radius: 0.5,
            material: i,
        };
        (0..count).map(ball).collect()
    }

    fn node(first: u32, last: u32, size: u32, l: u32, r: u32) -> TreeNode {
        TreeNode {
            min: vec3(2.0 * first as f32 - 0.5, -0.5, -0.5),
            max: vec3(2.0 * last as f32 + 0.5, 0.5, 0.5),
            start: first,
            size,
            l,
            r,
        }
    }

    /// Four spheres, two in each leaf, the root in the middle.
    fn good() -> Tree {
        Tree {
            nodes: vec![
                node(0, 1, 2, 0, 0),
                node(0, 3, 0, 0, 2),
                node(2, 3, 2, 0, 0),
            ],
            root: 1,
            order: vec![0, 1, 2, 3],
        }
    }

    const ALL: [TreePart; 5] = [
        TreePart::Partition,
        TreePart::Contains,
        TreePart::Tight,
        TreePart::LeafSize,
        TreePart::Stops,
    ];

    fn what(tree: Tree) -> String {
        match judge(&ALL, None, &row(4), 2, &Outcome::Value(tree)).failure {
            None => "right".to_owned(),
            Some(failure) => match failure.how {
                How::Wrong { what, .. } => what,
                How::Panicked(_) | How::Protocol(_) => unreachable!("it is a tree"),
            },
        }
    }

    fn spoiled(spoil: impl FnOnce(&mut Tree)) -> String {
        let mut tree = good();
        spoil(&mut tree);
        what(tree)
    }

    #[test]
    fn each_part_of_a_tree_is_judged() {
        assert_eq!(what(good()), "right");
        assert_eq!(spoiled(|tree| tree.order = vec![0, 1, 2, 2]), "leaves");
        assert_eq!(spoiled(|tree| tree.order = vec![0, 1, 2, 9]), "leaves");
        assert_eq!(spoiled(|tree| tree.nodes[2].size = 3), "leaves");
        assert_eq!(spoiled(|tree| tree.nodes[2].size = 1), "leaves");
        assert_eq!(spoiled(|tree| tree.nodes[1].max.x = 3.0), "box too small");
        assert_eq!(spoiled(|tree| tree.nodes[0].min.y = -0.6), "box too large");
        assert_eq!(
            spoiled(|tree| tree.nodes[0].min.y = f32::NAN),
            "box too small"
        );
        assert_eq!(spoiled(|tree| tree.nodes[1].r = 7), "child r");
        assert_eq!(spoiled(|tree| tree.nodes[1].r = 1), "nodes");
        assert_eq!(spoiled(|tree| tree.root = 3), "root");
        assert_eq!(spoiled(|tree| tree.nodes.clear()), "nodes");
        let one_leaf = Tree {
            nodes: vec![node(0, 3, 4, 0, 0)],
            root: 0,
            ..good()
        };
        assert_eq!(what(one_leaf), "leaf size");
    }

    #[test]
    fn a_node_that_should_be_a_leaf_is_told() {
        let split = Outcome::Value(good());
        let judgement = judge(&[TreePart::Stops], None, &row(4), 4, &split);
        assert_eq!(judgement.share, Share::NONE);
    }

    #[test]
    fn cost_is_counted_as_by_hand() {
        // Boxes of 1×1×7 (area 30) and twice 1×1×3 (area 14): 1 + 2 · 2 · 14/30.
        let tree = good();
        let cells = cells(&row(4), &tree).ok().expect("it is a tree");
        let by_hand = 1.0 + 4.0 * 14.0 / 30.0;
        assert!((cost(&cells) - by_hand).abs() < 1e-12);

        let share = |ratio: f64| {
            let sweep = Some(by_hand / ratio);
            judge(&ALL, sweep, &row(4), 2, &Outcome::Value(good())).share
        };
        assert_eq!(share(1.11), Share::ALL);
        assert_eq!(share(1.13), Share::HALF);
        assert_eq!(share(1.26), Share::NONE);
    }

    #[test]
    fn nothing_may_be_no_node_or_one_leaf_of_none() {
        let empty = |nodes| {
            let tree = Tree {
                nodes,
                root: 0,
                order: Vec::new(),
            };
            judge(&ALL, None, &[], 1, &Outcome::Value(tree)).share
        };
        assert_eq!(empty(Vec::new()), Share::ALL);
        let leaf = TreeNode {
            min: Vec3::INFINITY,
            max: Vec3::NEG_INFINITY,
            start: 0,
            size: 0,
            l: 0,
            r: 0,
        };
        assert_eq!(empty(vec![leaf]), Share::ALL);
        assert_eq!(empty(vec![TreeNode { size: 1, ..leaf }]), Share::NONE);
    }
}
