// Finds the split with trait objects: one for each axis, and one that splits by count, for
// primitives whose centres coincide. Compares costs in double precision.

/// A way to split a node in two.
trait Split {
    /// Orders the primitives, and returns the size and the cost of the best left side. `None` if this
    /// split cannot divide them.
    fn apply(&self, primitives: &mut [Primitive]) -> Option<(usize, f64)>;
}

/// Splits at one of several planes across an axis.
struct AcrossAxis {
    axis: usize,
    planes: usize,
}

/// Splits by count.
struct InHalves;

impl Split for AcrossAxis {
    fn apply(&self, primitives: &mut [Primitive]) -> Option<(usize, f64)> {
        let center = |primitive: &Primitive| primitive.bbox().center()[self.axis];
        primitives.sort_by(|a, b| center(a).total_cmp(&center(b)));
        let (first, last) = (center(primitives.first()?), center(primitives.last()?));
        let sizes = (1..=self.planes).map(|plane| {
            let part = plane as f32 / (self.planes + 1) as f32;
            let coordinate = first + part * (last - first);
            primitives.partition_point(|primitive| center(primitive) < coordinate)
        });
        let sizes = sizes.filter(|&size| size > 0 && size < primitives.len());
        let costs = sizes.map(|size| {
            let (left, right) = primitives.split_at(size);
            (size, cost(left) + cost(right))
        });
        costs.min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl Split for InHalves {
    fn apply(&self, primitives: &mut [Primitive]) -> Option<(usize, f64)> {
        Some((primitives.len() / 2, f64::INFINITY))
    }
}

fn cost(side: &[Primitive]) -> f64 {
    f64::from(bounds_of(side).surface_area()) * side.len() as f64
}

/// Partitions the primitives in place by the cheapest split; returns the size of the left side.
fn cheapest_split(primitives: &mut [Primitive]) -> usize {
    let across = |axis| Box::new(AcrossAxis { axis, planes: 20 }) as Box<dyn Split>;
    let splits = [across(0), across(1), across(2), Box::new(InHalves)];
    let mut cost_of = |split: &dyn Split| {
        let applied = split.apply(primitives);
        applied.map_or(f64::INFINITY, |(_, cost)| cost)
    };
    let costs = splits.each_ref().map(|split| cost_of(&**split));
    let [.., in_halves] = &splits;
    let cheapest = (0..3).min_by(|&a, &b| costs[a].total_cmp(&costs[b]));
    let cheapest = cheapest.filter(|&axis| costs[axis].is_finite());
    let split = cheapest.map_or(in_halves, |axis| &splits[axis]);
    split.apply(primitives).map_or(1, |(size, _)| size)
}

impl Bvh {
    pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {
        build_top_down(primitives, max_leaf_size, cheapest_split)
    }
}
