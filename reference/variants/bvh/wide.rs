//! Eight boxes at a time, and eight triangles: the binary tree, built or handed in, is folded into
//! nodes of eight children, and the triangles of each leaf stand side by side in a pack. After Wald,
//! Benthin and Boulos, "Getting Rid of Packets", 2008, and Embree's `BVH8<Triangle4>`.
//!
//! What takes the time is not to compute, but to wait: for memory, and for a branch that the processor
//! has guessed wrongly. So nodes and packs stand in one piece of memory, the packs of a node behind it,
//! and all children that are hit are asked for at once, with what stands behind them. A pack is small,
//! because triangles that are neighbours share their corners. What is still to be visited is kept as one
//! integer, the entry above the child, so that the nearer of two is found without a branch. Where a ray
//! enters a box is computed from the plane that it meets first, known from the sign of its direction.
//! What a `Trace` says of a triangle, besides where it is, stands in one line of memory; of a facet it
//! follows from the corners, and nothing more is read. And the tree that is walked is another than the
//! one that is shown: it may hold a large triangle in pieces.

use glam::{Vec2, Vec3};
use protocol::{Interval, Ray, Shape, Trace};
use wide::bytemuck::cast;
use wide::{f32x4, f32x8, u32x8};

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
    /// The folded tree, its root first. None at all if there is nothing to hold.
    lines: Vec<Line>,
    /// Of each triangle that is no facet.
    surfaces: Vec<Surface>,
}

impl Bvh {
    /// A tree from its parts.
    pub fn from_nodes(primitives: Vec<Primitive>, nodes: Vec<Node>, root: usize) -> Self {
        let order: Vec<usize> = (0..primitives.len()).collect();
        let (lines, surfaces) = if root < nodes.len() {
            Folding::new(&primitives, nodes.clone(), order).all(root)
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

    /// Builds the tree by the surface area heuristic; and for the walk another one, of pieces.
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
        let ordered = builder.items.iter().map(|item| primitives[item.place]);
        let primitives: Vec<Primitive> = ordered.collect();
        let mut cutter = Cutter::new(&primitives);
        cutter.node(items(&primitives));
        let Cutter { nodes, order, .. } = cutter;
        let (lines, surfaces) = Folding::new(&primitives, nodes, order).all(0);
        Bvh {
            primitives,
            nodes: builder.nodes,
            root: 0,
            lines,
            surfaces,
        }
    }

    /// The closest of all the places where the ray meets a primitive within `ray.range`.
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest = Closest {
            distance: ray.range.max,
            met: Met::Nothing,
        };
        if !self.lines.is_empty() {
            self.walk(&Beam::new(ray), ray, &mut closest);
        }
        match closest.met {
            Met::Nothing => None,
            Met::Sphere { place } => self.primitives[place as usize].hit(ray),
            Met::Triangle { pack, lane, u, v } => {
                let pack = Pack::at(&self.lines, pack);
                let (normal, uv, material) = match pack.surface(lane) {
                    Seen::Facet { normal, material } => (normal, Vec2::new(u, v), material),
                    Seen::Surface { place } => self.surfaces[place as usize].between(u, v),
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

    fn walk(&self, beam: &Beam, ray: &Ray, closest: &mut Closest) {
        let mut open = Open::new();
        let mut child = 0;
        loop {
            if child & LEAF == 0 {
                let eight = Eight::at(&self.lines, child);
                let (entries, mut mask) = eight.entries(beam, closest.distance);
                if mask != 0 {
                    let entries = entries.to_array();
                    let visit = |mask: &mut u32| {
                        let lane = mask.trailing_zeros() as usize & 7;
                        *mask &= *mask - 1;
                        let child = eight.child(lane);
                        self.fetch(child);
                        Visit::new(entries[lane], child)
                    };
                    let mut first = visit(&mut mask);
                    if mask != 0 {
                        let base = open.room_for_eight();
                        while mask != 0 {
                            let other = visit(&mut mask);
                            open.insert(base, first.max(other));
                            first = first.min(other);
                        }
                    }
                    child = first.child();
                    continue;
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

    /// Asks for the memory of a child, which will be visited, but perhaps not at once, and for what stands
    /// behind it, which may be visited soon: behind a node its first packs, behind a pack its neighbours.
    fn fetch(&self, child: u32) {
        const LINES: usize = Eight::LINES + 2 * Pack::LINES;
        let start = (child & !LEAF) as usize;
        if let Some(lines) = self.lines.get(start..start + LINES) {
            lines.iter().for_each(fetch);
        }
    }

    fn leaf(&self, start: u32, beam: &Beam, ray: &Ray, closest: &mut Closest) {
        let pack = Pack::at(&self.lines, start);
        if pack.is(Pack::OF_SPHERES) {
            for place in pack.spheres() {
                let rest = ray.within(ray.range.min, closest.distance);
                if let Some(trace) = self.primitives[place as usize].hit(&rest) {
                    closest.distance = trace.distance;
                    closest.met = Met::Sphere { place };
                }
            }
        } else if let Some(hit) = pack.hit(beam, closest.distance) {
            closest.distance = hit.distance;
            closest.met = Met::Triangle {
                pack: start,
                lane: hit.lane,
                u: hit.u,
                v: hit.v,
            };
            if let Some(place) = pack.place_of_surface(hit.lane) {
                // It will be read, unless another one is closer.
                fetch(&self.surfaces[place as usize]);
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

/// The closest hit so far.
struct Closest {
    distance: f32,
    met: Met,
}

/// What the closest hit is a hit of.
enum Met {
    Nothing,
    /// The primitive in this place.
    Sphere {
        place: u32,
    },
    /// By where its pack starts, and with the weights of two corners.
    Triangle {
        pack: u32,
        lane: usize,
        u: f32,
        v: f32,
    },
}

/// What a trace says of a triangle, in one line of memory.
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

    /// Its normal, texture coordinates and material where two corners have these weights.
    fn between(&self, u: f32, v: f32) -> (Vec3, Vec2, u32) {
        let w = 1.0 - u - v;
        let [n0, n1, n2] = self.normals;
        let [uv0, uv1, uv2] = self.uvs;
        let normal = (w * n0 + u * n1 + v * n2).normalize();
        (normal, w * uv0 + u * uv1 + v * uv2, self.material)
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
    /// What was put in before those, and did not fit: a tree so deep is rare.
    older: Vec<Visit>,
}

impl Open {
    /// A power of two, so that a place in it is found by a mask.
    const SIZE: usize = 32;

    fn new() -> Self {
        Open {
            visits: [Visit(0); Open::SIZE],
            len: 0,
            older: Vec::new(),
        }
    }

    /// Sees to it that the children of one more node fit; returns where the first of them goes.
    fn room_for_eight(&mut self) -> usize {
        if self.len > Open::SIZE - 8 {
            self.older.extend_from_slice(&self.visits[..self.len]);
            self.len = 0;
        }
        self.len
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
        match self.len.checked_sub(1) {
            Some(len) => {
                self.len = len;
                Some(self.visits[len % Open::SIZE])
            }
            None => self.older.pop(),
        }
    }
}

/// A ray, in all lanes.
struct Beam {
    origin: [f32x8; 3],
    dir: [f32x8; 3],
    inverse: [f32x8; 3],
    /// The inverse for when a ray leaves, which is a little later.
    later: [f32x8; 3],
    /// Along each axis, whether the ray goes down.
    down: [bool; 3],
    min: f32x8,
}

impl Beam {
    /// The inverse of nothing would be infinite, and 0 · ∞ no number: this is as good as infinite.
    const STEEPEST: f32 = 1e-30;

    /// More than the times when a ray leaves are wrong by rounding. Pharr, Jakob and Humphreys,
    /// Physically Based Rendering, 4th edition, section 6.1.2.
    const LATER: f32 = 1.000_000_4;

    fn new(ray: &Ray) -> Self {
        let dir = ray.dir.to_array();
        let inverse = dir.map(|d| 1.0 / d.abs().max(Beam::STEEPEST).copysign(d));
        Beam {
            origin: ray.origin.to_array().map(f32x8::splat),
            dir: dir.map(f32x8::splat),
            inverse: inverse.map(f32x8::splat),
            later: inverse.map(|inverse| f32x8::splat(inverse * Beam::LATER)),
            down: inverse.map(|inverse| inverse < 0.0),
            min: f32x8::splat(ray.range.min),
        }
    }
}

/// As much memory as comes at a time.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Line([f32x8; 2]);

/// In the number of a child's first line: it is a pack, and no node.
const LEAF: u32 = 1 << 31;

/// Up to eight children and their boxes: for each axis a line with the lower planes of all boxes and
/// the upper ones, and one with the children. A lane without a child has a box that no ray meets.
struct Eight<'a>(&'a [Line; Eight::LINES]);

impl<'a> Eight<'a> {
    const LINES: usize = 4;

    fn at(lines: &'a [Line], start: u32) -> Self {
        Eight(lines_at(lines, start))
    }

    fn child(&self, lane: usize) -> u32 {
        let Line([children, _]) = &self.0[3];
        children.as_array()[lane].to_bits()
    }

    /// When the ray enters the boxes, and a bit for each that it does enter, up to `max`.
    fn entries(&self, beam: &Beam, max: f32) -> (f32x8, u32) {
        let from = |axis: usize, upper: bool| {
            let Line(planes) = &self.0[axis];
            planes[usize::from(upper)] - beam.origin[axis]
        };
        let enter = [0, 1, 2].map(|axis| from(axis, beam.down[axis]) * beam.inverse[axis]);
        let leave = [0, 1, 2].map(|axis| from(axis, !beam.down[axis]) * beam.later[axis]);
        // In pairs: neither waits for the other.
        let enter = (enter[0].fast_max(enter[1])).fast_max(enter[2].fast_max(beam.min));
        let leave = (leave[0].fast_min(leave[1])).fast_min(leave[2].fast_min(f32x8::splat(max)));
        (enter, enter.simd_le(leave).to_bitmask())
    }
}

/// A leaf: up to eight triangles, of neighbours, so that they have at most eight corners among them.
/// Where those are stands in three registers, and the fourth has a word for each triangle, with the
/// numbers of its corners. A lane without a triangle has one corner three times, which no ray meets.
/// Or the places of up to eight spheres.
struct Pack<'a>(&'a [Line; Pack::LINES]);

/// Three times three bits say which corners are a triangle's; of those above, all but one are for more.
#[derive(Clone, Copy, Default)]
struct Word(u32);

impl Word {
    /// What is more must be less than this.
    const MORE: u32 = 1 << 22;
    const FLAG: u32 = 1 << 31;

    fn new([a, b, c]: [u32; 3]) -> Self {
        Word(a | b << 3 | c << 6)
    }

    fn corners(self) -> [usize; 3] {
        [0, 3, 6].map(|shift| (self.0 >> shift & 7) as usize)
    }

    fn add(&mut self, more: u32) {
        self.0 |= more << 9;
    }

    fn more(self) -> u32 {
        self.0 >> 9 & (Word::MORE - 1)
    }

    fn flag(&mut self) {
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

    /// The word with the flag that says that a pack holds spheres.
    const OF_SPHERES: usize = 0;
    /// The same for triangles of which not all are facets: what is more in the first two words is the
    /// place of the first one's surface. That of a facet is its material.
    const OF_SURFACES: usize = 1;

    fn at(lines: &'a [Line], start: u32) -> Self {
        Pack(lines_at(lines, start))
    }

    fn lines(registers: [[u32; 8]; 4]) -> [Line; Pack::LINES] {
        let [x, y, z, words] = registers.map(cast);
        [Line([x, y]), Line([z, words])]
    }

    fn word(&self, lane: usize) -> Word {
        let Line([_, words]) = &self.0[1];
        Word(words.as_array()[lane].to_bits())
    }

    fn is(&self, flag: usize) -> bool {
        self.word(flag).is_flagged()
    }

    /// The places of its spheres.
    fn spheres(&self) -> impl Iterator<Item = u32> {
        let Line([places, _]) = &self.0[0];
        let places = places.to_array().map(f32::to_bits);
        places.into_iter().take_while(|&place| place != NOWHERE)
    }

    /// Where more is said of the triangle, unless it is a facet.
    fn place_of_surface(&self, lane: usize) -> Option<u32> {
        let first = || self.word(0).more() + self.word(1).more() * Word::MORE;
        self.is(Pack::OF_SURFACES).then(|| first() + lane as u32)
    }

    fn surface(&self, lane: usize) -> Seen {
        if let Some(place) = self.place_of_surface(lane) {
            return Seen::Surface { place };
        }
        let word = self.word(lane);
        let [Line([x, y]), Line([z, _])] = self.0;
        let [p0, p1, p2] = word
            .corners()
            .map(|corner| Vec3::from([x, y, z].map(|lanes| lanes.as_array()[corner])));
        Seen::Facet {
            normal: (p1 - p0).cross(p2 - p0).normalize(),
            material: word.more(),
        }
    }

    /// Of each triangle the three corners.
    fn corners(&self) -> [[f32x8; 3]; 3] {
        let [Line([x, y]), Line([z, words])] = *self.0;
        let [x, y, z, words]: [u32x8; 4] = [x, y, z, words].map(cast);
        [words, words >> 3, words >> 6].map(|corner| {
            let corner = corner & u32x8::splat(7);
            [x, y, z].map(|lanes| cast(lanes.shuffle(corner)))
        })
    }

    /// Möller and Trumbore's test, of eight triangles: the closest that is hit, up to `max`.
    fn hit(&self, beam: &Beam, max: f32) -> Option<Hit> {
        let [p0, p1, p2] = self.corners();
        let from = |p: &[f32x8; 3]| [0, 1, 2].map(|axis| p[axis] - p0[axis]);
        let (e1, e2, s) = (from(&p1), from(&p2), from(&beam.origin));

        let p = cross(&beam.dir, &e2);
        let q = cross(&s, &e1);
        // Nothing is divided before it is known that something is hit: all is compared with the
        // determinant in place of 1, once its sign is taken from both sides.
        let determinant = dot(&p, &e1);
        let sign = determinant & f32x8::splat(-0.0);
        let determinant = determinant ^ sign;
        let u = dot(&p, &s) ^ sign;
        let v = dot(&q, &beam.dir) ^ sign;
        let t = dot(&q, &e2) ^ sign;
        // Whatever is no number is neither more nor less, and so no hit.
        let inside = u.simd_ge(f32x8::ZERO) & v.simd_ge(f32x8::ZERO) & (u + v).simd_le(determinant);
        let latest = f32x8::splat(max) * determinant;
        let ahead = t.simd_ge(beam.min * determinant) & t.simd_le(latest);
        let mut mask = (inside & ahead & determinant.simd_gt(f32x8::ZERO)).to_bitmask();
        if mask == 0 {
            return None;
        }

        let [u, v, t] = [u, v, t].map(|times| (times / determinant).to_array());
        let range = Interval::new(beam.min.as_array()[0], max);
        let mut nearest: Option<Hit> = None;
        while mask != 0 {
            let lane = mask.trailing_zeros() as usize & 7;
            mask &= mask - 1;
            if range.contains(t[lane]) && nearest.as_ref().is_none_or(|hit| t[lane] <= hit.distance)
            {
                nearest = Some(Hit {
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

/// Where a triangle of a pack is hit, and the weights of two corners there.
struct Hit {
    distance: f32,
    lane: usize,
    u: f32,
    v: f32,
}

/// Where it stands what a `Trace` says of a triangle.
enum Seen {
    /// Nowhere: it follows from the corners. See [`Shape::facet_vertices`].
    Facet { normal: Vec3, material: u32 },
    /// In this place among the surfaces.
    Surface { place: u32 },
}

/// So many lines, from one on.
fn lines_at<const N: usize>(lines: &[Line], start: u32) -> &[Line; N] {
    lines[start as usize..][..N]
        .try_into()
        .expect("as many as were taken")
}

/// Makes the wide tree of the binary one.
struct Folding<'a> {
    primitives: &'a [Primitive],
    nodes: Vec<Node>,
    /// Of which primitives the leaves have pieces.
    order: Vec<usize>,
    /// For each of the nodes.
    plans: Vec<Plan>,
    lines: Vec<Line>,
    surfaces: Vec<Surface>,
}

/// How to fold what is below a node, at the least cost: Ylitie, Karras and Laine, "Efficient
/// Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs", 2017, section 3.1. To visit a node
/// costs as much as a pack.
#[derive(Clone, Copy, Default)]
struct Plan {
    /// The cost of all as at most so many children of a node above.
    costs: [f32; 8],
    /// How many of so many children come from either side; none if all is one child.
    sides: [(u8, u8); 9],
}

impl<'a> Folding<'a> {
    fn new(primitives: &'a [Primitive], nodes: Vec<Node>, order: Vec<usize>) -> Self {
        Folding {
            primitives,
            plans: vec![Plan::default(); nodes.len()],
            lines: Vec::with_capacity(nodes.len()),
            surfaces: Vec::new(),
            nodes,
            order,
        }
    }

    fn all(mut self, root: usize) -> (Vec<Line>, Vec<Surface>) {
        self.plan(root);
        self.eight(root);
        (self.lines, self.surfaces)
    }

    fn plan(&mut self, place: usize) {
        let area = self.nodes[place].bbox.surface_area();
        if self.nodes[place].is_leaf() && !self.halve(place) {
            self.plans[place] = Plan {
                costs: [area; 8],
                ..Plan::default()
            };
            return;
        }

        let node = self.nodes[place];
        self.plan(node.l);
        self.plan(node.r);
        let (l, r) = (&self.plans[node.l], &self.plans[node.r]);
        // The cheapest way to make of both sides so many children.
        let share = |children: usize| {
            let ways = (1..children).filter(|&of_l| of_l < 8 && children - of_l < 8);
            let cost = |of_l: usize| l.costs[of_l] + r.costs[children - of_l];
            let of_l = ways.min_by(|&a, &b| cost(a).total_cmp(&cost(b)));
            let of_l = of_l.expect("one child from either side is a way");
            (cost(of_l), (of_l as u8, (children - of_l) as u8))
        };
        let mut plan = Plan::default();
        let (below, sides) = share(8);
        plan.sides[8] = sides;
        plan.costs[1] = area + below;
        for children in 2..8 {
            let (cost, sides) = share(children);
            let fewer = children - 1;
            (plan.costs[children], plan.sides[children]) = if cost < plan.costs[fewer] {
                (cost, sides)
            } else {
                (plan.costs[fewer], plan.sides[fewer])
            };
        }
        self.plans[place] = plan;
    }

    /// Makes two leaves of one that does not fit in a pack, in the same box: a tree that was handed in may
    /// have its reasons for it. Returns whether that was so.
    fn halve(&mut self, place: usize) -> bool {
        let Node {
            bbox, start, size, ..
        } = self.nodes[place];
        let held = &mut self.order[start..start + size];
        if fit(self.primitives, held.iter().copied()) {
            return false;
        }
        held.sort_by_key(|&place| matches!(self.primitives[place], Primitive::Sphere(_)));
        let (half, l) = (size / 2, self.nodes.len());
        self.nodes.push(Node::leaf(bbox, start, half));
        self.nodes.push(Node::leaf(bbox, start + half, size - half));
        self.plans.extend([Plan::default(); 2]);
        self.nodes[place] = Node::interior(bbox, l, l + 1);
        true
    }

    /// The nodes that become children, at most so many.
    fn children(&self, place: usize, at_most: u8, found: &mut Vec<usize>) {
        match self.plans[place].sides[usize::from(at_most)] {
            (0, 0) => found.push(place),
            (of_l, of_r) => {
                let node = self.nodes[place];
                self.children(node.l, of_l, found);
                self.children(node.r, of_r, found);
            }
        }
    }

    /// Folds what is below a node; returns where it is. Leaves come first, and the largest of them: see
    /// [`Bvh::fetch`].
    fn eight(&mut self, root: usize) -> u32 {
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
        let planes = planes.map(|both| Line(both.map(f32x8::from)));
        self.lines.extend(planes);
        self.lines.push(Line([f32x8::ZERO; 2]));

        let mut folded = [0.0; 8];
        for (folded, &child) in folded.iter_mut().zip(&children) {
            *folded = f32::from_bits(if self.nodes[child].is_leaf() {
                self.leaf(child) | LEAF
            } else {
                self.eight(child)
            });
        }
        self.lines[start + 3] = Line([f32x8::from(folded), f32x8::ZERO]);
        small(start)
    }

    /// Makes the pack of a leaf; returns where it is.
    fn leaf(&mut self, place: usize) -> u32 {
        let Node { start, size, .. } = self.nodes[place];
        // Once each, of however many pieces.
        let mut held = self.order[start..start + size].to_vec();
        held.sort_unstable();
        held.dedup();
        let primitives = self.primitives;
        let held = || held.iter().map(|&place| (place, &primitives[place]));
        let triangles = held().filter_map(|(_, primitive)| match primitive {
            Primitive::Triangle(triangle) => Some(triangle),
            Primitive::Sphere(_) => None,
        });
        let spheres = held().filter_map(|(place, primitive)| match primitive {
            Primitive::Sphere(_) => Some(small(place)),
            Primitive::Triangle(_) => None,
        });
        let triangles: Vec<&Triangle> = triangles.collect();
        let registers = if triangles.is_empty() {
            of_spheres(spheres)
        } else {
            self.of_triangles(&triangles)
        };
        let start = small(self.lines.len());
        self.lines.extend(Pack::lines(registers));
        start
    }

    fn of_triangles(&mut self, triangles: &[&Triangle]) -> [[u32; 8]; 4] {
        let mut corners = Corners::default();
        let mut words = [Word::default(); 8];
        for (word, triangle) in words.iter_mut().zip(triangles) {
            let lanes = positions(triangle).map(|position| corners.lane(position));
            *word = Word::new(lanes.map(|lane| lane.expect("what is in a leaf fits")));
        }

        let is_facet = |triangle: &&Triangle| is_facet(triangle) && triangle.material < Word::MORE;
        if triangles.iter().all(is_facet) {
            for (word, triangle) in words.iter_mut().zip(triangles) {
                word.add(triangle.material);
            }
        } else {
            let start = small(self.surfaces.len());
            words[0].add(start % Word::MORE);
            words[1].add(start / Word::MORE);
            words[Pack::OF_SURFACES].flag();
            let surfaces = triangles.iter().map(|triangle| Surface::new(triangle));
            self.surfaces.extend(surfaces);
        }
        let [x, y, z] = corners.registers();
        [x, y, z, words.map(|Word(word)| word)]
    }
}

/// The registers of a pack of spheres, of their places.
fn of_spheres(places: impl Iterator<Item = u32>) -> [[u32; 8]; 4] {
    let (mut lanes, mut words) = ([NOWHERE; 8], [Word::default(); 8]);
    for (lane, place) in lanes.iter_mut().zip(places) {
        *lane = place;
    }
    words[Pack::OF_SPHERES].flag();
    [lanes, [0; 8], [0; 8], words.map(|Word(word)| word)]
}

/// No primitive has this place.
const NOWHERE: u32 = u32::MAX;

fn positions(triangle: &Triangle) -> [Vec3; 3] {
    [&triangle.p0, &triangle.p1, &triangle.p2].map(|corner| corner.position)
}

/// Whether all that a `Trace` says follows from the corners.
fn is_facet(triangle: &Triangle) -> bool {
    let corners = [&triangle.p0, &triangle.p1, &triangle.p2];
    Shape::facet_vertices(positions(triangle))
        .iter()
        .eq(corners)
}

/// The different corners of some triangles, at most eight.
#[derive(Default)]
struct Corners {
    positions: [Vec3; 8],
    len: usize,
}

impl Corners {
    /// In which lane this one is, or comes; none if all are taken.
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

/// Whether the primitives in these places fit in one pack.
fn fit(primitives: &[Primitive], places: impl ExactSizeIterator<Item = usize>) -> bool {
    let (mut corners, mut triangles, mut spheres) = (Corners::default(), 0, 0);
    places.len() <= 8
        && places
            .map(|place| &primitives[place])
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

/// A place, in the bits that are left for it.
fn small(place: usize) -> u32 {
    let place = u32::try_from(place).ok().filter(|&place| place < LEAF);
    place.expect("memory ends before the numbers do")
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

    /// What both hold.
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
        let mut bounds = Bounds::nothing();
        items.iter().for_each(|item| bounds.join(item.bounds));
        bounds
    }

    /// Twice the box of the items' centers.
    fn of_centers(items: &[Item]) -> Bounds {
        let mut centers = Bounds::nothing();
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

    /// Half of its surface.
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

/// What building needs to know of a primitive, or of a piece of one.
#[derive(Clone, Copy)]
struct Item {
    bounds: Bounds,
    place: usize,
}

fn items(primitives: &[Primitive]) -> Vec<Item> {
    (0..).zip(primitives).map(Item::new).collect()
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

/// What lies in one slice. An item whose center counts begins and ends where that lies.
#[derive(Clone, Copy)]
struct Bucket {
    bounds: Bounds,
    /// How many items begin there.
    begin: usize,
    /// How many end there.
    end: usize,
}

impl Bucket {
    fn empty() -> Self {
        Bucket {
            bounds: Bounds::nothing(),
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

/// Binned SAH over all three axes at once.
struct Builder {
    items: Vec<Item>,
    nodes: Vec<Node>,
    max_leaf_size: usize,
}

impl Builder {
    /// Builds the node over `items[start..end]`, which are not none; returns its place.
    fn node(&mut self, start: usize, end: usize) -> usize {
        let items = &mut self.items[start..end];
        let bounds = Bounds::of(items);
        let place = self.nodes.len();
        self.nodes
            .push(Node::leaf(bounds.bbox(), start, end - start));
        if end - start > self.max_leaf_size {
            let centers = Bounds::of_centers(items);
            let middle = start + partition(items, centers);
            let l = self.node(start, middle);
            let r = self.node(middle, end);
            self.nodes[place] = Node::interior(bounds.bbox(), l, r);
        }
        place
    }
}

/// Reorders the items by the cheapest split; returns how many come first. In large nodes many splits
/// are compared: it takes no time beside counting the items, and what is chosen there matters most.
fn partition(items: &mut [Item], centers: Bounds) -> usize {
    match items.len() {
        0..512 => partition_in::<16>(items, centers),
        512..2048 => partition_in::<32>(items, centers),
        2048.. => partition_in::<64>(items, centers),
    }
}

/// The same, with so many slices of the centers along each axis.
fn partition_in<const SLICES: usize>(items: &mut [Item], centers: Bounds) -> usize {
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
            bucket.begin += 1;
            bucket.end += 1;
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
fn cheapest<const SLICES: usize>(buckets: &[Bucket; SLICES]) -> (usize, f32) {
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

/// Builds the tree that is walked. Where the boxes of two halves would overlap, and it is cheaper, a node
/// is cut along a plane, and a triangle on both sides of it has a piece in either: Stich, Friedrich and
/// Dietrich, "Spatial Splits in Bounding Volume Hierarchies", 2009.
struct Cutter<'a> {
    primitives: &'a [Primitive],
    nodes: Vec<Node>,
    /// Of which primitives the leaves have pieces.
    order: Vec<usize>,
    /// How many pieces more there may be.
    spare: usize,
    /// So much of an overlap is let be: half of its surface.
    bearable: f32,
}

/// A plane, and the cost of cutting there.
struct Cut {
    axis: usize,
    plane: f32,
    cost: f32,
}

impl<'a> Cutter<'a> {
    /// In smaller nodes, cuts take most of the time and save nothing.
    const LEAST: usize = 256;
    /// Along each axis.
    const SLICES: usize = 32;

    fn new(primitives: &'a [Primitive]) -> Self {
        Cutter {
            primitives,
            nodes: Vec::with_capacity(primitives.len()),
            order: Vec::with_capacity(primitives.len()),
            spare: primitives.len(),
            bearable: 1e-4 * Bounds::of(&items(primitives)).area(),
        }
    }

    /// Builds the node over these items, which are not none; returns its place.
    fn node(&mut self, mut items: Vec<Item>) -> usize {
        let bounds = Bounds::of(&items);
        let place = self.nodes.len();
        let leaf = Node::leaf(bounds.bbox(), self.order.len(), items.len());
        self.nodes.push(leaf);
        if fit(self.primitives, items.iter().map(|item| item.place)) {
            self.order.extend(items.iter().map(|item| item.place));
            return place;
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
        self.nodes[place] = Node::interior(bounds.bbox(), l, r);
        place
    }

    /// What lies on either side of a cut, if that is cheaper than these halves.
    fn cheaper_halves(
        &mut self,
        items: &[Item],
        middle: usize,
        bounds: Bounds,
    ) -> Option<(Vec<Item>, Vec<Item>)> {
        if items.len() < Cutter::LEAST {
            return None;
        }
        let (l, r) = items.split_at(middle);
        let (of_l, of_r) = (Bounds::of(l), Bounds::of(r));
        if of_l.overlap(of_r).area() <= self.bearable {
            return None;
        }
        let cost = of_l.area() * l.len() as f32 + of_r.area() * r.len() as f32;
        let cut = self.cheapest_cut(items, bounds)?;
        if cut.cost >= cost {
            return None;
        }

        let (mut l, mut r) = (Vec::new(), Vec::new());
        for item in items {
            if item.bounds.upper.to_array()[cut.axis] <= cut.plane {
                l.push(*item);
            } else if item.bounds.lower.to_array()[cut.axis] >= cut.plane {
                r.push(*item);
            } else {
                let place = item.place;
                let [below, above] = self.pieces(item, cut.axis, cut.plane);
                l.extend(below.map(|bounds| Item { bounds, place }));
                r.extend(above.map(|bounds| Item { bounds, place }));
            }
        }
        let more = (l.len() + r.len()).saturating_sub(items.len());
        if l.len().max(r.len()) >= items.len() || more > self.spare {
            return None;
        }
        self.spare -= more;
        Some((l, r))
    }

    /// Along all axes, between slices of equal width.
    fn cheapest_cut(&self, items: &[Item], bounds: Bounds) -> Option<Cut> {
        let lower = bounds.lower.to_array();
        let width =
            ((bounds.upper - bounds.lower) * f32x4::splat(1.0 / Cutter::SLICES as f32)).to_array();
        let scale = f32x4::from(width.map(|width| if width > 0.0 { 1.0 / width } else { 0.0 }));
        let plane = |axis: usize, slice: usize| lower[axis] + width[axis] * slice as f32;
        let slices = |corner: f32x4| {
            let slices = ((corner - bounds.lower) * scale)
                .fast_trunc_int()
                .to_array();
            slices.map(|slice| (slice as usize).min(Cutter::SLICES - 1))
        };

        let mut buckets = [[Bucket::empty(); Cutter::SLICES]; 3];
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
        let cuts = axes.map(|axis| {
            let (slice, cost) = cheapest(&buckets[axis]);
            let plane = plane(axis, slice);
            Cut { axis, plane, cost }
        });
        cuts.min_by(|a, b| a.cost.total_cmp(&b.cost))
    }

    /// The boxes of what of an item lies below a plane, and above, if anything does.
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
        let Primitive::Triangle(Triangle { p0, p1, p2, .. }) = &self.primitives[item.place] else {
            return [Some(below), Some(above)];
        };

        let [p0, p1, p2] = [p0.position, p1.position, p2.position];
        let (mut low, mut high) = (Bounds::nothing(), Bounds::nothing());
        for (a, b) in [(p0, p1), (p1, p2), (p2, p0)] {
            if a[axis] <= plane {
                low.join(Bounds::point(a));
            }
            if a[axis] >= plane {
                high.join(Bounds::point(a));
            }
            if (a[axis] < plane && plane < b[axis]) || (b[axis] < plane && plane < a[axis]) {
                let at = a + (b - a) * ((plane - a[axis]) / (b[axis] - a[axis]));
                // Wherever rounding has put it, it is inside.
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
