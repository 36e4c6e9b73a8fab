//! The exam's own trees, so that traversal can be tested without a submission's `build`.

pub mod construction;
pub mod decoy;
pub mod traversal;

use protocol::{Geometry, Question, Ray, Rows, Shape, TreeNode};

use crate::oracle::bbox::Bounds;
use crate::oracle::{Intersection, Ray64, scan};
use crate::seed::Rng;

/// A tree from an exam question.
#[derive(Clone, Debug, Default)]
pub struct Tree {
    /// The primitives. Each leaf refers to a range of this list. Some primitives may not be in any
    /// leaf.
    pub shapes: Vec<Shape>,
    /// The nodes. Some may be unreachable from the root.
    pub nodes: Vec<TreeNode>,
    /// The index of the root in `nodes`.
    pub root: usize,
}

/// The position of the root among the nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RootPosition {
    /// At index 0.
    First,
    /// At neither end.
    Middle,
    /// At the last index.
    Last,
}

impl Tree {
    /// Returns the tree and the rays of a question about traversal.
    pub fn in_question(question: &Question) -> Option<(Tree, &Rows<Ray>)> {
        let Question::Hit(table) = question else {
            return None;
        };
        Some((Tree::of(&table.subject)?, &table.rows))
    }

    /// Returns the tree in a question's subject.
    pub fn of(geometry: &Geometry) -> Option<Tree> {
        let Geometry::Tree {
            shapes,
            nodes,
            root,
        } = geometry
        else {
            return None;
        };
        Some(Tree {
            shapes: shapes.clone(),
            nodes: nodes.clone(),
            root: *root as usize,
        })
    }

    /// Returns the box of a node.
    pub fn bounds(&self, index: usize) -> Bounds {
        let node = &self.nodes[index];
        Bounds::new(node.min, node.max)
    }

    /// Returns the indices of a node and all nodes below it, parents before children.
    pub fn subtree(&self, index: usize) -> Vec<usize> {
        let mut found = vec![index];
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

    /// Returns the indices of all leaves that can be reached from the root.
    pub fn leaves(&self) -> Vec<usize> {
        let mut nodes = if self.nodes.is_empty() {
            Vec::new()
        } else {
            self.subtree(self.root)
        };
        nodes.retain(|&index| self.nodes[index].is_leaf());
        nodes
    }

    /// Returns the indices of the primitives in a leaf.
    pub fn primitives(&self, leaf: usize) -> std::ops::Range<usize> {
        let node = &self.nodes[leaf];
        node.start as usize..(node.start + node.size) as usize
    }

    /// Returns the path from the root down to a node, inclusive.
    pub fn path(&self, to: usize) -> Vec<usize> {
        let mut parents = vec![None; self.nodes.len()];
        for index in self.subtree(self.root) {
            let node = &self.nodes[index];
            if !node.is_leaf() {
                for child in [node.l, node.r] {
                    parents[child as usize].get_or_insert(index);
                }
            }
        }
        let mut path = vec![to];
        while path[path.len() - 1] != self.root {
            let parent = parents[path[path.len() - 1]];
            path.push(parent.expect("the node is in the tree"));
        }
        path.reverse();
        path
    }

    /// Returns the parent of a node, or `None` for the root.
    pub fn parent(&self, index: usize) -> Option<usize> {
        self.path(index).into_iter().rev().nth(1)
    }

    /// Returns the other child of a node's parent, or `None` for the root.
    pub fn sibling(&self, index: usize) -> Option<usize> {
        let parent = &self.nodes[self.parent(index)?];
        let (l, r) = (parent.l as usize, parent.r as usize);
        Some(if l == index { r } else { l })
    }

    /// For each primitive, returns whether it is ordinary, i.e. in a reachable leaf and inside that
    /// leaf's box. All other primitives are decoys or unreferenced.
    pub fn ordinary_primitives(&self) -> Vec<bool> {
        let leaves = self.leaves();
        let shapes = 0..self.shapes.len();
        shapes.map(|it| self.is_ordinary(it, &leaves)).collect()
    }

    /// Returns whether a primitive is in one of these leaves and inside that leaf's box.
    fn is_ordinary(&self, index: usize, leaves: &[usize]) -> bool {
        /// The tolerance for the rounding of boxes to single precision, relative to their
        /// coordinates.
        const ROUNDING: f64 = 2e-6;
        let enlarged = |leaf: usize| {
            let bounds = self.bounds(leaf);
            let largest = bounds.min.abs().max(bounds.max.abs()).max_element();
            bounds.grown(ROUNDING * largest)
        };
        let bounds = scan::bounds(&self.shapes[index]);
        let mut holders = leaves
            .iter()
            .filter(|leaf| self.primitives(**leaf).contains(&index));
        holders.any(|&leaf| enlarged(leaf).contains(&bounds))
    }

    /// Returns the correct answer: the closest hit on an ordinary primitive.
    pub fn expected_hit(&self, ray64: &Ray64) -> Option<Intersection> {
        let indexed = (0..).zip(&self.shapes);
        let mut hits: Vec<(usize, f64)> = indexed
            .filter_map(|(index, shape)| Some((index, scan::hit_distance(ray64, shape)?)))
            .collect();
        hits.sort_by(|(_, a), (_, b)| a.total_cmp(b));
        let leaves = self.leaves();
        let mut hits = hits.into_iter();
        let (closest, _) = hits.find(|(index, _)| self.is_ordinary(*index, &leaves))?;
        scan::intersect(ray64, &self.shapes[closest])
    }

    /// Returns the leaf that contains the primitive of the expected hit, or `None` if the ray hits
    /// nothing.
    pub fn leaf_of_hit(&self, ray64: &Ray64) -> Option<usize> {
        let hit = self.expected_hit(ray64)?;
        let is_hit = |index: usize| self.shapes[index].number() == hit.shape;
        let mut leaves = self.leaves().into_iter();
        leaves.find(|&leaf| self.primitives(leaf).any(is_hit))
    }

    /// Adds a primitive to a leaf without changing the leaf's box.
    pub fn add_to_leaf(&mut self, leaf: usize, shape: Shape) {
        let at = self.primitives(leaf).end;
        self.shapes.insert(at, shape);
        for (index, node) in self.nodes.iter_mut().enumerate() {
            if node.is_leaf() && node.start as usize >= at && index != leaf {
                node.start += 1;
            }
        }
        self.nodes[leaf].size += 1;
    }

    /// Returns the same tree with its nodes in random order and the root at this position.
    pub fn with_nodes_shuffled(&self, rng: &mut Rng, root: RootPosition) -> Tree {
        let others = (0..self.nodes.len()).filter(|&index| index != self.root);
        let mut order = rng.shuffled(others.collect());
        let root_index = match root {
            RootPosition::First => 0,
            RootPosition::Middle => order.len() / 2,
            RootPosition::Last => order.len(),
        };
        order.insert(root_index, self.root);

        let mut moved = vec![0; order.len()];
        for (new, &old) in order.iter().enumerate() {
            moved[old] = new;
        }
        let nodes = order.iter().map(|&old| self.nodes[old]);
        Tree {
            shapes: self.shapes.clone(),
            nodes: nodes.map(|node| renumbered(node, |it| moved[it])).collect(),
            root: root_index,
        }
    }

    /// Returns the same tree with its root first, followed by a copy of the entire tree with its
    /// root last. On such a tree, even a traversal that starts at the first or the last node
    /// instead of `root` is correct.
    ///
    /// The copy has its own nodes. If only the root were copied, its children would have two
    /// parents. That would confuse code that computes parents or depths in one pass over all nodes.
    pub fn with_roots_at_both_ends(&self, rng: &mut Rng) -> Tree {
        let mut tree = self.with_nodes_shuffled(rng, RootPosition::First);
        let count = tree.nodes.len();
        // Node 1 is copied to the index after the last node, and so on.
        let copied = |node: &TreeNode| renumbered(*node, |index| index + count - 1);
        let mut copy: Vec<TreeNode> = tree.nodes.iter().map(copied).collect();
        copy.rotate_left(1);
        tree.nodes.extend(copy);
        tree
    }

    /// Swaps two nodes and updates all indices that refer to them.
    pub fn swap_nodes(&mut self, a: usize, b: usize) {
        let moved = |index: usize| match index {
            index if index == a => b,
            index if index == b => a,
            index => index,
        };
        self.nodes.swap(a, b);
        for node in &mut self.nodes {
            *node = renumbered(*node, moved);
        }
        self.root = moved(self.root);
    }

    /// Returns the tree as a question's subject.
    pub fn geometry(&self) -> Geometry {
        Geometry::Tree {
            shapes: self.shapes.clone(),
            nodes: self.nodes.clone(),
            root: self.root as u32,
        }
    }
}

/// Returns a node with the new indices of its children, if it has any.
fn renumbered(node: TreeNode, new: impl Fn(usize) -> usize) -> TreeNode {
    if node.is_leaf() {
        return node;
    }
    let [l, r] = [node.l, node.r].map(|child| new(child as usize) as u32);
    TreeNode { l, r, ..node }
}
