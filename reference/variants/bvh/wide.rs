//! Eight boxes at a time, and four triangles: the binary tree, built or handed in, is folded into
//! nodes of eight children, and the triangles of each leaf stand side by side in packs of four. After
//! Wald, Benthin and Boulos, "Getting Rid of Packets", 2008, and Embree's `BVH8<Triangle4>`.
//!
//! Three things that look like details are half of the speed. What is still to be visited is kept as
//! one integer, the entry above the child, so that the nearer of two is found without a branch that the
//! processor would have to guess. Where a ray enters a box is computed from the plane that it meets
//! first, known from the sign of its direction: a minimum and a maximum less for each axis. And the
//! memory of all children that are hit is asked for at once, not when each has its turn.

use glam::Vec3;
use protocol::{Ray, Trace};
use wide::{f32x4, f32x8};

use crate::bbox::BBox;
use crate::primitive::Primitive;
use crate::triangle::Triangle;

/// One box of the tree. A leaf if and only if `l == r`.
#[derive(Clone, Copy, Debug)]
pub struct Node {
    /// Holds everything below this node.
    pub bbox: BBox,
    /// In a leaf, the place of its first primitive; elsewhere not read.
    pub start: usize,
    /// In a leaf, the number of its primitives; elsewhere not read.
    pub size: usize,
    /// In an interior node, the place of one child in `Bvh::nodes`.
    pub l: usize,
    /// In an interior node, the place of the other.
    pub r: usize,
}

impl Node {
    /// A node that holds primitives.
    pub fn leaf(bbox: BBox, start: usize, size: usize) -> Self {
        Node {
            bbox,
            start,
            size,
            l: 0,
            r: 0,
        }
    }

    /// A node that holds two others.
    pub fn interior(bbox: BBox, l: usize, r: usize) -> Self {
        Node {
            bbox,
            start: 0,
            size: 0,
            l,
            r,
        }
    }

    /// Whether the node holds primitives.
    pub fn is_leaf(&self) -> bool {
        self.l == self.r
    }
}

/// A bounding volume hierarchy, twice: as a binary tree, and folded.
#[derive(Clone, Debug)]
pub struct Bvh {
    /// All primitives; those of one leaf stand side by side.
    pub primitives: Vec<Primitive>,
    /// All nodes, in any order. None at all if there is nothing to hold.
    pub nodes: Vec<Node>,
    /// The place of the node where everything starts: need be neither first nor last.
    pub root: usize,
    /// The folded tree; its root is the first. None at all if there is nothing to hold.
    eights: Vec<Eight>,
    packs: Vec<Pack>,
}

impl Bvh {
    /// A tree from its parts.
    pub fn from_nodes(primitives: Vec<Primitive>, nodes: Vec<Node>, root: usize) -> Self {
        let mut folding = Folding {
            primitives: &primitives,
            nodes: &nodes,
            eights: Vec::with_capacity(nodes.len() / 6),
            packs: Vec::with_capacity(nodes.len() / 2 + 1),
        };
        if root < nodes.len() {
            folding.eight(root);
        }
        let (eights, packs) = (folding.eights, folding.packs);
        Bvh {
            primitives,
            nodes,
            root,
            eights,
            packs,
        }
    }

    /// Builds the tree by the surface area heuristic.
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        let mut builder = Builder {
            items: (0..).zip(&primitives).map(Item::new).collect(),
            nodes: Vec::with_capacity(primitives.len()),
            max_leaf_size: max_leaf_size.max(1),
        };
        if !primitives.is_empty() {
            builder.node(0, primitives.len());
        }
        let ordered = builder.items.iter().map(|item| primitives[item.place]);
        Bvh::from_nodes(ordered.collect(), builder.nodes, 0)
    }

    /// The closest of all the places where the ray meets a primitive within `ray.range`.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        self.eights.first()?;
        let mut closest = Closest {
            distance: ray.range.max,
            place: NOWHERE,
            u: 0.0,
            v: 0.0,
        };
        self.walk(0, &Beam::new(ray), ray, &mut closest);
        match self.primitives.get(closest.place as usize)? {
            Primitive::Triangle(triangle) => Some(closest.trace(ray, triangle)),
            Primitive::Sphere(sphere) => sphere.hit(ray),
        }
    }

    /// Looks for a hit below a child that the ray is known to meet.
    fn walk(&self, root: u32, beam: &Beam, ray: &Ray, closest: &mut Closest) {
        let mut open = Open::new();
        let mut child = root;
        loop {
            if child & LEAF == 0 {
                let eight = &self.eights[child as usize];
                let (entries, mut mask) = eight.entries(beam, closest.distance);
                if mask != 0 {
                    let entries = entries.to_array();
                    let visit = |mask: &mut u32| {
                        let lane = mask.trailing_zeros() as usize & 7;
                        *mask &= *mask - 1;
                        let child = eight.children[lane];
                        self.fetch(child);
                        Visit::new(entries[lane], child)
                    };
                    let mut first = visit(&mut mask);
                    if mask == 0 {
                        child = first.child();
                        continue;
                    }
                    if open.is_full() {
                        // A tree so deep is rare: what does not fit has calls of its own.
                        let mut here = Open::new();
                        here.insert(0, first);
                        while mask != 0 {
                            here.insert(0, visit(&mut mask));
                        }
                        while let Some(next) = here.pop() {
                            if next.entry() <= closest.distance {
                                self.walk(next.child(), beam, ray, closest);
                            }
                        }
                    } else {
                        let base = open.len;
                        while mask != 0 {
                            let other = visit(&mut mask);
                            open.insert(base, first.max(other));
                            first = first.min(other);
                        }
                        child = first.child();
                        continue;
                    }
                }
            } else {
                self.leaf(child & !LEAF, beam, ray, closest);
            }
            child = loop {
                match open.pop() {
                    None => return,
                    Some(next) if next.entry() <= closest.distance => break next.child(),
                    Some(_) => {}
                }
            };
        }
    }

    /// Asks for the memory of a child, which will be visited, but perhaps not at once.
    fn fetch(&self, child: u32) {
        if child & LEAF == 0 {
            let eight = &self.eights[child as usize];
            eight.planes.iter().for_each(fetch);
            fetch(&eight.children);
        } else {
            let four = &self.packs[(child & !LEAF) as usize].four;
            // A line of memory after the other.
            fetch(&four.p0);
            fetch(&four.e1[1]);
            fetch(&four.e2[2]);
        }
    }

    fn leaf(&self, start: u32, beam: &Beam, ray: &Ray, closest: &mut Closest) {
        for pack in &self.packs[start as usize..] {
            if let Some(place) = pack.four.hit(beam, closest) {
                // Its normals and texture coordinates will be read, unless another one is closer.
                fetch(&self.primitives[place as usize]);
            }
            if let Some(place) = pack.sphere {
                let rest = ray.within(ray.range.min, closest.distance);
                if let Some(trace) = self.primitives[place as usize].hit(&rest) {
                    closest.distance = trace.distance;
                    closest.place = place;
                }
            }
            if pack.is_last {
                return;
            }
        }
    }
}

/// Asks for the line of memory where something begins, if the processor can be asked.
fn fetch<T>(what: &T) {
    #[cfg(target_feature = "sse")]
    safe_arch::prefetch_t0(what);
    #[cfg(not(target_feature = "sse"))]
    let _ = what;
}

/// No primitive has this place.
const NOWHERE: u32 = u32::MAX;

/// The closest hit so far.
struct Closest {
    distance: f32,
    /// The primitive's place, or `NOWHERE`.
    place: u32,
    /// The weights of a triangle's corners.
    u: f32,
    v: f32,
}

impl Closest {
    fn trace(&self, ray: &Ray, triangle: &Triangle) -> Trace {
        let Triangle {
            p0,
            p1,
            p2,
            material,
        } = triangle;
        let (u, v) = (self.u, self.v);
        let w = 1.0 - u - v;
        Trace {
            distance: self.distance,
            position: ray.at(self.distance),
            normal: (w * p0.normal + u * p1.normal + v * p2.normal).normalize(),
            uv: w * p0.uv + u * p1.uv + v * p2.uv,
            origin: ray.origin,
            material: *material,
        }
    }
}

/// A child that is to be visited, and where the ray enters its box.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Visit(u64);

impl Visit {
    /// The bits of numbers that are not negative are ordered as the numbers are.
    fn new(entry: f32, child: u32) -> Self {
        Visit(u64::from(entry.to_bits()) << 32 | u64::from(child))
    }

    fn entry(self) -> f32 {
        f32::from_bits((self.0 >> 32) as u32)
    }

    fn child(self) -> u32 {
        self.0 as u32
    }
}

/// What is still to be visited, the nearest last.
struct Open {
    visits: [Visit; Open::SIZE],
    len: usize,
}

impl Open {
    /// A power of two, so that a place in it is found by a mask.
    const SIZE: usize = 64;

    fn new() -> Self {
        Open {
            visits: [Visit(0); Open::SIZE],
            len: 0,
        }
    }

    /// Whether the children of one more node might not fit.
    fn is_full(&self) -> bool {
        self.len > Open::SIZE - 8
    }

    /// Puts it in its place among those from `base` on.
    fn insert(&mut self, base: usize, visit: Visit) {
        let mut place = self.len;
        while place > base && self.visits[(place - 1) % Open::SIZE] < visit {
            self.visits[place % Open::SIZE] = self.visits[(place - 1) % Open::SIZE];
            place -= 1;
        }
        self.visits[place % Open::SIZE] = visit;
        self.len += 1;
    }

    fn pop(&mut self) -> Option<Visit> {
        self.len = self.len.checked_sub(1)?;
        Some(self.visits[self.len % Open::SIZE])
    }
}

/// A ray, in all lanes.
struct Beam {
    origin: [f32x8; 3],
    inverse: [f32x8; 3],
    /// Along each axis, whether the ray goes down.
    down: [bool; 3],
    min: f32x8,
    from: [f32x4; 3],
    dir: [f32x4; 3],
    min_of_four: f32x4,
}

impl Beam {
    /// The inverse of nothing would be infinite, and 0 · ∞ no number: this is as good as infinite.
    const STEEPEST: f32 = 1e-30;

    fn new(ray: &Ray) -> Self {
        let origin = ray.origin.to_array();
        let dir = ray.dir.to_array();
        let inverse = dir.map(|d| 1.0 / d.abs().max(Beam::STEEPEST).copysign(d));
        Beam {
            origin: origin.map(f32x8::splat),
            inverse: inverse.map(f32x8::splat),
            down: inverse.map(|inverse| inverse < 0.0),
            min: f32x8::splat(ray.range.min),
            from: origin.map(f32x4::splat),
            dir: dir.map(f32x4::splat),
            min_of_four: f32x4::splat(ray.range.min),
        }
    }
}

/// Up to eight children and their boxes. A lane without a child has a box that no ray meets.
#[derive(Clone, Debug)]
#[repr(align(64))]
struct Eight {
    /// Along each axis, the lower planes of all boxes, and the upper ones.
    planes: [[f32x8; 2]; 3],
    /// Places in `eights`, or with `LEAF` in `packs`.
    children: [u32; 8],
}

const LEAF: u32 = 1 << 31;

impl Eight {
    /// More than the times when a ray leaves are wrong by rounding. Pharr, Jakob and Humphreys,
    /// Physically Based Rendering, 4th edition, section 6.1.2.
    const WIDER: f32 = 1.000_000_4;

    /// When the ray enters the boxes, and a bit for each that it does enter, up to `max`.
    fn entries(&self, beam: &Beam, max: f32) -> (f32x8, u32) {
        let time = |axis: usize, upper: bool| {
            (self.planes[axis][usize::from(upper)] - beam.origin[axis]) * beam.inverse[axis]
        };
        let [enter_x, enter_y, enter_z] = [0, 1, 2].map(|axis| time(axis, beam.down[axis]));
        let [leave_x, leave_y, leave_z] = [0, 1, 2].map(|axis| time(axis, !beam.down[axis]));
        let enter = enter_x
            .fast_max(enter_y)
            .fast_max(enter_z.fast_max(beam.min));
        let leave = leave_x.fast_min(leave_y).fast_min(leave_z) * f32x8::splat(Eight::WIDER);
        let leave = leave.fast_min(f32x8::splat(max));
        (enter, enter.simd_le(leave).to_bitmask())
    }
}

/// A piece of a leaf: four triangles and a sphere, or less.
#[derive(Clone, Debug)]
struct Pack {
    four: Four,
    /// The sphere's place in `primitives`.
    sphere: Option<u32>,
    /// The leaf goes on in the next pack, unless this is its last.
    is_last: bool,
}

/// Four triangles. A lane without one has edges of length 0, which no ray meets.
#[derive(Clone, Debug)]
struct Four {
    p0: [f32x4; 3],
    e1: [f32x4; 3],
    e2: [f32x4; 3],
    /// Places in `primitives`.
    places: [u32; 4],
}

fn cross(a: &[f32x4; 3], b: &[f32x4; 3]) -> [f32x4; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot(a: &[f32x4; 3], b: &[f32x4; 3]) -> f32x4 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl Four {
    fn new(triangles: &[(u32, &Triangle)]) -> Self {
        let lanes = |of: fn(&Triangle) -> Vec3| {
            [0, 1, 2].map(|axis| {
                let mut lanes = [0.0; 4];
                for (lane, (_, triangle)) in lanes.iter_mut().zip(triangles) {
                    *lane = of(triangle)[axis];
                }
                f32x4::from(lanes)
            })
        };
        let mut places = [NOWHERE; 4];
        for (place, (of, _)) in places.iter_mut().zip(triangles) {
            *place = *of;
        }
        Four {
            p0: lanes(|triangle| triangle.p0.position),
            e1: lanes(|triangle| triangle.p1.position - triangle.p0.position),
            e2: lanes(|triangle| triangle.p2.position - triangle.p0.position),
            places,
        }
    }

    /// Möller and Trumbore's test, of four triangles. Returns the place of the closest, if any is
    /// closer than what was hit before.
    fn hit(&self, beam: &Beam, closest: &mut Closest) -> Option<u32> {
        let s = [0, 1, 2].map(|axis| beam.from[axis] - self.p0[axis]);
        let p = cross(&beam.dir, &self.e2);
        let q = cross(&s, &self.e1);
        let inverse = f32x4::ONE / dot(&p, &self.e1);
        let u = dot(&p, &s) * inverse;
        let v = dot(&q, &beam.dir) * inverse;
        let t = dot(&q, &self.e2) * inverse;
        // Whatever is no number is neither more nor less, and so no hit.
        let inside = u.simd_ge(f32x4::ZERO) & v.simd_ge(f32x4::ZERO) & (u + v).simd_le(f32x4::ONE);
        let ahead = t.simd_ge(beam.min_of_four) & t.simd_le(f32x4::splat(closest.distance));
        let mut mask = (inside & ahead).to_bitmask();
        if mask == 0 {
            return None;
        }
        while mask != 0 {
            let lane = mask.trailing_zeros() as usize & 3;
            mask &= mask - 1;
            let distance = t.as_array()[lane];
            if distance <= closest.distance {
                *closest = Closest {
                    distance,
                    place: self.places[lane],
                    u: u.as_array()[lane],
                    v: v.as_array()[lane],
                };
            }
        }
        Some(closest.place)
    }
}

/// Makes the wide tree of the binary one.
struct Folding<'a> {
    primitives: &'a [Primitive],
    nodes: &'a [Node],
    eights: Vec<Eight>,
    packs: Vec<Pack>,
}

impl Folding<'_> {
    /// Folds what is below a node; returns where it is.
    fn eight(&mut self, root: usize) -> u32 {
        let mut held = vec![root];
        // The widest is opened first: of all it is the likeliest to be entered.
        while held.len() < 8 {
            let area = |place: usize| self.nodes[place].bbox.surface_area();
            let interior = (0..held.len()).filter(|&i| !self.nodes[held[i]].is_leaf());
            let widest = interior.max_by(|&a, &b| area(held[a]).total_cmp(&area(held[b])));
            let Some(widest) = widest else {
                break;
            };
            let node = self.nodes[held[widest]];
            held[widest] = node.l;
            held.push(node.r);
        }

        let mut planes = [[[f32::INFINITY; 8], [f32::NEG_INFINITY; 8]]; 3];
        for (lane, &child) in held.iter().enumerate() {
            let bbox = self.nodes[child].bbox;
            for (axis, [lower, upper]) in planes.iter_mut().enumerate() {
                lower[lane] = bbox.min[axis];
                upper[lane] = bbox.max[axis];
            }
        }
        let place = self.eights.len();
        self.eights.push(Eight {
            planes: planes.map(|both| both.map(f32x8::from)),
            children: [0; 8],
        });
        for (lane, &child) in held.iter().enumerate() {
            let node = self.nodes[child];
            let folded = if node.is_leaf() {
                self.leaf(&node)
            } else {
                self.eight(child)
            };
            self.eights[place].children[lane] = folded;
        }
        small(place)
    }

    fn leaf(&mut self, node: &Node) -> u32 {
        let start = self.packs.len();
        let (mut triangles, mut spheres) = (Vec::new(), Vec::new());
        for place in node.start..node.start + node.size {
            match &self.primitives[place] {
                Primitive::Triangle(triangle) => triangles.push((small(place), triangle)),
                Primitive::Sphere(_) => spheres.push(small(place)),
            }
        }
        // One at least, so that there is an end also of a leaf without anything.
        let packs = triangles.len().div_ceil(4).max(spheres.len()).max(1);
        for i in 0..packs {
            self.packs.push(Pack {
                four: Four::new(triangles.chunks(4).nth(i).unwrap_or_default()),
                sphere: spheres.get(i).copied(),
                is_last: i + 1 == packs,
            });
        }
        LEAF | small(start)
    }
}

/// A place, in half of the space.
fn small(place: usize) -> u32 {
    u32::try_from(place).expect("memory ends before the numbers do")
}

/// A box in two registers.
#[derive(Clone, Copy)]
struct Bounds {
    lower: f32x4,
    upper: f32x4,
}

impl Bounds {
    fn nothing() -> Self {
        Bounds {
            lower: f32x4::splat(f32::INFINITY),
            upper: f32x4::splat(f32::NEG_INFINITY),
        }
    }

    fn join(&mut self, other: Bounds) {
        self.lower = self.lower.fast_min(other.lower);
        self.upper = self.upper.fast_max(other.upper);
    }

    fn bbox(self) -> BBox {
        let corner = |lanes: f32x4| Vec3::from_slice(&lanes.to_array()[..3]);
        BBox::new(corner(self.lower), corner(self.upper))
    }
}

/// What building needs to know of a primitive.
#[derive(Clone, Copy)]
struct Item {
    bounds: Bounds,
    place: usize,
}

impl Item {
    fn new((place, primitive): (usize, &Primitive)) -> Self {
        let BBox { min, max } = primitive.bbox();
        let bounds = Bounds {
            lower: f32x4::from(min.extend(0.0).to_array()),
            upper: f32x4::from(max.extend(0.0).to_array()),
        };
        Item { bounds, place }
    }

    /// Twice the center.
    fn center(&self) -> f32x4 {
        self.bounds.lower + self.bounds.upper
    }
}

/// The items whose centers lie in one slice.
#[derive(Clone, Copy)]
struct Bucket {
    bounds: Bounds,
    count: usize,
}

impl Bucket {
    fn empty() -> Self {
        Bucket {
            bounds: Bounds::nothing(),
            count: 0,
        }
    }

    fn join(&mut self, other: Bucket) {
        self.bounds.join(other.bounds);
        self.count += other.count;
    }

    fn cost(&self) -> f32 {
        if self.count == 0 {
            return 0.0;
        }
        let [x, y, z, _] = (self.bounds.upper - self.bounds.lower).to_array();
        (x * y + y * z + z * x) * self.count as f32
    }
}

/// Binned SAH over all three axes at once.
struct Builder {
    items: Vec<Item>,
    nodes: Vec<Node>,
    max_leaf_size: usize,
}

/// In how many slices the centers are counted, along each axis.
const SLICES: usize = 16;

impl Builder {
    /// Builds the node over `items[start..end]`, which are not none; returns its place.
    fn node(&mut self, start: usize, end: usize) -> usize {
        let mut bounds = Bounds::nothing();
        let mut centers = Bounds::nothing();
        for item in &self.items[start..end] {
            let center = item.center();
            bounds.join(item.bounds);
            centers.join(Bounds {
                lower: center,
                upper: center,
            });
        }

        let place = self.nodes.len();
        self.nodes
            .push(Node::leaf(bounds.bbox(), start, end - start));
        if end - start > self.max_leaf_size {
            let middle = start + partition(&mut self.items[start..end], centers);
            let l = self.node(start, middle);
            let r = self.node(middle, end);
            self.nodes[place] = Node::interior(bounds.bbox(), l, r);
        }
        place
    }
}

/// Reorders the items by the cheapest split; returns how many come first.
fn partition(items: &mut [Item], centers: Bounds) -> usize {
    let extent = (centers.upper - centers.lower).to_array();
    // Along an axis without extent, or with next to none, all are in the first slice.
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
            bucket.count += 1;
        }
    }
    let splits = (0..3).filter(|&axis| scale.to_array()[axis] > 0.0);
    let splits = splits.map(|axis| (axis, cheapest(&buckets[axis])));
    let Some((axis, (slice, _))) = splits.min_by(|(_, a), (_, b)| a.1.total_cmp(&b.1)) else {
        return items.len() / 2; // All centers coincide.
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

/// Before which of the slices to split, and the cost of that.
fn cheapest(buckets: &[Bucket; SLICES]) -> (usize, f32) {
    let mut right_costs = [0.0; SLICES];
    let mut right = Bucket::empty();
    for i in (1..SLICES).rev() {
        right.join(buckets[i]);
        right_costs[i] = right.cost();
    }
    let mut left = Bucket::empty();
    let mut best = (1, f32::INFINITY);
    for slice in 1..SLICES {
        left.join(buckets[slice - 1]);
        let cost = left.cost() + right_costs[slice];
        if cost < best.1 {
            best = (slice, cost);
        }
    }
    best
}
