// Weighs pixels by their exact solid angle, the difference of two cosines. It is the sine of the
// row's middle times a factor that is the same for all rows, so the shares are the same. The density
// is computed from the radiance in that direction.

/// An environment map, and how to sample its bright parts more often.
pub struct Environment {
    map: EnvironmentMap,
    cumulative: Vec<f64>,
}

pub fn uniform_sphere(random: Vec2) -> Vec3 {
    // Lambert's azimuthal equal-area projection, from a disc that is sampled evenly.
    let radius = random.x.sqrt();
    let (sin, cos) = sin_cos(TAU * random.y);
    let on_disc = radius * vec2(cos, sin);
    let scale = 2.0 * (1.0 - random.x).max(0.0).sqrt();
    Vec3::new(1.0 - 2.0 * random.x, scale * on_disc.x, scale * on_disc.y)
}

impl Environment {
    pub fn new(map: EnvironmentMap) -> Self {
        let size = map.size();
        let width = size.x as usize;
        let indices = 0..map.pixels().len();
        let cumulative = indices
            .scan(0.0, |sum, index| {
                let pixel = map.pixels()[index];
                *sum += f64::from(luminance(pixel)) * solid_angle(index / width, size.y);
                Some(*sum)
            })
            .collect();
        Environment { map, cumulative }
    }

    pub fn sample(&self, choice: f32, random: Vec2) -> Vec3 {
        let target = f64::from(choice) * self.cumulative.last().copied().unwrap_or_default();
        // The first entry above the target, by bisection.
        let (mut low, mut high) = (0, self.cumulative.len() - 1);
        while low < high {
            let middle = (low + high) / 2;
            if self.cumulative[middle] > target {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        let size = self.map.size().as_vec2();
        let row = (low as f32 / size.x).floor();
        let column = low as f32 - row * size.x;
        let phi = (column + random.x) * (TAU / size.x);
        let theta = (row + random.y) * (PI / size.y);
        let (sin_theta, cos_theta) = sin_cos(theta);
        let (sin_phi, cos_phi) = sin_cos(phi);
        sin_theta * Vec3::new(cos_phi, 0.0, sin_phi) + cos_theta * Vec3::Y
    }

    pub fn pdf(&self, direction: Vec3) -> f32 {
        let total = self.cumulative[self.cumulative.len() - 1];
        let brightness = luminance(self.radiance(direction));
        if brightness == 0.0 || total == 0.0 {
            return 0.0;
        }
        let size = self.map.size();
        let row = self.index(direction) / size.x as usize;
        let share = f64::from(brightness) * solid_angle(row, size.y) / total;
        let sine = f64::from(direction.x).hypot(f64::from(direction.z));
        let pixels = f64::from(size.x) * f64::from(size.y);
        (share * pixels / (2.0 * std::f64::consts::PI.powi(2) * sine)) as f32
    }
}

/// Returns the solid angle of a pixel up to a constant factor.
fn solid_angle(row: usize, rows: u32) -> f64 {
    let cosine = |row: usize| (std::f64::consts::PI * row as f64 / f64::from(rows)).cos();
    cosine(row) - cosine(row + 1)
}
