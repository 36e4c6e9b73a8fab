// For each pixel, the sum of all earlier weights, with the total as one more entry. The pixel is the
// last one whose sum isn't above the target.

/// An environment map, and how to sample its bright parts more often.
pub struct Environment {
    map: EnvironmentMap,
    before: Vec<f64>,
}

pub fn uniform_sphere(random: Vec2) -> Vec3 {
    // A point of the circle at a height, with the angle from an arc cosine.
    let (sin_theta, cos_theta) = sin_cos(acos(1.0 - 2.0 * random.y));
    let (sin_phi, cos_phi) = sin_cos(TAU * random.x);
    Vec3::new(sin_theta * cos_phi, cos_theta, sin_theta * sin_phi)
}

impl Environment {
    pub fn new(map: EnvironmentMap) -> Self {
        let glam::UVec2 { x, y } = map.size();
        let mut before = vec![0.0_f64];
        for (index, pixel) in (0_u32..).zip(map.pixels()) {
            let row = index / x;
            let sine = sin_cos((2 * row + 1) as f32 * PI / (2 * y) as f32).0;
            let sum = before[index as usize] + f64::from(sine * luminance(*pixel));
            before.push(sum);
        }
        Environment { map, before }
    }

    pub fn sample(&self, choice: f32, random: Vec2) -> Vec3 {
        let target = f64::from(choice) * self.before[self.before.len() - 1];
        let pixels = self.map.pixels().len();
        let index = self.before[..pixels].partition_point(|sum| *sum <= target) - 1;
        let size = self.map.size();
        let x = (index as u32 % size.x) as f32 + random.x;
        let y = (index as u32 / size.x) as f32 + random.y;
        let (sin_phi, cos_phi) = sin_cos(2.0 * PI * x / size.x as f32);
        let (sin_theta, cos_theta) = sin_cos(PI * y / size.y as f32);
        Vec3::new(cos_phi, 0.0, sin_phi) * sin_theta + Vec3::Y * cos_theta
    }

    pub fn pdf(&self, direction: Vec3) -> f32 {
        let index = self.index(direction);
        let total = self.before[self.before.len() - 1];
        let weight = self.before[index + 1] - self.before[index];
        let sine = (1.0 - direction.y).sqrt() * (1.0 + direction.y).sqrt();
        if weight > 0.0 && sine > 0.0 {
            let size = self.map.size().as_vec2();
            size.x / TAU * (size.y / PI) * (weight / total) as f32 / sine
        } else {
            0.0
        }
    }
}
