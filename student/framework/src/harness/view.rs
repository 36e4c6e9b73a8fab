//! Pictures of first hits. They show the fields of the [`Trace`] instead of light.

use glam::Vec3;
use protocol::{Trace, Tree};

/// The quantity that a picture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum ViewMode {
    /// The scene with its lighting.
    Shaded,
    /// The shapes rendered in clay, without materials or lights: dark where they are close together.
    Clay,
    /// `Trace::normal`: x, y and z from −1 to 1 as red, green and blue.
    Normals,
    /// `Trace::distance`: the nearest hit is white, the farthest almost black.
    Depth,
    /// `Trace::uv`: the fractional parts of u and v as red and green.
    Uv,
    /// The number of boxes in the tree that contain the hit, from blue (few) to red (many), with a
    /// different brightness for each leaf.
    Bvh,
}

/// The maximum distance of a hit from its primitive's box, relative to the largest coordinate. It
/// allows for rounding.
const RELATIVE_TOLERANCE: f32 = 1e-4;

/// The maximum number of nodes to compare with a point. In a good tree, a few hundred are enough.
/// Without a limit, a tree that is effectively a list of a million nodes would take hours.
const MAX_STEPS: usize = 4096;

/// Computes the colour of each pixel from its first hit. Pixels without a hit, or with a value that
/// isn't finite, are black. For `Shaded` and `Clay`, all pixels are black. `extent` is the largest
/// coordinate in the scene.
pub fn picture(view: ViewMode, hits: &[Option<Trace>], tree: &Tree, extent: f32) -> Vec<Vec3> {
    let each = |colour: &dyn Fn(&Trace) -> Vec3| {
        let pixel = |hit: &Option<Trace>| hit.as_ref().map_or(Vec3::ZERO, colour);
        let pixels = hits.iter().map(pixel);
        let finite = |pixel: Vec3| if pixel.is_finite() { pixel } else { Vec3::ZERO };
        pixels.map(finite).collect()
    };
    match view {
        ViewMode::Shaded | ViewMode::Clay => vec![Vec3::ZERO; hits.len()],
        ViewMode::Normals => each(&|hit| hit.normal.normalize() * 0.5 + 0.5),
        ViewMode::Uv => each(&|hit| (hit.uv - hit.uv.floor()).extend(0.0)),
        ViewMode::Depth => {
            let distances = hits.iter().flatten().map(|hit| hit.distance);
            let finite = distances.filter(|distance| distance.is_finite());
            let (near, far) = finite.fold((f32::INFINITY, 0.0_f32), |(near, far), distance| {
                (near.min(distance), far.max(distance))
            });
            // The span isn't zero: if all hits are at the same distance, they are all white.
            let span = (far - near).max(f32::MIN_POSITIVE);
            each(&|hit| Vec3::splat(1.0 - 0.95 * (hit.distance - near) / span))
        }
        ViewMode::Bvh => {
            let tolerance = RELATIVE_TOLERANCE * extent;
            let location = |hit: &Trace| locate(tree, hit.position, tolerance);
            let counts = hits.iter().flatten().map(|hit| location(hit).boxes);
            let max = counts.max().unwrap_or(0);
            each(&|hit| {
                let TreeLocation { boxes, leaf } = location(hit);
                leaf_brightness(leaf) * heat_colour(boxes, max)
            })
        }
    }
}

/// Returns the unchanged value of each pixel's first hit, for files that store numbers: normals,
/// distances, or u and v. Without a hit, the distance is infinite and other values are zero.
/// Returns `None` for views that don't show one of the hit's fields.
pub fn raw_values(view: ViewMode, hits: &[Option<Trace>]) -> Option<Vec<Vec3>> {
    let (miss, value): (Vec3, fn(&Trace) -> Vec3) = match view {
        ViewMode::Normals => (Vec3::ZERO, |hit| hit.normal),
        ViewMode::Depth => (Vec3::INFINITY, |hit| Vec3::splat(hit.distance)),
        ViewMode::Uv => (Vec3::ZERO, |hit| hit.uv.extend(0.0)),
        ViewMode::Shaded | ViewMode::Clay | ViewMode::Bvh => return None,
    };
    let of_pixel = |hit: &Option<Trace>| hit.as_ref().map_or(miss, value);
    Some(hits.iter().map(of_pixel).collect())
}

/// The boxes of a tree that contain a point.
#[derive(Clone, Copy, Default, PartialEq, Eq, Debug)]
struct TreeLocation {
    /// The number of nodes whose boxes contain the point.
    boxes: u32,
    /// The index of a leaf whose box contains the point, or 0 if there is none.
    leaf: u32,
}

/// Finds the boxes that contain `point`, within this tolerance. This doesn't trace a ray, which is
/// the submission's task. If the tree is invalid or very deep, the result only covers part of it.
fn locate(tree: &Tree, point: Vec3, tolerance: f32) -> TreeLocation {
    let mut found = TreeLocation::default();
    let mut stack = vec![tree.root];
    // In a valid tree, each node is reached once. The limit ends the loop if the tree has a cycle.
    for _ in 0..tree.nodes.len().min(MAX_STEPS) {
        let Some(index) = stack.pop() else { break };
        let Some(node) = tree.nodes.get(index as usize) else {
            continue;
        };
        let below = point.cmplt(node.min - tolerance);
        let above = point.cmpgt(node.max + tolerance);
        if (below | above).any() {
            continue;
        }
        found.boxes += 1;
        if node.is_leaf() {
            found.leaf = index;
        } else {
            stack.extend([node.r, node.l]);
        }
    }
    found
}

/// Returns a colour from blue (for 0) through green to red (for `max`).
pub fn heat_colour(count: u32, max: u32) -> Vec3 {
    const STOPS: [Vec3; 4] = [
        Vec3::new(0.15, 0.25, 0.85),
        Vec3::new(0.1, 0.75, 0.65),
        Vec3::new(0.95, 0.85, 0.2),
        Vec3::new(0.9, 0.15, 0.1),
    ];
    let position = count as f32 / max.max(1) as f32 * 3.0;
    let stop = (position as usize).min(2);
    STOPS[stop].lerp(STOPS[stop + 1], position - stop as f32)
}

/// Returns a brightness that distinguishes a leaf from its neighbours. Multiples of the golden
/// ratio, modulo 1, are well distributed, so leaves with close indices get different values.
fn leaf_brightness(leaf: u32) -> f32 {
    let step = (f64::from(leaf) * 0.618_033_988_749_895).fract();
    0.55 + 0.45 * step as f32
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, vec3};
    use protocol::TreeNode;

    use super::*;

    fn node(min: f32, max: f32, l: u32, r: u32) -> TreeNode {
        TreeNode {
            min: Vec3::splat(min),
            max: Vec3::splat(max),
            start: 0,
            size: 1,
            l,
            r,
        }
    }

    fn hit(distance: f32) -> Option<Trace> {
        Some(Trace {
            distance,
            position: Vec3::splat(distance),
            normal: Vec3::Y * 2.0,
            uv: Vec2::new(1.25, -0.25),
            origin: Vec3::ZERO,
            shape: 0,
        })
    }

    fn two_leaves() -> Tree {
        Tree {
            nodes: vec![
                node(2.0, 4.0, 0, 0),
                node(0.0, 4.0, 2, 0),
                node(0.0, 3.0, 2, 2),
            ],
            root: 1,
            order: Vec::new(),
        }
    }

    #[test]
    fn counts_the_boxes_around_a_point() {
        let boxes = |point: f32| locate(&two_leaves(), Vec3::splat(point), 0.0).boxes;
        assert_eq!(
            [boxes(1.0), boxes(2.5), boxes(3.5), boxes(5.0)],
            [2, 3, 2, 0]
        );
        let leaf = |point: f32| locate(&two_leaves(), Vec3::splat(point), 0.0).leaf;
        assert_eq!([leaf(1.0), leaf(3.5)], [2, 0]);
    }

    #[test]
    fn terminates_on_a_cyclic_tree() {
        let mut tree = two_leaves();
        tree.nodes[0] = node(0.0, 9.0, 1, 1);
        tree.nodes[2] = node(0.0, 9.0, 1, 7);
        assert!(locate(&tree, Vec3::ONE, 0.0).boxes <= 3);
        assert_eq!(
            locate(&Tree::default(), Vec3::ONE, 0.0),
            TreeLocation::default()
        );
    }

    #[test]
    fn a_very_deep_tree_is_followed_only_so_far() {
        let next = |i: u32| node(0.0, 1.0, i + 1, u32::MAX);
        let tree = Tree {
            nodes: (0..10_000).map(next).collect(),
            root: 0,
            order: Vec::new(),
        };
        assert!(locate(&tree, Vec3::splat(0.5), 0.0).boxes as usize <= MAX_STEPS);
    }

    #[test]
    fn the_nearest_is_white_and_a_miss_is_black() {
        let hits = [hit(2.0), None, hit(4.0), hit(f32::NAN)];
        let pixels = picture(ViewMode::Depth, &hits, &Tree::default(), 0.0);
        assert_eq!(pixels[0], Vec3::ONE);
        assert_eq!(pixels[1], Vec3::ZERO);
        assert!(pixels[2].abs_diff_eq(Vec3::splat(0.05), 1e-6));
        assert_eq!(pixels[3], Vec3::ZERO);
    }

    #[test]
    fn raw_values_are_those_of_the_hits() {
        let values = |view| raw_values(view, &[hit(3.5), None]);
        assert_eq!(
            values(ViewMode::Depth),
            Some(vec![Vec3::splat(3.5), Vec3::INFINITY])
        );
        assert_eq!(
            values(ViewMode::Normals),
            Some(vec![Vec3::Y * 2.0, Vec3::ZERO])
        );
        assert_eq!(
            values(ViewMode::Uv),
            Some(vec![vec3(1.25, -0.25, 0.0), Vec3::ZERO])
        );
        assert_eq!(values(ViewMode::Bvh), None);
    }

    #[test]
    fn normals_and_uv_become_colours() {
        let pixels = |view| picture(view, &[hit(1.0)], &Tree::default(), 0.0);
        assert_eq!(pixels(ViewMode::Normals), [vec3(0.5, 1.0, 0.5)]);
        assert_eq!(pixels(ViewMode::Uv), [vec3(0.25, 0.75, 0.0)]);
    }

    #[test]
    fn without_a_tree_every_hit_has_the_same_colour() {
        let pixels = picture(ViewMode::Bvh, &[hit(1.0), hit(2.0)], &Tree::default(), 0.0);
        assert_eq!(pixels[0], pixels[1]);
        assert_ne!(pixels[0], Vec3::ZERO);
    }
}
