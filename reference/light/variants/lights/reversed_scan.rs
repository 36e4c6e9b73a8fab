// Scans the lights from the last one, and subtracts each power from the total.

impl AreaLight {
    pub fn pdf(&self, from: Vec3, direction: Vec3) -> f32 {
        let is_seen_from_front = (from - self.corner).dot(self.normal) > 0.0;
        match self.intersect(from, direction) {
            Some(distance) if is_seen_from_front => {
                distance.powi(2) / self.area / direction.dot(self.normal).abs()
            }
            _ => 0.0,
        }
    }
}

impl Lights {
    pub fn sample(&self, from: Vec3, choice: f32, random: Vec2) -> Option<Vec3> {
        let mut start = self.power;
        let mut picked = self.lights.first()?;
        for light in self.lights.iter().rev() {
            start -= light.power();
            if choice * self.power >= start {
                picked = light;
                break;
            }
        }
        match picked {
            Light::Sphere(light) => light.sample(from, random),
            Light::Area(light) => {
                let point = light.point(random);
                let direction = (point - from) * point.distance(from).recip();
                if direction.dot(light.normal) < 0.0 {
                    Some(direction)
                } else {
                    None
                }
            }
        }
    }

    pub fn pdf(&self, from: Vec3, direction: Vec3) -> f32 {
        let is_ahead = |light: &&Light| light.intersect(from, direction).is_some();
        let ahead = self.lights.iter().filter(is_ahead);
        ahead
            .map(|light| light.pdf(from, direction) * (light.power() / self.power))
            .sum()
    }
}
