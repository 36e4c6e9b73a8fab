// Two tables: the sums of the rows, and the sums within each row. The rest of the target within its
// row picks the column, so the shares are row by row all the same.

/// An environment map, and how to sample its bright parts more often.
pub struct Environment {
    map: EnvironmentMap,
    /// For each row, the weight of all earlier rows, followed by the total weight.
    rows: Vec<f64>,
    /// For each row, the weights of the pixels before each column, and of the row.
    columns: Vec<Vec<f64>>,
}

impl Environment {
    pub fn new(map: EnvironmentMap) -> Self {
        let size = map.size();
        let mut rows = vec![0.0];
        let mut columns = Vec::new();
        for (y, pixels) in map.pixels().chunks(size.x as usize).enumerate() {
            let (sine, _) = sin_cos((y as f32 + 0.5) / size.y as f32 * PI);
            let mut sums = vec![0.0];
            for pixel in pixels {
                sums.push(sums[sums.len() - 1] + f64::from(luminance(*pixel)) * f64::from(sine));
            }
            rows.push(rows[y] + sums[pixels.len()]);
            columns.push(sums);
        }
        Environment { map, rows, columns }
    }

    pub fn sample(&self, choice: f32, random: Vec2) -> Vec3 {
        let target = f64::from(choice) * self.rows[self.rows.len() - 1];
        let (y, rest) = entry(&self.rows, target);
        let (x, _) = entry(&self.columns[y], rest);
        let position = (vec2(x as f32, y as f32) + random) / self.map.size().as_vec2();
        let (sin_phi, cos_phi) = sin_cos(TAU * position.x);
        let (sin_theta, cos_theta) = sin_cos(PI * position.y);
        Vec3::new(sin_theta * cos_phi, cos_theta, sin_theta * sin_phi)
    }

    pub fn pdf(&self, direction: Vec3) -> f32 {
        let total = self.rows[self.rows.len() - 1];
        if total == 0.0 {
            return 0.0;
        }
        let size = self.map.size();
        let index = self.index(direction);
        let (x, y) = (index % size.x as usize, index / size.x as usize);
        let of_row = (self.rows[y + 1] - self.rows[y]) / total;
        let row = &self.columns[y];
        let sum = row[row.len() - 1];
        if sum == 0.0 {
            return 0.0;
        }
        let of_column = (row[x + 1] - row[x]) / sum;
        let share = (of_row * of_column) as f32;
        let sine = (1.0 - direction.y * direction.y).sqrt();
        share * (size.x * size.y) as f32 / (2.0 * PI * PI * sine)
    }
}

pub fn uniform_sphere(random: Vec2) -> Vec3 {
    // The same as the reference, but around the z-axis.
    let z = 2.0 * random.y - 1.0;
    let radius = (1.0 - z * z).max(0.0).sqrt();
    let (sin, cos) = sin_cos(TAU * random.x);
    Vec3::new(radius * cos, radius * sin, z)
}

/// Returns the last entry whose sum isn't above the target, and the rest of the target.
fn entry(sums: &[f64], target: f64) -> (usize, f64) {
    let after = sums.partition_point(|sum| *sum <= target);
    let index = after.clamp(1, sums.len() - 1) - 1;
    (index, target - sums[index])
}
