// Computes densities and shares in double precision.

impl AreaLight {
    pub fn pdf(&self, from: Vec3, direction: Vec3) -> f32 {
        let cosine = -direction.as_dvec3().dot(self.normal.as_dvec3());
        let hit = self.intersect(from, direction).filter(|_| cosine > 0.0);
        let Some(distance) = hit.map(f64::from) else {
            return 0.0;
        };
        (distance.powi(2) / cosine / f64::from(self.area)) as f32
    }
}

impl Lights {
    pub fn sample(&self, from: Vec3, choice: f32, random: Vec2) -> Option<Vec3> {
        let powers = self.lights.iter().map(|light| f64::from(light.power()));
        let target = f64::from(choice) * powers.clone().sum::<f64>();
        let sums = powers.scan(0.0, |sum, power| {
            *sum += power;
            Some(*sum)
        });
        let index = sums.take_while(|&sum| sum <= target).count();
        let last = self.lights.len().checked_sub(1)?;
        match &self.lights[index.min(last)] {
            Light::Area(light) => {
                let direction = light.point(random).as_dvec3() - from.as_dvec3();
                let faces_away = direction.dot(light.normal.as_dvec3()) >= 0.0;
                (!faces_away).then(|| direction.normalize().as_vec3())
            }
            Light::Sphere(light) => light.sample(from, random),
        }
    }

    pub fn pdf(&self, from: Vec3, direction: Vec3) -> f32 {
        let mut sum = 0.0;
        for light in &self.lights {
            let share = f64::from(light.power()) / f64::from(self.power);
            sum += share * f64::from(light.pdf(from, direction));
        }
        sum as f32
    }
}
