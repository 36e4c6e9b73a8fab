// Computes the sums of the shares once, in `new`, and finds the light by binary search.

/// The lights of a scene.
#[derive(Clone, Debug)]
pub struct Lights {
    lights: Vec<Light>,
    /// The sum of the lights' powers.
    power: f32,
    /// For each light, the share of this light and all earlier lights.
    cumulative: Vec<f32>,
    /// The share of each light.
    shares: Vec<f32>,
}

impl AreaLight {
    pub fn pdf(&self, from: Vec3, direction: Vec3) -> f32 {
        let cosine = self.normal.dot(-direction);
        if cosine <= 0.0 {
            return 0.0;
        }
        let distance = self.intersect(from, direction).unwrap_or(0.0);
        distance * distance / (cosine * self.area)
    }
}

impl Lights {
    pub fn new(mut lights: Vec<Light>) -> Self {
        lights.retain(|light| light.power() > 0.0);
        let power: f32 = lights.iter().map(Light::power).sum();
        let shares: Vec<f32> = lights.iter().map(|light| light.power() / power).collect();
        let mut sum = 0.0;
        let mut cumulative = Vec::new();
        for share in &shares {
            sum += share;
            cumulative.push(sum);
        }
        Lights {
            lights,
            power,
            cumulative,
            shares,
        }
    }

    pub fn sample(&self, from: Vec3, choice: f32, random: Vec2) -> Option<Vec3> {
        let index = self.cumulative.partition_point(|sum| *sum <= choice);
        match self.lights.get(index).or(self.lights.last())? {
            Light::Area(light) if self.faces(light, from) => {
                Some((light.point(random) - from).normalize())
            }
            Light::Area(_) => None,
            Light::Sphere(light) => light.sample(from, random),
        }
    }

    pub fn pdf(&self, from: Vec3, direction: Vec3) -> f32 {
        let lights = self.lights.iter().zip(&self.shares);
        lights
            .map(|(light, share)| share * light.pdf(from, direction))
            .sum()
    }

    /// Returns whether a point is on the side of a light's plane that the light emits to.
    fn faces(&self, light: &AreaLight, point: Vec3) -> bool {
        (point - light.corner).dot(light.normal) > 0.0
    }
}
