// A wide BVH that tests eight boxes or eight triangles at a time. The binary tree, built here or
// given by the caller, is collapsed into nodes with eight children, and the triangles of each leaf
// are stored together in a pack. This follows Wald, Benthin and Boulos, "Getting Rid of Packets",
// 2008, and Embree's `BVH8<Triangle4>`.
//
// Traversal is limited by cache misses and branch mispredictions, not by arithmetic:
//
// - Nodes and packs are in one array, with the packs of a node right behind it. All children that
//   the ray hits are prefetched at once, together with the memory behind them.
// - A pack is small, because each corner that neighbouring triangles share is stored once.
// - A stack entry is one integer, with the entry distance in the bits above the child, so that the
//   nearer of two children is found without a branch.
// - For each axis, the sign of the ray's direction tells which plane of a box the ray reaches
//   first, so only that plane is used to compute the entry distance.
// - The shading data of a triangle is in one cache line. For a flat triangle, it is computed from
//   the corners, so nothing else is read.
// - For a tree built here, traversal does not use `nodes` but another tree, in which a large
//   triangle may be split into pieces.

use glam::{Vec2, Vec3};
use protocol::{Interval, Shape};
use wide::bytemuck::cast;
use wide::{f32x4, f32x8, u32x8};

use crate::triangle::Triangle;

/// A bounding volume hierarchy, stored twice: as a binary tree, and as a wide tree for traversal.
#[derive(Clone, Debug)]
pub struct Bvh {
    pub primitives: Vec<Primitive>,
    pub nodes: Vec<Node>,
    pub root: usize,
    /// The wide tree, with its root first. Empty if there are no primitives.
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

    /// Builds the tree with the surface area heuristic (SAH), and another tree with split triangles
    /// for traversal.
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
                let (normal, uv, material) = match pack.shading(lane) {
                    Shading::Computed { normal, material } => (normal, Vec2::new(u, v), material),
                    Shading::Stored { index } => self.surfaces[index as usize].interpolate(u, v),
                };
                Some(Trace {
                    distance: closest.distance,
                    position: ray.at(closest.distance),
                    normal,
                    uv,
                    origin: ray.origin,
                    material,
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

    /// Prefetches a child, which is likely to be visited, though perhaps not immediately, and the
    /// memory behind the child, which is likely to be visited next: the first packs of a node, or
    /// the neighbours of a pack.
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

/// Prefetches the cache line in which `what` begins, if the processor supports it.
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
    /// A sphere, given by its index in [`Bvh::primitives`].
    Sphere {
        index: u32,
    },
    /// A triangle, given by the index of its pack's first cache line and by its lane in the pack.
    /// `u` and `v` are the barycentric weights of its second and third corners.
    Triangle {
        pack: u32,
        lane: usize,
        u: f32,
        v: f32,
    },
}

/// The shading data of a triangle, in one cache line.
#[derive(Clone, Debug)]
#[repr(align(64))]
struct Surface {
    normals: [Vec3; 3],
    uvs: [Vec2; 3],
    material: u32,
}

impl Surface {
    fn new(triangle: &Triangle) -> Self {
        let Triangle { p0, p1, p2, .. } = triangle;
        Surface {
            normals: [p0.normal, p1.normal, p2.normal],
            uvs: [p0.uv, p1.uv, p2.uv],
            material: triangle.material,
        }
    }

    /// Returns the normal, texture coordinates and material at a point, given the weights of two
    /// corners.
    fn interpolate(&self, u: f32, v: f32) -> (Vec3, Vec2, u32) {
        let w = 1.0 - u - v;
        let [n0, n1, n2] = self.normals;
        let [uv0, uv1, uv2] = self.uvs;
        let normal = (w * n0 + u * n1 + v * n2).normalize();
        (normal, w * uv0 + u * uv1 + v * uv2, self.material)
    }
}

/// A child to be visited, and the distance at which the ray enters its box.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct StackEntry(u64);

impl StackEntry {
    /// Creates an entry, with the entry distance in the bits above the child. The bit patterns of
    /// non-negative floats have the same order as the floats, so the nearest of several entries is
    /// the smallest integer.
    fn new(entry: f32, child: u32) -> Self {
        StackEntry(u64::from(entry.to_bits()) << 32 | u64::from(child))
    }

    fn entry(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }

    fn child(self) -> u32 {
        self.0 as u32
    }
}

/// The children that are still to be visited, the nearest last.
struct Stack {
    entries: [StackEntry; Stack::SIZE],
    len: usize,
    /// Older entries, moved here when the array was almost full. Few trees are deep enough to need
    /// it.
    overflow: Vec<StackEntry>,
}

impl Stack {
    /// The size of the array: a power of two, so that `%` is a mask and the index needs no bounds
    /// check.
    const SIZE: usize = 32;

    fn new() -> Self {
        Stack {
            entries: [StackEntry(0); Stack::SIZE],
            len: 0,
            overflow: Vec::new(),
        }
    }

    /// Makes room for the children of one more node, and returns the index of the first of them.
    fn reserve_eight(&mut self) -> usize {
        if self.len > Stack::SIZE - 8 {
            self.overflow.extend_from_slice(&self.entries[..self.len]);
            self.len = 0;
        }
        self.len
    }

    /// Inserts an entry into the entries from `base` on, which are sorted.
    fn insert(&mut self, base: usize, entry: StackEntry) {
        let mut index = self.len;
        while index > base && self.entries[(index - 1) % Stack::SIZE] < entry {
            self.entries[index % Stack::SIZE] = self.entries[(index - 1) % Stack::SIZE];
            index -= 1;
        }
        self.entries[index % Stack::SIZE] = entry;
        self.len += 1;
    }

    fn pop(&mut self) -> Option<StackEntry> {
        match self.len.checked_sub(1) {
            Some(len) => {
                self.len = len;
                Some(self.entries[len % Stack::SIZE])
            }
            None => self.overflow.pop(),
        }
    }
}

/// A ray, copied to all lanes.
struct WideRay {
    origin: [f32x8; 3],
    dir: [f32x8; 3],
    inverse: [f32x8; 3],
    /// The inverse of the direction, slightly enlarged, for computing exit distances.
    padded_inverse: [f32x8; 3],
    /// Whether the direction is negative, for each axis.
    is_negative: [bool; 3],
    min: f32x8,
}

impl WideRay {
    /// The minimum absolute value of a direction component. The inverse of 0 would be infinite, and
    /// infinity times 0 is NaN. The inverse of this number is large enough to serve as infinity.
    const MIN_COMPONENT: f32 = 1e-30;

    /// A factor that makes up for the rounding error of exit distances, so that no box is missed.
    /// Pharr, Jakob and Humphreys, "Physically Based Rendering" (4th edition), section 6.1.2.
    const EXIT_PADDING: f32 = 1.000_000_4;

    fn new(ray: &Ray) -> Self {
        let dir = ray.dir.to_array();
        let inverse = dir.map(|d| 1.0 / d.abs().max(WideRay::MIN_COMPONENT).copysign(d));
        WideRay {
            origin: ray.origin.to_array().map(f32x8::splat),
            dir: dir.map(f32x8::splat),
            inverse: inverse.map(f32x8::splat),
            padded_inverse: inverse.map(|inverse| f32x8::splat(inverse * WideRay::EXIT_PADDING)),
            is_negative: inverse.map(|inverse| inverse < 0.0),
            min: f32x8::splat(ray.range.min),
        }
    }
}

/// A cache line.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct CacheLine([f32x8; 2]);

/// The bit that marks a child as a leaf, which is stored as a pack. It is set in the index of the
/// child's first cache line.
const LEAF: u32 = 1 << 31;

/// A node with up to eight children: for each axis, a line with the lower and upper planes of all
/// boxes, and one line with the children. A lane without a child has a box that no ray hits.
struct WideNode<'a>(&'a [CacheLine; WideNode::LINES]);

impl<'a> WideNode<'a> {
    const LINES: usize = 4;

    fn at(lines: &'a [CacheLine], start: u32) -> Self {
        WideNode(lines_at(lines, start))
    }

    fn child(&self, lane: usize) -> u32 {
        let CacheLine([children, _]) = &self.0[3];
        children.as_array()[lane].to_bits()
    }

    /// Returns the entry distances of all boxes, and a bit mask of the boxes that the ray enters
    /// before `max`.
    fn entries(&self, wide_ray: &WideRay, max: f32) -> (f32x8, u32) {
        let from = |axis: usize, upper: bool| {
            let CacheLine(planes) = &self.0[axis];
            planes[usize::from(upper)] - wide_ray.origin[axis]
        };
        let enter =
            [0, 1, 2].map(|axis| from(axis, wide_ray.is_negative[axis]) * wide_ray.inverse[axis]);
        let leave = [0, 1, 2]
            .map(|axis| from(axis, !wide_ray.is_negative[axis]) * wide_ray.padded_inverse[axis]);
        // Maxima and minima are computed in pairs that do not depend on each other, which shortens
        // the dependency chain.
        let enter = (enter[0].fast_max(enter[1])).fast_max(enter[2].fast_max(wide_ray.min));
        let leave = (leave[0].fast_min(leave[1])).fast_min(leave[2].fast_min(f32x8::splat(max)));
        (enter, enter.simd_le(leave).to_bitmask())
    }
}

/// A leaf with up to eight triangles, or with the indices of up to eight spheres.
///
/// The triangles have at most eight different corners, because neighbours share them. Three
/// registers hold the corners' coordinates, and the fourth holds one word per triangle with the
/// lanes of its corners. A lane without a triangle repeats one corner three times, which no ray
/// hits.
struct Pack<'a>(&'a [CacheLine; Pack::LINES]);

/// A packed word of a triangle: three times three bits for the lanes of its corners, 22 bits of
/// extra data, and a flag.
#[derive(Clone, Copy, Default)]
struct Word(u32);

impl Word {
    /// The upper limit (exclusive) of the extra data.
    const EXTRA_LIMIT: u32 = 1 << 22;
    const FLAG: u32 = 1 << 31;

    fn new([a, b, c]: [u32; 3]) -> Self {
        Word(a | b << 3 | c << 6)
    }

    fn corners(self) -> [usize; 3] {
        [0, 3, 6].map(|shift| (self.0 >> shift & 7) as usize)
    }

    fn set_extra(&mut self, extra: u32) {
        self.0 |= extra << 9;
    }

    fn extra(self) -> u32 {
        self.0 >> 9 & (Word::EXTRA_LIMIT - 1)
    }

    fn set_flag(&mut self) {
        self.0 |= Word::FLAG;
    }

    fn is_flagged(self) -> bool {
        self.0 & Word::FLAG != 0
    }
}

fn cross(a: &[f32x8; 3], b: &[f32x8; 3]) -> [f32x8; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot(a: &[f32x8; 3], b: &[f32x8; 3]) -> f32x8 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl<'a> Pack<'a> {
    const LINES: usize = 2;

    /// The lane whose flag marks a pack of spheres.
    const SPHERES_FLAG: usize = 0;
    /// The lane whose flag marks a pack with triangles that are not flat. The extra data of the
    /// first two words is then the index of the first triangle's surface; otherwise, the extra data
    /// of each word is the triangle's material.
    const SURFACES_FLAG: usize = 1;

    fn at(lines: &'a [CacheLine], start: u32) -> Self {
        Pack(lines_at(lines, start))
    }

    fn lines(registers: [[u32; 8]; 4]) -> [CacheLine; Pack::LINES] {
        let [x, y, z, words] = registers.map(cast);
        [CacheLine([x, y]), CacheLine([z, words])]
    }

    fn word(&self, lane: usize) -> Word {
        let CacheLine([_, words]) = &self.0[1];
        Word(words.as_array()[lane].to_bits())
    }

    fn has_flag(&self, lane: usize) -> bool {
        self.word(lane).is_flagged()
    }

    /// Returns the indices of the spheres.
    fn spheres(&self) -> impl Iterator<Item = u32> {
        let CacheLine([indices, _]) = &self.0[0];
        let indices = indices.to_array().map(f32::to_bits);
        indices.into_iter().take_while(|&index| index != NO_SPHERE)
    }

    /// Returns the index of the triangle's surface, or `None` if all triangles of the pack are
    /// flat.
    fn surface_index(&self, lane: usize) -> Option<u32> {
        let first = || self.word(0).extra() + self.word(1).extra() * Word::EXTRA_LIMIT;
        self.has_flag(Pack::SURFACES_FLAG)
            .then(|| first() + lane as u32)
    }

    fn shading(&self, lane: usize) -> Shading {
        if let Some(index) = self.surface_index(lane) {
            return Shading::Stored { index };
        }
        let word = self.word(lane);
        let [CacheLine([x, y]), CacheLine([z, _])] = self.0;
        let [p0, p1, p2] = word
            .corners()
            .map(|corner| Vec3::from([x, y, z].map(|lanes| lanes.as_array()[corner])));
        Shading::Computed {
            normal: (p1 - p0).cross(p2 - p0).normalize(),
            material: word.extra(),
        }
    }

    /// Returns the three corners of each triangle.
    fn corners(&self) -> [[f32x8; 3]; 3] {
        let [CacheLine([x, y]), CacheLine([z, words])] = *self.0;
        let [x, y, z, words]: [u32x8; 4] = [x, y, z, words].map(cast);
        [words, words >> 3, words >> 6].map(|corner| {
            let corner = corner & u32x8::splat(7);
            [x, y, z].map(|lanes| cast(lanes.shuffle(corner)))
        })
    }

    /// Tests eight triangles by Möller and Trumbore's algorithm, and returns the closest hit up to
    /// `max`.
    fn hit(&self, wide_ray: &WideRay, max: f32) -> Option<PackHit> {
        let [p0, p1, p2] = self.corners();
        let from = |p: &[f32x8; 3]| [0, 1, 2].map(|axis| p[axis] - p0[axis]);
        let (e1, e2, s) = (from(&p1), from(&p2), from(&wide_ray.origin));

        let p = cross(&wide_ray.dir, &e2);
        let q = cross(&s, &e1);
        // There is no division unless there is a hit: u, v and t are compared with multiples of the
        // determinant, after both sides have been multiplied by its sign.
        let determinant = dot(&p, &e1);
        let sign = determinant & f32x8::splat(-0.0);
        let determinant = determinant ^ sign;
        let u = dot(&p, &s) ^ sign;
        let v = dot(&q, &wide_ray.dir) ^ sign;
        let t = dot(&q, &e2) ^ sign;
        // Comparisons with NaN are false, so NaN is never a hit.
        let inside = u.simd_ge(f32x8::ZERO) & v.simd_ge(f32x8::ZERO) & (u + v).simd_le(determinant);
        let latest = f32x8::splat(max) * determinant;
        let ahead = t.simd_ge(wide_ray.min * determinant) & t.simd_le(latest);
        let mut mask = (inside & ahead & determinant.simd_gt(f32x8::ZERO)).to_bitmask();
        if mask == 0 {
            return None;
        }

        let [u, v, t] = [u, v, t].map(|times| (times / determinant).to_array());
        let range = Interval::new(wide_ray.min.as_array()[0], max);
        let mut nearest: Option<PackHit> = None;
        while mask != 0 {
            let lane = mask.trailing_zeros() as usize & 7;
            mask &= mask - 1;
            if range.contains(t[lane]) && nearest.as_ref().is_none_or(|hit| t[lane] <= hit.distance)
            {
                nearest = Some(PackHit {
                    distance: t[lane],
                    lane,
                    u: u[lane],
                    v: v[lane],
                });
            }
        }
        nearest
    }
}

/// A hit on a triangle in a pack. `u` and `v` are the barycentric weights of its second and third
/// corners.
struct PackHit {
    distance: f32,
    lane: usize,
    u: f32,
    v: f32,
}

/// The source of a triangle's shading data.
enum Shading {
    /// Computed from the corners. See [`Shape::flat_triangle_vertices`].
    Computed { normal: Vec3, material: u32 },
    /// The surface with this index.
    Stored { index: u32 },
}

/// Returns `N` lines from `start` on.
fn lines_at<const N: usize>(lines: &[CacheLine], start: u32) -> &[CacheLine; N] {
    lines[start as usize..][..N]
        .try_into()
        .expect("the slice has N lines")
}

/// A converter from a binary tree to a wide tree.
struct Collapser<'a> {
    primitives: &'a [Primitive],
    nodes: Vec<Node>,
    /// The indices of the primitives to which the leaves refer. A primitive that is split occurs
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
    /// wide ancestor, for n from 1.
    costs: [f32; 8],
    /// `sides[n]` holds the numbers of these children that come from the left and from the right
    /// subtree. Both are 0 if the whole subtree is one child.
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

    /// Splits a leaf into two if it does not fit in a pack, and returns whether it was split. Both
    /// new leaves keep the box of the old leaf, which need not be the tightest box in a tree from
    /// the caller.
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

    /// Collects the nodes that become children, at most `at_most` of them.
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

    /// Writes the wide node for a subtree and everything below it, and returns the node's first
    /// line. Leaves come before other children, and large boxes before small ones: see
    /// [`Bvh::prefetch`].
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

    /// Writes the pack of a leaf, and returns its first line.
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
            |triangle: &&Triangle| is_flat(triangle) && triangle.material < Word::EXTRA_LIMIT;
        if triangles.iter().all(is_flat) {
            for (word, triangle) in words.iter_mut().zip(triangles) {
                word.set_extra(triangle.material);
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

/// Returns the registers of a pack of spheres, given their indices.
fn sphere_registers(indices: impl Iterator<Item = u32>) -> [[u32; 8]; 4] {
    let (mut lanes, mut words) = ([NO_SPHERE; 8], [Word::default(); 8]);
    for (lane, index) in lanes.iter_mut().zip(indices) {
        *lane = index;
    }
    words[Pack::SPHERES_FLAG].set_flag();
    [lanes, [0; 8], [0; 8], words.map(|Word(word)| word)]
}

/// The index in a lane without a sphere. No primitive has this index.
const NO_SPHERE: u32 = u32::MAX;

fn positions(triangle: &Triangle) -> [Vec3; 3] {
    [&triangle.p0, &triangle.p1, &triangle.p2].map(|corner| corner.position)
}

/// Returns whether all shading data can be computed from the corners.
fn is_flat(triangle: &Triangle) -> bool {
    let corners = [&triangle.p0, &triangle.p1, &triangle.p2];
    Shape::flat_triangle_vertices(positions(triangle))
        .iter()
        .eq(corners)
}

/// The distinct corners of some triangles, at most eight.
#[derive(Default)]
struct Corners {
    positions: [Vec3; 8],
    len: usize,
}

impl Corners {
    /// Returns the lane of a corner, adding it if it is new, or `None` if all lanes are used.
    fn lane(&mut self, position: Vec3) -> Option<u32> {
        let mut known = self.positions[..self.len].iter();
        let lane = known.position(|known| *known == position);
        if lane.is_none() {
            *self.positions.get_mut(self.len)? = position;
            self.len += 1;
        }
        Some(lane.unwrap_or(self.len - 1) as u32)
    }

    fn registers(&self) -> [[u32; 8]; 3] {
        [0, 1, 2].map(|axis| self.positions.map(|position| position[axis].to_bits()))
    }
}

/// Returns whether the primitives with these indices fit in one pack.
fn fits_in_pack(primitives: &[Primitive], indices: impl ExactSizeIterator<Item = usize>) -> bool {
    let (mut corners, mut triangles, mut spheres) = (Corners::default(), 0, 0);
    indices.len() <= 8
        && indices
            .map(|index| &primitives[index])
            .all(|primitive| match primitive {
                Primitive::Triangle(triangle) => {
                    triangles += 1;
                    let mut positions = positions(triangle).into_iter();
                    positions.all(|position| corners.lane(position).is_some())
                }
                Primitive::Sphere(_) => {
                    spheres += 1;
                    true
                }
            })
        && (triangles == 0 || spheres == 0)
}

/// Converts an index to `u32`, and checks that it leaves the bit [`LEAF`] free.
fn to_u32(index: usize) -> u32 {
    let index = u32::try_from(index).ok().filter(|&index| index < LEAF);
    index.expect("there are fewer than 2^31 lines and primitives")
}

/// A box in two registers.
#[derive(Clone, Copy)]
struct Bounds {
    lower: f32x4,
    upper: f32x4,
}

impl Bounds {
    fn empty() -> Self {
        Bounds {
            lower: f32x4::splat(f32::INFINITY),
            upper: f32x4::splat(f32::NEG_INFINITY),
        }
    }

    fn join(&mut self, other: Bounds) {
        self.lower = self.lower.fast_min(other.lower);
        self.upper = self.upper.fast_max(other.upper);
    }

    /// Returns the intersection of both boxes.
    fn overlap(self, other: Bounds) -> Bounds {
        Bounds {
            lower: self.lower.fast_max(other.lower),
            upper: self.upper.fast_min(other.upper),
        }
    }

    fn point(point: Vec3) -> Bounds {
        let point = f32x4::from(point.extend(0.0).to_array());
        Bounds {
            lower: point,
            upper: point,
        }
    }

    fn of(items: &[Item]) -> Bounds {
        let mut bounds = Bounds::empty();
        items.iter().for_each(|item| bounds.join(item.bounds));
        bounds
    }

    /// Returns the box of the items' centres, with all coordinates doubled.
    fn of_centers(items: &[Item]) -> Bounds {
        let mut centers = Bounds::empty();
        for item in items {
            let center = item.center();
            centers.join(Bounds {
                lower: center,
                upper: center,
            });
        }
        centers
    }

    fn is_empty(self) -> bool {
        let [x, y, z, _] = (self.upper - self.lower).to_array();
        x < 0.0 || y < 0.0 || z < 0.0
    }

    /// Returns half of the surface area.
    fn area(self) -> f32 {
        if self.is_empty() {
            return 0.0;
        }
        let [x, y, z, _] = (self.upper - self.lower).to_array();
        x * y + y * z + z * x
    }

    fn bbox(self) -> BBox {
        let corner = |lanes: f32x4| Vec3::from_slice(&lanes.to_array()[..3]);
        BBox::new(corner(self.lower), corner(self.upper))
    }
}

/// The bounds of a primitive or of a piece of one, for building.
#[derive(Clone, Copy)]
struct Item {
    bounds: Bounds,
    index: usize,
}

fn items(primitives: &[Primitive]) -> Vec<Item> {
    (0..).zip(primitives).map(Item::new).collect()
}

impl Item {
    fn new((index, primitive): (usize, &Primitive)) -> Self {
        let BBox { min, max } = primitive.bbox();
        let bounds = Bounds {
            lower: f32x4::from(min.extend(0.0).to_array()),
            upper: f32x4::from(max.extend(0.0).to_array()),
        };
        Item { bounds, index }
    }

    /// Returns the centre, with all coordinates doubled.
    fn center(&self) -> f32x4 {
        self.bounds.lower + self.bounds.upper
    }
}

/// The contents of one slice. In object splits, an item begins and ends in the slice of its centre.
#[derive(Clone, Copy)]
struct Bucket {
    bounds: Bounds,
    /// The number of items that begin in the slice.
    begin: usize,
    /// The number of items that end in the slice.
    end: usize,
}

impl Bucket {
    fn empty() -> Self {
        Bucket {
            bounds: Bounds::empty(),
            begin: 0,
            end: 0,
        }
    }

    fn join(&mut self, other: Bucket) {
        self.bounds.join(other.bounds);
        self.begin += other.begin;
        self.end += other.end;
    }
}

/// A builder of binary trees by binned SAH, over all three axes at once.
struct Builder {
    items: Vec<Item>,
    nodes: Vec<Node>,
    max_leaf_size: usize,
}

impl Builder {
    /// Builds the subtree over `items[start..end]`, which must not be empty, and returns its index.
    fn node(&mut self, start: usize, end: usize) -> usize {
        let items = &mut self.items[start..end];
        let bounds = Bounds::of(items);
        let index = self.nodes.len();
        self.nodes
            .push(Node::leaf(bounds.bbox(), start, end - start));
        if end - start > self.max_leaf_size {
            let centers = Bounds::of_centers(items);
            let middle = start + partition(items, centers);
            let l = self.node(start, middle);
            let r = self.node(middle, end);
            self.nodes[index] = Node::interior(bounds.bbox(), l, r);
        }
        index
    }
}

/// Partitions the items in place by the cheapest split, and returns the size of the left side.
/// Larger nodes are divided into more slices: there, evaluating the splits takes little time
/// relative to counting the items, and the choice of the split matters most.
fn partition(items: &mut [Item], centers: Bounds) -> usize {
    match items.len() {
        0..512 => partition_in::<16>(items, centers),
        512..2048 => partition_in::<32>(items, centers),
        2048.. => partition_in::<64>(items, centers),
    }
}

/// Partitions with `SLICES` slices of the centres along each axis.
fn partition_in<const SLICES: usize>(items: &mut [Item], centers: Bounds) -> usize {
    let extent = (centers.upper - centers.lower).to_array();
    // Along an axis with no extent, or almost none, all items are in the first slice.
    let scale = extent.map(|extent| SLICES as f32 / extent);
    let scale = f32x4::from(scale.map(|scale| if scale.is_finite() { scale } else { 0.0 }));
    let slices = |item: &Item| {
        let slices = (item.center() - centers.lower) * scale;
        let slices = slices.fast_trunc_int().to_array();
        slices.map(|slice| (slice as usize).min(SLICES - 1))
    };

    let mut buckets = [[Bucket::empty(); SLICES]; 3];
    for item in &*items {
        let slices = slices(item);
        for axis in 0..3 {
            let bucket = &mut buckets[axis][slices[axis]];
            bucket.bounds.join(item.bounds);
            bucket.begin += 1;
            bucket.end += 1;
        }
    }
    let splits = (0..3).filter(|&axis| scale.to_array()[axis] > 0.0);
    let splits = splits.map(|axis| (axis, cheapest_split(&buckets[axis])));
    let Some((axis, (slice, _))) = splits.min_by(|(_, a), (_, b)| a.1.total_cmp(&b.1)) else {
        return items.len() / 2; // All centres coincide.
    };

    let mut first = 0;
    for i in 0..items.len() {
        if slices(&items[i])[axis] < slice {
            items.swap(first, i);
            first += 1;
        }
    }
    first
}

/// Returns the slice before which to split, and the cost of that split.
fn cheapest_split<const SLICES: usize>(buckets: &[Bucket; SLICES]) -> (usize, f32) {
    let mut right_costs = [0.0; SLICES];
    let mut right = Bucket::empty();
    for i in (1..SLICES).rev() {
        right.join(buckets[i]);
        right_costs[i] = right.bounds.area() * right.end as f32;
    }
    let mut left = Bucket::empty();
    let mut best = (1, f32::INFINITY);
    for slice in 1..SLICES {
        left.join(buckets[slice - 1]);
        let cost = left.bounds.area() * left.begin as f32 + right_costs[slice];
        if cost < best.1 {
            best = (slice, cost);
        }
    }
    best
}

/// A builder of the tree for traversal. If the boxes of a node's two sides would overlap, the node
/// is split by a plane instead if that is cheaper. A triangle that crosses the plane then has a
/// piece on each side: Stich, Friedrich and Dietrich, "Spatial Splits in Bounding Volume
/// Hierarchies", 2009.
struct SpatialBuilder<'a> {
    primitives: &'a [Primitive],
    nodes: Vec<Node>,
    /// The indices of the primitives to which the leaves refer. A primitive that is split occurs
    /// several times.
    order: Vec<usize>,
    /// The number of additional pieces that spatial splits may still create.
    pieces_left: usize,
    /// The minimum overlap for a spatial split: half the surface area of the overlap must be larger
    /// than this.
    tolerated_overlap: f32,
}

/// A plane and the cost of a spatial split there.
struct SpatialSplit {
    axis: usize,
    plane: f32,
    cost: f32,
}

impl<'a> SpatialBuilder<'a> {
    /// The minimum number of items for a spatial split. In smaller nodes, spatial splits would take
    /// most of the build time and save nothing.
    const MIN_ITEMS: usize = 256;
    /// The number of slices along each axis.
    const SLICES: usize = 32;

    fn new(primitives: &'a [Primitive]) -> Self {
        SpatialBuilder {
            primitives,
            nodes: Vec::with_capacity(primitives.len()),
            order: Vec::with_capacity(primitives.len()),
            pieces_left: primitives.len(),
            tolerated_overlap: 1e-4 * Bounds::of(&items(primitives)).area(),
        }
    }

    /// Builds the subtree over these items, which must not be empty, and returns its index.
    fn node(&mut self, mut items: Vec<Item>) -> usize {
        let bounds = Bounds::of(&items);
        let index = self.nodes.len();
        let leaf = Node::leaf(bounds.bbox(), self.order.len(), items.len());
        self.nodes.push(leaf);
        if fits_in_pack(self.primitives, items.iter().map(|item| item.index)) {
            self.order.extend(items.iter().map(|item| item.index));
            return index;
        }

        let centers = Bounds::of_centers(&items);
        let middle = partition(&mut items, centers);
        let halves = self.cheaper_halves(&items, middle, bounds);
        let (l, r) = halves.unwrap_or_else(|| {
            let r = items.split_off(middle);
            (items, r)
        });
        let l = self.node(l);
        let r = self.node(r);
        self.nodes[index] = Node::interior(bounds.bbox(), l, r);
        index
    }

    /// Returns the two sides of the cheapest spatial split, if it is cheaper than splitting `items`
    /// at `middle`.
    fn cheaper_halves(
        &mut self,
        items: &[Item],
        middle: usize,
        bounds: Bounds,
    ) -> Option<(Vec<Item>, Vec<Item>)> {
        if items.len() < SpatialBuilder::MIN_ITEMS {
            return None;
        }
        let (l, r) = items.split_at(middle);
        let (l_bounds, r_bounds) = (Bounds::of(l), Bounds::of(r));
        if l_bounds.overlap(r_bounds).area() <= self.tolerated_overlap {
            return None;
        }
        let cost = l_bounds.area() * l.len() as f32 + r_bounds.area() * r.len() as f32;
        let split = self.cheapest_spatial_split(items, bounds)?;
        if split.cost >= cost {
            return None;
        }

        let (mut l, mut r) = (Vec::new(), Vec::new());
        for item in items {
            if item.bounds.upper.to_array()[split.axis] <= split.plane {
                l.push(*item);
            } else if item.bounds.lower.to_array()[split.axis] >= split.plane {
                r.push(*item);
            } else {
                let index = item.index;
                let [below, above] = self.pieces(item, split.axis, split.plane);
                l.extend(below.map(|bounds| Item { bounds, index }));
                r.extend(above.map(|bounds| Item { bounds, index }));
            }
        }
        let added = (l.len() + r.len()).saturating_sub(items.len());
        if l.len().max(r.len()) >= items.len() || added > self.pieces_left {
            return None;
        }
        self.pieces_left -= added;
        Some((l, r))
    }

    /// Returns the cheapest spatial split over all axes. The candidates are the planes between
    /// slices of equal width.
    fn cheapest_spatial_split(&self, items: &[Item], bounds: Bounds) -> Option<SpatialSplit> {
        let lower = bounds.lower.to_array();
        let width = ((bounds.upper - bounds.lower)
            * f32x4::splat(1.0 / SpatialBuilder::SLICES as f32))
        .to_array();
        let scale = f32x4::from(width.map(|width| if width > 0.0 { 1.0 / width } else { 0.0 }));
        let plane = |axis: usize, slice: usize| lower[axis] + width[axis] * slice as f32;
        let slices = |corner: f32x4| {
            let slices = ((corner - bounds.lower) * scale)
                .fast_trunc_int()
                .to_array();
            slices.map(|slice| (slice as usize).min(SpatialBuilder::SLICES - 1))
        };

        let mut buckets = [[Bucket::empty(); SpatialBuilder::SLICES]; 3];
        for item in items {
            let (first, last) = (slices(item.bounds.lower), slices(item.bounds.upper));
            for (axis, buckets) in buckets.iter_mut().enumerate() {
                let (first, last) = (first[axis], last[axis].max(first[axis]));
                buckets[first].begin += 1;
                buckets[last].end += 1;
                let mut rest = Some(*item);
                for (slice, bucket) in buckets[..last].iter_mut().enumerate().skip(first) {
                    let Some(item) = rest else { break };
                    let [below, above] = self.pieces(&item, axis, plane(axis, slice + 1));
                    below.iter().for_each(|below| bucket.bounds.join(*below));
                    rest = above.map(|bounds| Item { bounds, ..item });
                }
                rest.iter()
                    .for_each(|rest| buckets[last].bounds.join(rest.bounds));
            }
        }

        let axes = (0..3).filter(|&axis| plane(axis, 1) > lower[axis]);
        let splits = axes.map(|axis| {
            let (slice, cost) = cheapest_split(&buckets[axis]);
            let plane = plane(axis, slice);
            SpatialSplit { axis, plane, cost }
        });
        splits.min_by(|a, b| a.cost.total_cmp(&b.cost))
    }

    /// Returns the boxes of the parts of an item below and above a plane, or `None` for an empty
    /// part.
    fn pieces(&self, item: &Item, axis: usize, plane: f32) -> [Option<Bounds>; 2] {
        let (mut upper, mut lower) = (item.bounds.upper.to_array(), item.bounds.lower.to_array());
        upper[axis] = upper[axis].min(plane);
        lower[axis] = lower[axis].max(plane);
        let below = Bounds {
            upper: f32x4::from(upper),
            ..item.bounds
        };
        let above = Bounds {
            lower: f32x4::from(lower),
            ..item.bounds
        };
        let Primitive::Triangle(Triangle { p0, p1, p2, .. }) = &self.primitives[item.index] else {
            return [Some(below), Some(above)];
        };

        let [p0, p1, p2] = [p0.position, p1.position, p2.position];
        let (mut low, mut high) = (Bounds::empty(), Bounds::empty());
        for (a, b) in [(p0, p1), (p1, p2), (p2, p0)] {
            if a[axis] <= plane {
                low.join(Bounds::point(a));
            }
            if a[axis] >= plane {
                high.join(Bounds::point(a));
            }
            if (a[axis] < plane && plane < b[axis]) || (b[axis] < plane && plane < a[axis]) {
                let at = a + (b - a) * ((plane - a[axis]) / (b[axis] - a[axis]));
                // Enlarges the box, so that it contains the exact point despite rounding.
                let slack = 4e-7 * a.abs().max(b.abs());
                for at in [at - slack, at + slack] {
                    low.join(Bounds::point(at));
                    high.join(Bounds::point(at));
                }
            }
        }
        [below.overlap(low), above.overlap(high)].map(|piece| (!piece.is_empty()).then_some(piece))
    }
}
