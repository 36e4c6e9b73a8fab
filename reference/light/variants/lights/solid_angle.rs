// Divides one by the solid angle that the light would fill if all of it were as close and as slanted
// as this point.

impl AreaLight {
    pub fn pdf(&self, from: Vec3, direction: Vec3) -> f32 {
        let Some(distance) = self.intersect(from, direction) else {
            return 0.0;
        };
        let projected_area = self.area * self.normal.dot(-direction);
        if projected_area <= 0.0 {
            return 0.0;
        }
        let solid_angle = projected_area / (distance * distance);
        1.0 / solid_angle
    }
}

impl Lights {
    pub fn sample(&self, from: Vec3, choice: f32, random: Vec2) -> Option<Vec3> {
        let mut rest = choice * self.power;
        for (index, light) in self.lights.iter().enumerate() {
            let is_last = index + 1 == self.lights.len();
            if rest < light.power() || is_last {
                return sample_light(light, from, random);
            }
            rest -= light.power();
        }
        None
    }

    pub fn pdf(&self, from: Vec3, direction: Vec3) -> f32 {
        if self.is_empty() {
            return 0.0;
        }
        let mut weighted = 0.0;
        for light in &self.lights {
            weighted += light.power() * light.pdf(from, direction);
        }
        weighted / self.power
    }
}

/// Samples a direction to one light.
fn sample_light(light: &Light, from: Vec3, random: Vec2) -> Option<Vec3> {
    match light {
        Light::Area(light) => {
            let to_light = light.point(random) - from;
            let direction = to_light / to_light.length();
            Some(direction).filter(|direction| light.normal.dot(*direction) < 0.0)
        }
        Light::Sphere(light) => light.sample(from, random),
    }
}
