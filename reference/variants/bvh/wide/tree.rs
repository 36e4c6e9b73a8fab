// A wide BVH that tests eight boxes or eight triangles at a time. The binary tree, built here or
// passed by the caller, is collapsed into nodes with eight children, and the triangles of each leaf
// are stored together in a pack. This follows Wald, Benthin and Boulos, "Getting Rid of Packets",
// 2008, and Embree's `BVH8<Triangle4>`.
//
// Traversal is limited by cache misses and branch mispredictions, not by arithmetic:
//
// - Nodes and packs share one array, with the packs of a node right behind it. All children that
//   the ray hits are prefetched at once, together with the memory behind them.
// - Packs are small, because each corner that neighbouring triangles share is stored once.
// - A stack entry is one integer, with the entry distance in the bits above the child, so that the
//   nearer of two children is found without a branch.
// - For each axis, the sign of the ray's direction decides which plane of a box the ray reaches
//   first, so only that plane is used to compute the entry distance.
// - The shading data of a triangle is in one cache line. For a flat triangle, it is computed from
//   the corners, so nothing else is read.
// - When the tree is built here, traversal doesn't use `nodes` but a different tree, in which large
//   triangles may be split into pieces.

use glam::{Vec2, Vec3};
use protocol::{Interval, Shape};
use wide::bytemuck::cast;
use wide::{f32x4, f32x8, u32x8};

use crate::triangle::Triangle;

/// A bounding volume hierarchy, stored twice: as a binary tree and as a wide tree for traversal.
#[derive(Clone, Debug)]
pub struct Bvh {
    pub primitives: Vec<Primitive>,
    pub nodes: Vec<Node>,
    pub root: usize,
    /// The wide tree with its root first. Empty if there are no primitives.
    lines: Vec<CacheLine>,
    /// Shading data of the triangles in each pack, unless all triangles of the pack are flat.
    surfaces: Vec<Surface>,
}

impl Bvh {
    pub fn from_nodes(primitives: Vec<Primitive>, nodes: Vec<Node>, root: usize) -> Self {
        let order: Vec<usize> = (0..primitives.len()).collect();
        let (lines, surfaces) = if root < nodes.len() {
            Collapser::new(&primitives, nodes.clone(), order).collapse(root)
        } else {
            (Vec::new(), Vec::new())
        };
        Bvh {
            primitives,
            nodes,
            root,
            lines,
            surfaces,
        }
    }

    /// Builds the tree with the surface area heuristic (SAH), and a second tree for traversal, in
    /// which triangles may be split.
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let max_leaf_size = max_leaf_size.max(1);
        let mut builder = Builder {
            items: items(&primitives),
            nodes: Vec::with_capacity(primitives.len()),
            max_leaf_size,
        };
        if primitives.is_empty() {
            return Bvh::from_nodes(primitives, Vec::new(), 0);
        }
        builder.node(0, primitives.len());
        let ordered = builder.items.iter().map(|item| primitives[item.index]);
        let primitives: Vec<Primitive> = ordered.collect();
        let mut spatial = SpatialBuilder::new(&primitives);
        spatial.node(items(&primitives));
        let SpatialBuilder { nodes, order, .. } = spatial;
        let (lines, surfaces) = Collapser::new(&primitives, nodes, order).collapse(0);
        Bvh {
            primitives,
            nodes: builder.nodes,
            root: 0,
            lines,
            surfaces,
        }
    }

    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest = ClosestHit {
            distance: ray.range.max,
            primitive: HitPrimitive::None,
        };
        if !self.lines.is_empty() {
            self.traverse(&WideRay::new(ray), ray, &mut closest);
        }
        match closest.primitive {
            HitPrimitive::None => None,
            HitPrimitive::Sphere { index } => self.primitives[index as usize].hit(ray),
            HitPrimitive::Triangle { pack, lane, u, v } => {
                let pack = Pack::at(&self.lines, pack);
                let (normal, uv, shape) = match pack.shading(lane) {
                    Shading::Computed { normal, shape } => (normal, Vec2::new(u, v), shape),
                    Shading::Stored { index } => self.surfaces[index as usize].interpolate(u, v),
                };
                Some(Trace {
                    distance: closest.distance,
                    position: ray.at(closest.distance),
                    normal,
                    uv,
                    origin: ray.origin,
                    shape,
                })
            }
        }
    }

    fn traverse(&self, wide_ray: &WideRay, ray: &Ray, closest: &mut ClosestHit) {
        let mut stack = Stack::new();
        let mut child = 0;
        loop {
            if child & LEAF == 0 {
                let node = WideNode::at(&self.lines, child);
                let (entries, mut mask) = node.entries(wide_ray, closest.distance);
                if mask != 0 {
                    let entries = entries.to_array();
                    let next_entry = |mask: &mut u32| {
                        let lane = mask.trailing_zeros() as usize & 7;
                        *mask &= *mask - 1;
                        let child = node.child(lane);
                        self.prefetch(child);
                        StackEntry::new(entries[lane], child)
                    };
                    let mut first = next_entry(&mut mask);
                    if mask != 0 {
                        let base = stack.reserve_eight();
                        while mask != 0 {
                            let other = next_entry(&mut mask);
                            stack.insert(base, first.max(other));
                            first = first.min(other);
                        }
                    }
                    child = first.child();
                    continue;
                }
            } else {
                self.test_leaf(child & !LEAF, wide_ray, ray, closest);
            }
            child = loop {
                match stack.pop() {
                    None => return,
                    Some(next) if next.entry() <= closest.distance => break next.child(),
                    Some(_) => {}
                }
            };
        }
    }

    /// Prefetches a child and the memory behind it. The child is likely to be visited, though
    /// perhaps not immediately. The memory behind it is likely to be read after that: it contains
    /// the first packs of a node, or the neighbours of a pack.
    fn prefetch(&self, child: u32) {
        const LINES: usize = WideNode::LINES + 2 * Pack::LINES;
        let start = (child & !LEAF) as usize;
        if let Some(lines) = self.lines.get(start..start + LINES) {
            lines.iter().for_each(prefetch);
        }
    }

    fn test_leaf(&self, start: u32, wide_ray: &WideRay, ray: &Ray, closest: &mut ClosestHit) {
        let pack = Pack::at(&self.lines, start);
        if pack.has_flag(Pack::SPHERES_FLAG) {
            for index in pack.spheres() {
                let rest = ray.within(ray.range.min, closest.distance);
                if let Some(trace) = self.primitives[index as usize].hit(&rest) {
                    closest.distance = trace.distance;
                    closest.primitive = HitPrimitive::Sphere { index };
                }
            }
        } else if let Some(hit) = pack.hit(wide_ray, closest.distance) {
            closest.distance = hit.distance;
            closest.primitive = HitPrimitive::Triangle {
                pack: start,
                lane: hit.lane,
                u: hit.u,
                v: hit.v,
            };
            if let Some(index) = pack.surface_index(hit.lane) {
                // The surface will be read unless a closer hit is found.
                prefetch(&self.surfaces[index as usize]);
            }
        }
    }
}

/// Prefetches the cache line where `what` begins, if the processor supports it.
fn prefetch<T>(what: &T) {
    #[cfg(target_feature = "sse")]
    safe_arch::prefetch_t0(what);
    #[cfg(not(target_feature = "sse"))]
    let _ = what;
}

/// The closest hit so far.
struct ClosestHit {
    distance: f32,
    primitive: HitPrimitive,
}

/// The primitive of the closest hit.
enum HitPrimitive {
    None,
    /// A sphere, identified by its index in [`Bvh::primitives`].
    Sphere {
        index: u32,
    },
    /// A triangle, identified by the index of its pack's first cache line and by its lane in the
    /// pack. `u` and `v` are the barycentric weights of its second and third corners.
    Triangle {
        pack: u32,
        lane: usize,
        u: f32,
        v: f32,
    },
}
