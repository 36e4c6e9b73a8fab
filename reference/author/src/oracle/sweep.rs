//! The exact surface area heuristic (SAH): at each node, it tries all partitions by a plane and
//! takes the best one.

use judging::drawing_data::{LevelNode, UpperLevels};

use super::bbox::Bounds;

/// Returns the cost of the greedy sweep's tree, with C_trav = C_isect = 1: the sum of S/S_root over
/// all interior nodes, plus the sum of S/S_root times the number of primitives over all leaves.
///
/// At each node with more than `max_leaf_size` primitives, the sweep takes the cheapest partition
/// between two consecutive centres along any axis (MacDonald and Booth, "Heuristics for ray tracing
/// using space subdivision", The Visual Computer 6, 1990). Primitives whose centres coincide along
/// the axis stay together. If they coincide along all axes, half of them go to each side.
pub fn cost(boxes: &[Bounds], max_leaf_size: usize) -> f64 {
    let mut indices: Vec<usize> = (0..boxes.len()).collect();
    SweepBuilder::new(boxes, max_leaf_size).node_cost(&mut indices, 0, 0)
}

/// Returns the upper levels of the tree whose cost [`cost`] returns, and the plane that splits its
/// root.
pub fn upper_levels(boxes: &[Bounds], max_leaf_size: usize) -> UpperLevels {
    let mut indices: Vec<usize> = (0..boxes.len()).collect();
    let mut builder = SweepBuilder::new(boxes, max_leaf_size);
    builder.node_cost(&mut indices, 0, 0);
    let root = (boxes.len() > max_leaf_size).then(|| cheapest_partition(boxes, &indices));
    UpperLevels {
        nodes: builder.upper_nodes,
        plane: root.flatten().map(|partition| {
            let centers = sorted_centers(boxes, partition.axis);
            let middle = 0.5 * (centers[partition.left - 1] + centers[partition.left]);
            (partition.axis as u8, middle as f32)
        }),
    }
}

/// Returns the axis of the cheapest partition of these boxes, or `None` if all centres coincide.
pub fn best_axis(boxes: &[Bounds]) -> Option<usize> {
    let indices: Vec<usize> = (0..boxes.len()).collect();
    Some(cheapest_partition(boxes, &indices)?.axis)
}

/// Returns the number of boxes on the smaller side of their cheapest partition, or `None` if all
/// centres coincide.
pub fn smaller_side(boxes: &[Bounds]) -> Option<usize> {
    let indices: Vec<usize> = (0..boxes.len()).collect();
    let left = cheapest_partition(boxes, &indices)?.left;
    Some(left.min(boxes.len() - left))
}

/// Returns the number of levels of the tree whose cost [`cost`] returns.
pub fn levels(boxes: &[Bounds], max_leaf_size: usize) -> usize {
    fn below(boxes: &[Bounds], indices: &mut [usize], max_leaf_size: usize) -> usize {
        if indices.len() <= max_leaf_size {
            return 1;
        }
        let middle = sort_by_side(boxes, indices);
        let (left, right) = indices.split_at_mut(middle);
        let [left, right] = [left, right].map(|side| below(boxes, side, max_leaf_size));
        1 + left.max(right)
    }
    let mut indices: Vec<usize> = (0..boxes.len()).collect();
    below(boxes, &mut indices, max_leaf_size)
}

/// Returns the coordinates of the two neighbouring centres that the best partition separates along
/// this axis. Returns `None` if the best partition is along another axis, or if a different
/// partition is nearly as good. If there are only a few primitives, the alternatives include
/// partitions whose sides cannot be separated by a plane.
pub fn clear_gap(boxes: &[Bounds], axis: usize) -> Option<(f64, f64)> {
    let indices: Vec<usize> = (0..boxes.len()).collect();
    let mut all: Vec<Partition> = (0..3)
        .flat_map(|axis| partitions(boxes, &indices, axis))
        .collect();
    all.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let [best, second, ..] = &all[..] else {
        return None;
    };
    let mut sorted = indices.clone();
    sort_by_center(boxes, &mut sorted, best.axis);
    let sides = sorted.split_at(best.left);
    let is_clear_elsewhere =
        (0..3).all(|other| other == axis || is_clear_along(boxes, sides, other));
    let centers = sorted_centers(boxes, axis);
    (best.axis == axis
        && second.cost >= MIN_RATIO * best.cost
        && is_clear_elsewhere
        && given_order_is_worse(boxes, best.cost)
        && no_sides_are_cheaper(boxes, best.cost))
    .then(|| (centers[best.left - 1], centers[best.left]))
}

/// The minimum cost of the second-best partition, relative to the best.
const MIN_RATIO: f64 = 1.05;

/// Returns true if rounding cannot make builders disagree on whether a plane perpendicular to this
/// axis also separates these sides. They agree if the sides' centres are clearly separated, clearly
/// mixed, or all equal.
fn is_clear_along(boxes: &[Bounds], sides: (&[usize], &[usize]), axis: usize) -> bool {
    /// The maximum error of a centre, relative to the largest coordinate.
    const ERROR: f64 = 5e-7;
    let ends = |side: &[usize]| {
        let centers = side.iter().map(|&index| boxes[index].center()[axis]);
        centers.fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), center| {
            (min.min(center), max.max(center))
        })
    };
    let (first, second) = (ends(sides.0), ends(sides.1));
    let coordinates = [first.0, first.1, second.0, second.1].map(f64::abs);
    let error = ERROR * coordinates.into_iter().fold(0.0, f64::max);
    let are_equal = first.0 == first.1 && first == second;
    let gaps = [second.0 - first.1, first.0 - second.1];
    are_equal || gaps.iter().all(|gap| gap.abs() > error)
}

/// Returns whether splitting the primitives in their given order is clearly worse than `cost`. A
/// builder keeps this order along an axis where all centres coincide.
fn given_order_is_worse(boxes: &[Bounds], cost: f64) -> bool {
    let indices: Vec<usize> = (0..boxes.len()).collect();
    let costs = partition_costs(boxes, &indices);
    costs.into_iter().all(|other| other >= MIN_RATIO * cost)
}

/// Returns whether every division of the primitives costs at least `cost`, including divisions into
/// sides that no plane separates. Such divisions are possible because rounding may sort coinciding
/// centres in any order. If there are many primitives, returns true without checking.
fn no_sides_are_cheaper(boxes: &[Bounds], cost: f64) -> bool {
    /// The maximum number of primitives for which all divisions are checked.
    const FEW: usize = 10;
    if boxes.len() > FEW {
        return true;
    }
    let side_cost = |mask: usize, side: usize| {
        let of_side = (0..boxes.len()).filter(|index| mask >> index & 1 == side);
        let indices: Vec<usize> = of_side.collect();
        bounds_of(boxes, &indices).area() * indices.len() as f64
    };
    (1..(1 << boxes.len()) - 1)
        .all(|mask| side_cost(mask, 0) + side_cost(mask, 1) >= cost * (1.0 - 1e-9))
}

fn sorted_centers(boxes: &[Bounds], axis: usize) -> Vec<f64> {
    let mut centers: Vec<f64> = boxes.iter().map(|bounds| bounds.center()[axis]).collect();
    centers.sort_by(f64::total_cmp);
    centers
}

/// A sweep that builds the tree and records its upper levels.
struct SweepBuilder<'a> {
    boxes: &'a [Bounds],
    max_leaf_size: usize,
    root_area: f64,
    upper_nodes: Vec<LevelNode>,
}

impl SweepBuilder<'_> {
    fn new(boxes: &[Bounds], max_leaf_size: usize) -> SweepBuilder<'_> {
        let all: Vec<usize> = (0..boxes.len()).collect();
        SweepBuilder {
            boxes,
            max_leaf_size,
            root_area: bounds_of(boxes, &all).area(),
            upper_nodes: Vec::new(),
        }
    }

    /// Returns the cost of the subtree over the primitives `indices`. `start` is the number of
    /// primitives to the left of the subtree.
    fn node_cost(&mut self, indices: &mut [usize], level: u32, start: usize) -> f64 {
        let relative_area = match self.root_area {
            // All primitives are on a line.
            0.0 => 1.0,
            root_area => bounds_of(self.boxes, indices).area() / root_area,
        };
        let is_leaf = indices.len() <= self.max_leaf_size;
        let own = if is_leaf {
            relative_area * indices.len() as f64
        } else {
            relative_area
        };
        if level < UpperLevels::LEVELS {
            self.upper_nodes.push(LevelNode {
                level,
                start: start as u32,
                count: indices.len() as u32,
                is_leaf,
                cost: own as f32,
            });
        }
        if is_leaf {
            return own;
        }
        let middle = sort_by_side(self.boxes, indices);
        let (left, right) = indices.split_at_mut(middle);
        own + self.node_cost(left, level + 1, start)
            + self.node_cost(right, level + 1, start + middle)
    }
}

/// A partition that sorts the primitives along `axis` and puts the first `left` of them on the left
/// side.
struct Partition {
    axis: usize,
    left: usize,
    cost: f64,
}

/// Sorts the primitives of a node by the side of the cheapest partition and returns the number on its
/// left side. If all centres coincide, the node is split by count.
fn sort_by_side(boxes: &[Bounds], indices: &mut [usize]) -> usize {
    let Some(partition) = cheapest_partition(boxes, indices) else {
        return indices.len() / 2;
    };
    sort_by_center(boxes, indices, partition.axis);
    partition.left
}

/// Returns the cheapest partition along any axis.
fn cheapest_partition(boxes: &[Bounds], indices: &[usize]) -> Option<Partition> {
    let all = (0..3).flat_map(|axis| partitions(boxes, indices, axis));
    all.min_by(|a, b| a.cost.total_cmp(&b.cost))
}

/// Returns all partitions along an axis.
fn partitions(boxes: &[Bounds], indices: &[usize], axis: usize) -> Vec<Partition> {
    let mut sorted = indices.to_vec();
    sort_by_center(boxes, &mut sorted, axis);
    let center = |i: usize| boxes[sorted[i]].center()[axis];

    let costs = partition_costs(boxes, &sorted).into_iter();
    (1..)
        .zip(costs)
        .filter(|&(left, _)| center(left - 1) < center(left))
        .map(|(left, cost)| Partition { axis, left, cost })
        .collect()
}

/// Returns the costs of splitting a row of primitives after the first, after the second and so on.
fn partition_costs(boxes: &[Bounds], row: &[usize]) -> Vec<f64> {
    // For each primitive, the area of the box around all primitives up to and including it.
    let accumulated_areas = |order: &mut dyn Iterator<Item = &usize>| -> Vec<f64> {
        let mut bounds = Bounds::around([]);
        order
            .map(|&index| {
                bounds = bounds.union(&boxes[index]);
                bounds.area()
            })
            .collect()
    };
    let before = accumulated_areas(&mut row.iter());
    let mut after = accumulated_areas(&mut row.iter().rev());
    after.reverse();
    (1..row.len())
        .map(|left| before[left - 1] * left as f64 + after[left] * (row.len() - left) as f64)
        .collect()
}

fn sort_by_center(boxes: &[Bounds], indices: &mut [usize], axis: usize) {
    // Break ties by index, so that the result doesn't depend on the order of `indices`.
    indices.sort_by(|&a, &b| {
        let (left, right) = (boxes[a].center()[axis], boxes[b].center()[axis]);
        left.total_cmp(&right).then(a.cmp(&b))
    });
}

fn bounds_of(boxes: &[Bounds], indices: &[usize]) -> Bounds {
    Bounds::enclosing(indices.iter().map(|&index| boxes[index]))
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, dvec3};

    use super::*;
    use crate::seed::Seed;

    fn cube(x: f64) -> Bounds {
        Bounds {
            min: dvec3(x, 0.0, 0.0),
            max: dvec3(x + 1.0, 1.0, 1.0),
        }
    }

    #[test]
    fn cost_of_two_cubes_matches_a_hand_computed_value() {
        // The root's box is 3 × 1 × 1 and has an area of 14. Each leaf has an area of 6.
        assert_eq!(
            cost(&[cube(0.0), cube(2.0)], 1),
            1.0 + 6.0 / 14.0 + 6.0 / 14.0
        );
        assert_eq!(cost(&[cube(0.0), cube(2.0)], 2), 2.0);
    }

    #[test]
    fn splits_off_the_lone_cube() {
        // 1 + 3 primitives cost less than 2 + 2: 6 · 1 + 14 · 3 instead of 86 · 2 + 10 · 2.
        let cubes = [cube(0.0), cube(20.0), cube(21.0), cube(22.0)];
        let root = 2.0 * (23.0 + 23.0 + 1.0);
        let expected = 1.0 + 6.0 / root + 3.0 * 14.0 / root;
        assert!((cost(&cubes, 3) - expected).abs() < 1e-12);
    }

    #[test]
    fn upper_levels_match_the_tree() {
        let cubes = [cube(22.0), cube(0.0), cube(20.0), cube(21.0)];
        let sweep = upper_levels(&cubes, 3);
        let root = 2.0 * (23.0 + 23.0 + 1.0);
        let node = |level, start, count, is_leaf, cost: f64| LevelNode {
            level,
            start,
            count,
            is_leaf,
            cost: cost as f32,
        };
        let expected = [
            node(0, 0, 4, false, 1.0),
            node(1, 0, 1, true, 6.0 / root),
            node(1, 1, 3, true, 3.0 * 14.0 / root),
        ];
        assert_eq!(sweep.nodes, expected);
        let point = Bounds::around([DVec3::ZERO]);
        assert_eq!(upper_levels(&[point], 1).nodes, [node(0, 0, 1, true, 1.0)]);
        // The plane is halfway between the first and the second centre.
        assert_eq!(sweep.plane, Some((0, 10.5)));
        assert_eq!(upper_levels(&cubes, 4).plane, None);
    }

    #[test]
    fn coinciding_centers_are_split_by_count() {
        // Every node has the root's area. There are three interior nodes and four leaves of one
        // primitive, or one interior node and two leaves of two.
        assert_eq!(cost(&[cube(0.0); 4], 1), 3.0 + 4.0);
        assert_eq!(cost(&[cube(0.0); 4], 2), 1.0 + 4.0);
    }

    #[test]
    fn no_other_first_partition_is_cheaper_with_two_leaves() {
        let mut rng = Seed(5).rng("oracle");
        for _ in 0..100 {
            let boxes: Vec<Bounds> = (0..6)
                .map(|_| {
                    let at = rng.point(3.0);
                    Bounds::around([at, at + DVec3::splat(rng.uniform(0.1, 1.0))])
                })
                .collect();
            // Leaves may contain 5 of the 6 primitives, so there is one split: find the best one by
            // brute force.
            let all: Vec<usize> = (0..6).collect();
            let root = bounds_of(&boxes, &all).area();
            let mut least = f64::INFINITY;
            for axis in 0..3 {
                let mut sorted = all.clone();
                sort_by_center(&boxes, &mut sorted, axis);
                for left in 1..6 {
                    let (a, b) = sorted.split_at(left);
                    let side = |side: &[usize]| bounds_of(&boxes, side).area() * side.len() as f64;
                    least = least.min(1.0 + (side(a) + side(b)) / root);
                }
            }
            assert!((cost(&boxes, 5) - least).abs() < 1e-12);
        }
    }
}
