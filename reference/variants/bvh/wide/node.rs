// The wide nodes in memory, and the test of a ray against eight boxes.

/// A ray, copied to all lanes.
struct WideRay {
    origin: [f32x8; 3],
    dir: [f32x8; 3],
    inverse: [f32x8; 3],
    /// The inverse of the direction, slightly enlarged, for computing exit distances.
    padded_inverse: [f32x8; 3],
    /// For each axis, whether the direction's component is negative.
    is_negative: [bool; 3],
    min: f32x8,
}

impl WideRay {
    /// The minimum absolute value of a direction component. The inverse of 0 would be infinite, and
    /// infinity times 0 is NaN. The inverse of this number is large enough to serve as infinity.
    const MIN_COMPONENT: f32 = 1e-30;

    /// A factor that compensates for the rounding error of exit distances, so that no box is
    /// missed. See Pharr, Jakob and Humphreys, "Physically Based Rendering" (4th edition), section
    /// 6.1.2.
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

/// The bit that marks a child as a leaf (a pack) rather than a node. It is set in the index of the
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

    /// Returns the entry distances of all boxes and a bit mask of the boxes that the ray enters
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
        // Maxima and minima are computed in independent pairs, which shortens the dependency chain.
        let enter = (enter[0].fast_max(enter[1])).fast_max(enter[2].fast_max(wide_ray.min));
        let leave = (leave[0].fast_min(leave[1])).fast_min(leave[2].fast_min(f32x8::splat(max)));
        (enter, enter.simd_le(leave).to_bitmask())
    }
}

/// Returns `N` lines, beginning at `start`.
fn lines_at<const N: usize>(lines: &[CacheLine], start: u32) -> &[CacheLine; N] {
    lines[start as usize..][..N]
        .try_into()
        .expect("the slice has N lines")
}
