// The directions come from an equal-area map of the square to an octahedron. The sums are shares, in
// single precision, and the weights are kept beside them.

/// An environment map, and how to sample its bright parts more often.
pub struct Environment {
    map: EnvironmentMap,
    shares: Vec<f32>,
    sums: Vec<f32>,
}

pub fn uniform_sphere(random: Vec2) -> Vec3 {
    let folded = 2.0 * random - 1.0;
    let (u, v) = (folded.x.abs(), folded.y.abs());
    let to_edge = 1.0 - (u + v);
    let radius = 1.0 - to_edge.abs();
    let angle = if radius == 0.0 {
        0.0
    } else {
        ((v - u) / radius + 1.0) * std::f32::consts::FRAC_PI_4
    };
    let height = (1.0 - radius * radius) * to_edge.signum();
    let scale = radius * (2.0 - radius * radius).max(0.0).sqrt();
    let (sin, cos) = sin_cos(angle);
    Vec3::new(
        scale * cos * folded.x.signum(),
        scale * sin * folded.y.signum(),
        height,
    )
}

impl Environment {
    pub fn new(map: EnvironmentMap) -> Self {
        let size = map.size();
        let mut weights = Vec::with_capacity(map.pixels().len());
        for y in 0..size.y {
            for x in 0..size.x {
                let pixel = map.pixels()[(y * size.x + x) as usize];
                let theta = PI * (y as f32 + 0.5) / size.y as f32;
                weights.push(f64::from(luminance(pixel)) * f64::from(sin_cos(theta).0));
            }
        }
        let total: f64 = weights.iter().sum();
        let share = |weight: f64| if total > 0.0 { weight / total } else { 0.0 };
        let shares: Vec<f32> = weights.iter().map(|weight| share(*weight) as f32).collect();
        let mut sum = 0.0;
        let mut sums = Vec::new();
        for weight in weights {
            sum += share(weight);
            sums.push(sum as f32);
        }
        Environment { map, shares, sums }
    }

    pub fn sample(&self, choice: f32, random: Vec2) -> Vec3 {
        let is_above = |sum: &f32| *sum > choice;
        let picked = self.sums.iter().position(is_above);
        // Rounding can leave all sums below the number.
        let last = self.shares.iter().rposition(|share| *share > 0.0);
        let picked = picked.or(last).unwrap_or(0);
        let width = self.map.size().x as usize;
        let corner = vec2((picked % width) as f32, (picked / width) as f32);
        let angles = (corner + random) / self.map.size().as_vec2() * vec2(TAU, PI);
        let (sin_phi, cos_phi) = sin_cos(angles.x);
        let (sin_theta, cos_theta) = sin_cos(angles.y);
        Vec3::new(cos_phi * sin_theta, cos_theta, sin_phi * sin_theta)
    }

    pub fn pdf(&self, direction: Vec3) -> f32 {
        let sine = sin_cos(acos(direction.y.clamp(-1.0, 1.0))).0;
        let share = self.shares[self.index(direction)];
        if share == 0.0 {
            return 0.0;
        }
        share * self.shares.len() as f32 / (TAU * PI * sine)
    }
}
