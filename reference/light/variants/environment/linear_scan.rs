// Stores the weights, and scans them for each sample.

/// An environment map, and how to sample its bright parts more often.
pub struct Environment {
    map: EnvironmentMap,
    weights: Vec<f64>,
}

pub fn uniform_sphere(random: Vec2) -> Vec3 {
    // The sine of half of θ is the square root of the first number, so this is the sine of θ.
    let sine = 2.0 * (random.x * (1.0 - random.x)).sqrt();
    let (sin_phi, cos_phi) = sin_cos(TAU * random.y);
    Vec3::new(sine * cos_phi, sine * sin_phi, 1.0 - 2.0 * random.x)
}

impl Environment {
    pub fn new(map: EnvironmentMap) -> Self {
        let size = map.size();
        let weight = |index: usize, pixel: &Vec3| {
            let row = index / size.x as usize;
            let theta = std::f64::consts::PI * (row as f64 + 0.5) / f64::from(size.y);
            f64::from(luminance(*pixel)) * f64::from(sin_cos(theta as f32).0)
        };
        let pixels = map.pixels().iter().enumerate();
        let weights = pixels.map(|(index, pixel)| weight(index, pixel)).collect();
        Environment { map, weights }
    }

    pub fn sample(&self, choice: f32, random: Vec2) -> Vec3 {
        let mut rest = f64::from(choice) * self.total();
        let mut picked = 0;
        for (index, &weight) in self.weights.iter().enumerate() {
            if weight > 0.0 {
                picked = index as u32;
                if rest < weight {
                    break;
                }
                rest -= weight;
            }
        }
        let size = self.map.size();
        let column = (picked % size.x) as f32 + random.x;
        let row = (picked / size.x) as f32 + random.y;
        let (phi, theta) = (TAU * column / size.x as f32, PI * row / size.y as f32);
        let (sine, height) = sin_cos(theta);
        let (sin, cos) = sin_cos(phi);
        Vec3::new(sine * cos, height, sine * sin)
    }

    pub fn pdf(&self, direction: Vec3) -> f32 {
        let weight = self.weights[self.index(direction)];
        let sine = direction.x.hypot(direction.z);
        if weight <= 0.0 || sine <= 0.0 {
            return 0.0;
        }
        let size = self.map.size();
        let solid_angle = TAU / size.x as f32 * (PI / size.y as f32) * sine;
        (weight / self.total()) as f32 / solid_angle
    }

    fn total(&self) -> f64 {
        self.weights.iter().sum()
    }
}
