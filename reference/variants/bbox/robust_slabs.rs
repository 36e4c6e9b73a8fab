// Delays the time at which the ray leaves each slab by a bound on the rounding error, so that
// rounding never causes a miss. See Pharr, Jakob and Humphreys, "Physically Based Rendering" (4th
// edition), section 6.1.2.

impl BBox {
    pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {
        let (mut enter, mut leave) = (times.min, times.max);
        for axis in 0..3 {
            let inverse = 1.0 / ray.dir[axis];
            let mut near = (self.min[axis] - ray.origin[axis]) * inverse;
            let mut far = (self.max[axis] - ray.origin[axis]) * inverse;
            if near > far {
                std::mem::swap(&mut near, &mut far);
            }
            far *= 1.0 + 2.0 * gamma(3.0);
            enter = if near > enter { near } else { enter };
            leave = if far < leave { far } else { leave };
            if enter > leave {
                return None;
            }
        }
        Some(Interval::new(enter, leave))
    }
}

/// Returns a bound on the relative error of a number after `n` roundings.
fn gamma(n: f32) -> f32 {
    let rounding = 0.5 * f32::EPSILON;
    n * rounding / (1.0 - n * rounding)
}
