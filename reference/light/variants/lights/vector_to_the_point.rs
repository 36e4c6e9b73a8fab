// Uses the vector to the point on the light: the density is its length cubed, divided by its dot
// product with the normal and by the area.

impl AreaLight {
    pub fn pdf(&self, from: Vec3, direction: Vec3) -> f32 {
        self.intersect(from, direction).map_or(0.0, |distance| {
            let to_light = distance * direction;
            let along_normal = -to_light.dot(self.normal);
            if along_normal > 0.0 {
                distance.powi(3) / (along_normal * self.area)
            } else {
                0.0
            }
        })
    }
}

impl Lights {
    pub fn sample(&self, from: Vec3, choice: f32, random: Vec2) -> Option<Vec3> {
        match pick(&self.lights, choice * self.power)? {
            Light::Sphere(light) => light.sample(from, random),
            light @ Light::Area(area) => {
                let direction = (area.point(random) - from).normalize();
                // The light is dark from behind.
                (light.emitted(direction) != Vec3::ZERO).then_some(direction)
            }
        }
    }

    pub fn pdf(&self, from: Vec3, direction: Vec3) -> f32 {
        let add =
            |sum, light: &Light| sum + light.power() / self.power * light.pdf(from, direction);
        self.lights.iter().fold(0.0, add)
    }
}

/// Returns the light at this position in the powers one after the other, by recursion.
fn pick(lights: &[Light], target: f32) -> Option<&Light> {
    let (first, rest) = lights.split_first()?;
    if target < first.power() || rest.is_empty() {
        return Some(first);
    }
    pick(rest, target - first.power())
}
