// Solves the three equations by Gaussian elimination with partial pivoting, in single precision.

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let e1 = self.p1.position - self.p0.position;
        let e2 = self.p2.position - self.p0.position;
        let s = ray.origin - self.p0.position;

        // One row for each coordinate: e1 · u + e2 · v − d · t = s.
        let rows = [0, 1, 2].map(|axis| [e1[axis], e2[axis], -ray.dir[axis], s[axis]]);
        let [u, v, t] = solve(rows)?;
        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        (inside && ray.range.contains(t)).then(|| self.trace_at(ray, t, u, v))
    }
}

/// Solves three linear equations, or returns `None` if the solution isn't unique.
fn solve(mut rows: [[f32; 4]; 3]) -> Option<[f32; 3]> {
    for column in 0..3 {
        // The largest pivot causes the smallest rounding errors.
        let size = |row: &usize| rows[*row][column].abs();
        let pivot = (column..3).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        rows.swap(column, pivot);
        let pivot = rows[column];
        if pivot[column] == 0.0 {
            return None;
        }
        for row in &mut rows[column + 1..] {
            let factor = row[column] / pivot[column];
            for (entry, above) in row.iter_mut().zip(pivot) {
                *entry -= factor * above;
            }
        }
    }

    let mut solution = [0.0; 3];
    for row in (0..3).rev() {
        let known: f32 = (row + 1..3).map(|k| rows[row][k] * solution[k]).sum();
        solution[row] = (rows[row][3] - known) / rows[row][row];
    }
    Some(solution)
}
