// Traversal visits up to four children at once. The build determines these children (Wald, Benthin
// and Boulos, "Getting Rid of Packets", 2008).

#[derive(Clone, Debug)]
pub struct Bvh {
    pub primitives: Vec<Primitive>,
    pub nodes: Vec<Node>,
    pub root: usize,
    /// For each interior node, up to four descendants that replace its children.
    wide: Vec<Vec<usize>>,
}

impl Bvh {
    pub fn from_nodes(primitives: Vec<Primitive>, nodes: Vec<Node>, root: usize) -> Self {
        let wide = nodes.iter().map(|node| up_to_four(&nodes, node)).collect();
        Bvh {
            primitives,
            nodes,
            root,
            wide,
        }
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let root = self.nodes.get(self.root)?;
        root.bbox.hit(ray, ray.range)?;
        let mut closest = None;
        self.traverse(self.root, &mut ray.clone(), &mut closest);
        closest
    }

    /// Looks for a closer hit below the node at `index`, whose box the ray is known to hit.
    fn traverse(&self, index: usize, ray: &mut Ray, closest: &mut Option<Trace>) {
        let node = &self.nodes[index];
        if node.is_leaf() {
            return self.test_leaf(node, ray, closest);
        }
        let hit = self.wide[index]
            .iter()
            .filter_map(|&child| Some((self.nodes[child].bbox.hit(ray, ray.range)?.min, child)));
        let mut ahead: Vec<(f32, usize)> = hit.collect();
        ahead.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (entry, child) in ahead {
            if entry <= ray.range.max {
                self.traverse(child, ray, closest);
            }
        }
    }
}

/// Returns up to four descendants of a node. While there are fewer than four, replaces the interior
/// node whose box is largest with that node's children.
fn up_to_four(nodes: &[Node], node: &Node) -> Vec<usize> {
    if node.is_leaf() {
        return Vec::new();
    }
    let mut children = vec![node.l, node.r];
    while children.len() < 4 {
        let area = |index: &usize| nodes[*index].bbox.surface_area();
        let interior = (0..children.len()).filter(|&i| !nodes[children[i]].is_leaf());
        let largest = interior.max_by(|&a, &b| area(&children[a]).total_cmp(&area(&children[b])));
        let Some(i) = largest else { break };
        let opened = &nodes[children.swap_remove(i)];
        children.extend([opened.l, opened.r]);
    }
    children
}
