// Expands a macro once for each of the three axes, passing it the name of the coordinate.

/// Shortens an interval to the part during which the ray is inside the slab of one axis.
macro_rules! clip_to_slab {
    ($inside:ident, $bbox:expr, $ray:expr, $axis:ident) => {
        let to_min = ($bbox.min.$axis - $ray.origin.$axis) / $ray.dir.$axis;
        let to_max = ($bbox.max.$axis - $ray.origin.$axis) / $ray.dir.$axis;
        $inside.min = $inside.min.max(f32::min(to_min, to_max));
        $inside.max = $inside.max.min(f32::max(to_min, to_max));
    };
}

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let mut inside = times;
        clip_to_slab!(inside, self, ray, x);
        clip_to_slab!(inside, self, ray, y);
        clip_to_slab!(inside, self, ray, z);
        (inside.min <= inside.max).then_some(inside)
    }
}
