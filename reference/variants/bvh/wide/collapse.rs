// Collapses a binary tree into wide nodes and packs.

/// A converter from a binary tree to a wide tree.
struct Collapser<'a> {
    primitives: &'a [Primitive],
    nodes: Vec<Node>,
    /// The indices of the primitives that the leaves refer to. A primitive that is split occurs
    /// several times.
    order: Vec<usize>,
    /// For each node, the plan for collapsing its subtree.
    plans: Vec<Plan>,
    lines: Vec<CacheLine>,
    surfaces: Vec<Surface>,
}

/// The cheapest way to collapse a subtree. See Ylitie, Karras and Laine, "Efficient Incoherent Ray
/// Traversal on GPUs Through Compressed Wide BVHs", 2017, section 3.1. Visiting a node is assumed
/// to cost as much as testing a pack.
#[derive(Clone, Copy, Default)]
struct Plan {
    /// `costs[n]` is the cost of this subtree when it is collapsed into at most n children of a
    /// wide ancestor. n is at least 1.
    costs: [f32; 8],
    /// `sides[n]` says how many of these children come from the left and from the right subtree.
    /// Both are 0 if the whole subtree is one child.
    sides: [(u8, u8); 9],
}

impl<'a> Collapser<'a> {
    fn new(primitives: &'a [Primitive], nodes: Vec<Node>, order: Vec<usize>) -> Self {
        Collapser {
            primitives,
            plans: vec![Plan::default(); nodes.len()],
            lines: Vec::with_capacity(nodes.len()),
            surfaces: Vec::new(),
            nodes,
            order,
        }
    }

    fn collapse(mut self, root: usize) -> (Vec<CacheLine>, Vec<Surface>) {
        self.plan(root);
        self.write_node(root);
        (self.lines, self.surfaces)
    }

    fn plan(&mut self, index: usize) {
        let area = self.nodes[index].bbox.surface_area();
        if self.nodes[index].is_leaf() && !self.split_leaf(index) {
            self.plans[index] = Plan {
                costs: [area; 8],
                ..Plan::default()
            };
            return;
        }

        let node = self.nodes[index];
        self.plan(node.l);
        self.plan(node.r);
        let (l, r) = (&self.plans[node.l], &self.plans[node.r]);
        // Returns the cost of the cheapest way to get this many children from both subtrees, and
        // the number of children from each.
        let cheapest_way = |children: usize| {
            let ways = (1..children).filter(|&from_l| from_l < 8 && children - from_l < 8);
            let cost = |from_l: usize| l.costs[from_l] + r.costs[children - from_l];
            let from_l = ways.min_by(|&a, &b| cost(a).total_cmp(&cost(b)));
            let from_l = from_l.expect("one child from each side is always possible");
            (cost(from_l), (from_l as u8, (children - from_l) as u8))
        };
        let mut plan = Plan::default();
        let (below, sides) = cheapest_way(8);
        plan.sides[8] = sides;
        plan.costs[1] = area + below;
        for children in 2..8 {
            let (cost, sides) = cheapest_way(children);
            let fewer = children - 1;
            (plan.costs[children], plan.sides[children]) = if cost < plan.costs[fewer] {
                (cost, sides)
            } else {
                (plan.costs[fewer], plan.sides[fewer])
            };
        }
        self.plans[index] = plan;
    }

    /// Splits a leaf into two if it doesn't fit in a pack. Returns whether it was split. Both new
    /// leaves keep the box of the old leaf, which need not be tight if the tree comes from the
    /// caller.
    fn split_leaf(&mut self, index: usize) -> bool {
        let Node {
            bbox, start, size, ..
        } = self.nodes[index];
        let indices = &mut self.order[start..start + size];
        if fits_in_pack(self.primitives, indices.iter().copied()) {
            return false;
        }
        indices.sort_by_key(|&index| matches!(self.primitives[index], Primitive::Sphere(_)));
        let (half, l) = (size / 2, self.nodes.len());
        self.nodes.push(Node::leaf(bbox, start, half));
        self.nodes.push(Node::leaf(bbox, start + half, size - half));
        self.plans.extend([Plan::default(); 2]);
        self.nodes[index] = Node::interior(bbox, l, l + 1);
        true
    }

    /// Collapses a subtree into at most `at_most` children, which are added to `found`.
    fn children(&self, index: usize, at_most: u8, found: &mut Vec<usize>) {
        match self.plans[index].sides[usize::from(at_most)] {
            (0, 0) => found.push(index),
            (from_l, from_r) => {
                let node = self.nodes[index];
                self.children(node.l, from_l, found);
                self.children(node.r, from_r, found);
            }
        }
    }

    /// Writes the wide node for a subtree and everything below it. Returns the node's first line.
    /// Leaves come before other children, and large boxes before small ones: see [`Bvh::prefetch`].
    fn write_node(&mut self, root: usize) -> u32 {
        let mut children = Vec::with_capacity(8);
        self.children(root, 8, &mut children);
        children.sort_by(|&a, &b| {
            let [a, b] = [a, b].map(|child| &self.nodes[child]);
            let larger = || b.bbox.surface_area().total_cmp(&a.bbox.surface_area());
            b.is_leaf().cmp(&a.is_leaf()).then_with(larger)
        });
        let mut planes = [[[f32::INFINITY; 8], [f32::NEG_INFINITY; 8]]; 3];
        for (lane, &child) in children.iter().enumerate() {
            let bbox = self.nodes[child].bbox;
            for (axis, [lower, upper]) in planes.iter_mut().enumerate() {
                lower[lane] = bbox.min[axis];
                upper[lane] = bbox.max[axis];
            }
        }
        let start = self.lines.len();
        let planes = planes.map(|both| CacheLine(both.map(f32x8::from)));
        self.lines.extend(planes);
        self.lines.push(CacheLine([f32x8::ZERO; 2]));

        let mut child_lines = [0.0; 8];
        for (line, &child) in child_lines.iter_mut().zip(&children) {
            *line = f32::from_bits(if self.nodes[child].is_leaf() {
                self.write_leaf(child) | LEAF
            } else {
                self.write_node(child)
            });
        }
        self.lines[start + 3] = CacheLine([f32x8::from(child_lines), f32x8::ZERO]);
        to_u32(start)
    }

    /// Writes the pack for a leaf and returns the pack's first line.
    fn write_leaf(&mut self, index: usize) -> u32 {
        let Node { start, size, .. } = self.nodes[index];
        // Takes each primitive once, even if the leaf contains several pieces of that primitive.
        let mut indices = self.order[start..start + size].to_vec();
        indices.sort_unstable();
        indices.dedup();
        let primitives = self.primitives;
        let indexed = || indices.iter().map(|&index| (index, &primitives[index]));
        let triangles = indexed().filter_map(|(_, primitive)| match primitive {
            Primitive::Triangle(triangle) => Some(triangle),
            Primitive::Sphere(_) => None,
        });
        let spheres = indexed().filter_map(|(index, primitive)| match primitive {
            Primitive::Sphere(_) => Some(to_u32(index)),
            Primitive::Triangle(_) => None,
        });
        let triangles: Vec<&Triangle> = triangles.collect();
        let registers = if triangles.is_empty() {
            sphere_registers(spheres)
        } else {
            self.triangle_registers(&triangles)
        };
        let start = to_u32(self.lines.len());
        self.lines.extend(Pack::lines(registers));
        start
    }

    fn triangle_registers(&mut self, triangles: &[&Triangle]) -> [[u32; 8]; 4] {
        let mut corners = Corners::default();
        let mut words = [Word::default(); 8];
        for (word, triangle) in words.iter_mut().zip(triangles) {
            let lanes = positions(triangle).map(|position| corners.lane(position));
            *word = Word::new(lanes.map(|lane| lane.expect("the corners of a leaf fit in a pack")));
        }

        let is_flat =
            |triangle: &&Triangle| is_flat(triangle) && triangle.shape < Word::EXTRA_LIMIT;
        if triangles.iter().all(is_flat) {
            for (word, triangle) in words.iter_mut().zip(triangles) {
                word.set_extra(triangle.shape);
            }
        } else {
            let start = to_u32(self.surfaces.len());
            words[0].set_extra(start % Word::EXTRA_LIMIT);
            words[1].set_extra(start / Word::EXTRA_LIMIT);
            words[Pack::SURFACES_FLAG].set_flag();
            let surfaces = triangles.iter().map(|triangle| Surface::new(triangle));
            self.surfaces.extend(surfaces);
        }
        let [x, y, z] = corners.registers();
        [x, y, z, words.map(|Word(word)| word)]
    }
}
