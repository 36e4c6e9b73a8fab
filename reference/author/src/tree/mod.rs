//! Trees for traversal: the exam's own, so that it does not depend on a submission's `build`.

pub mod construction;
pub mod decoy;
pub mod traversal;

use protocol::{Question, Ray, Rays, Shape, TreeNode};

use crate::oracle::bbox::Bounds;
use crate::oracle::{Intersection, Ray64, scan};
use crate::seed::Rng;

/// A tree as it is asked about.
#[derive(Clone, Debug)]
pub struct Tree {
    /// The primitives, in the order that the leaves count. Some may be in no leaf.
    pub shapes: Vec<Shape>,
    /// The nodes. Some may be below no other and not the root: nobody gets there.
    pub nodes: Vec<TreeNode>,
    /// The place of the root.
    pub root: usize,
}

/// Where the root stands among the nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RootPosition {
    /// At 0.
    First,
    /// At neither end.
    Middle,
    /// At the end.
    Last,
}

impl Tree {
    /// The box of a node.
    pub fn bounds(&self, place: usize) -> Bounds {
        let node = &self.nodes[place];
        Bounds {
            min: node.min.as_dvec3(),
            max: node.max.as_dvec3(),
        }
    }

    /// The places of all nodes below a node, and its own, parents before children.
    pub fn subtree(&self, place: usize) -> Vec<usize> {
        let mut found = vec![place];
        let mut next = 0;
        while next < found.len() {
            let node = &self.nodes[found[next]];
            if !node.is_leaf() {
                found.extend([node.l as usize, node.r as usize]);
            }
            next += 1;
        }
        found
    }

    /// The places of all leaves that can be reached.
    pub fn leaves(&self) -> Vec<usize> {
        let mut nodes = if self.nodes.is_empty() {
            Vec::new()
        } else {
            self.subtree(self.root)
        };
        nodes.retain(|&place| self.nodes[place].is_leaf());
        nodes
    }

    /// The places of the primitives in a leaf.
    pub fn primitives(&self, leaf: usize) -> std::ops::Range<usize> {
        let node = &self.nodes[leaf];
        node.start as usize..(node.start + node.size) as usize
    }

    /// The way from the root down to a node, both included.
    pub fn path(&self, to: usize) -> Vec<usize> {
        let mut path = vec![to];
        let nodes = self.subtree(self.root);
        while path[path.len() - 1] != self.root {
            let child = path[path.len() - 1];
            let is_parent = |place: &&usize| {
                let node = &self.nodes[**place];
                !node.is_leaf() && (node.l as usize == child || node.r as usize == child)
            };
            path.push(*nodes.iter().find(is_parent).expect("it hangs in the tree"));
        }
        path.reverse();
        path
    }

    /// The other child of a node's parent; the root has none.
    pub fn sibling(&self, place: usize) -> Option<usize> {
        let path = self.path(place);
        let parent = &self.nodes[*path.iter().rev().nth(1)?];
        let (l, r) = (parent.l as usize, parent.r as usize);
        Some(if l == place { r } else { l })
    }

    /// Whether each primitive lies in the box of a leaf that can be reached and holds it. What does
    /// not is a trap, or in no leaf at all.
    pub fn ordinary_primitives(&self) -> Vec<bool> {
        let leaves = self.leaves();
        let places = 0..self.shapes.len();
        places
            .map(|place| self.is_ordinary(place, &leaves))
            .collect()
    }

    /// Whether this primitive lies in the box of one of these leaves, which holds it.
    fn is_ordinary(&self, place: usize, leaves: &[usize]) -> bool {
        // Boxes are rounded to single precision, outward or not: a breath of room.
        let room = |leaf: usize| self.bounds(leaf).grown(1e-5);
        let bounds = scan::bounds(&self.shapes[place]);
        let mut holding = leaves
            .iter()
            .filter(|leaf| self.primitives(**leaf).contains(&place));
        holding.any(|&leaf| room(leaf).contains(&bounds))
    }

    /// What is true: the closest hit with an honest primitive.
    pub fn expected_hit(&self, beam: &Ray64) -> Option<Intersection> {
        let met = (0..).zip(&self.shapes);
        let mut met: Vec<(usize, Intersection)> = met
            .filter_map(|(place, shape)| Some((place, scan::intersect(beam, shape)?)))
            .collect();
        met.sort_by(|(_, a), (_, b)| a.distance.total_cmp(&b.distance));
        let leaves = self.leaves();
        let mut honest = met.into_iter();
        let (_, closest) = honest.find(|(place, _)| self.is_ordinary(*place, &leaves))?;
        Some(closest)
    }

    /// The leaf that holds what the ray hits, if it hits anything.
    pub fn leaf_of_hit(&self, beam: &Ray64) -> Option<usize> {
        let hit = self.expected_hit(beam)?;
        let is_hit = |place: usize| self.shapes[place].material() == hit.material;
        let mut leaves = self.leaves().into_iter();
        leaves.find(|&leaf| self.primitives(leaf).any(is_hit))
    }

    /// Adds a primitive to a leaf whose box does not change.
    pub fn add_to_leaf(&mut self, leaf: usize, shape: Shape) {
        let at = self.primitives(leaf).end;
        self.shapes.insert(at, shape);
        for (place, node) in self.nodes.iter_mut().enumerate() {
            if node.is_leaf() && node.start as usize >= at && place != leaf {
                node.start += 1;
            }
        }
        self.nodes[leaf].size += 1;
    }

    /// The same tree with its nodes in another order.
    pub fn with_nodes_shuffled(&self, draw: &mut Rng, root: RootPosition) -> Tree {
        let others = (0..self.nodes.len()).filter(|&place| place != self.root);
        let mut order = draw.shuffled(others.collect());
        let place = match root {
            RootPosition::First => 0,
            RootPosition::Middle => order.len() / 2,
            RootPosition::Last => order.len(),
        };
        order.insert(place, self.root);

        let mut moved = vec![0; order.len()];
        for (new, &old) in order.iter().enumerate() {
            moved[old] = new;
        }
        let node = |&old: &usize| {
            let node = self.nodes[old];
            if node.is_leaf() {
                return node;
            }
            TreeNode {
                l: moved[node.l as usize] as u32,
                r: moved[node.r as usize] as u32,
                ..node
            }
        };
        Tree {
            shapes: self.shapes.clone(),
            nodes: order.iter().map(node).collect(),
            root: place,
        }
    }

    /// The same tree with its root at the front, followed by a copy of the whole tree whose root is
    /// at the end: whoever begins at either end, and not at `root`, begins rightly.
    ///
    /// The copy has nodes of its own. Were it only the root's, its children would have two parents,
    /// and whoever notes parents or depths in one pass over all nodes would be led astray.
    pub fn with_roots_at_both_ends(&self, draw: &mut Rng) -> Tree {
        let mut tree = self.with_nodes_shuffled(draw, RootPosition::First);
        let count = tree.nodes.len() as u32;
        let copied = |node: &TreeNode| match node.is_leaf() {
            true => *node,
            // Node 1 is copied to the place after the last, and so on.
            false => TreeNode {
                l: node.l + count - 1,
                r: node.r + count - 1,
                ..*node
            },
        };
        let mut copy: Vec<TreeNode> = tree.nodes.iter().map(copied).collect();
        copy.rotate_left(1);
        tree.nodes.extend(copy);
        tree
    }

    /// Makes two nodes change places.
    pub fn swap_nodes(&mut self, a: usize, b: usize) {
        let moved = |place: usize| match place {
            place if place == a => b,
            place if place == b => a,
            place => place,
        };
        self.nodes.swap(a, b);
        for node in self.nodes.iter_mut().filter(|node| !node.is_leaf()) {
            node.l = moved(node.l as usize) as u32;
            node.r = moved(node.r as usize) as u32;
        }
        self.root = moved(self.root);
    }

    /// The question of what these rays meet in this tree.
    pub fn question(&self, rays: Vec<Ray>) -> Question {
        Question::Traverse {
            shapes: self.shapes.clone(),
            nodes: self.nodes.clone(),
            root: self.root as u32,
            rays: Rays::List(rays),
        }
    }
}
