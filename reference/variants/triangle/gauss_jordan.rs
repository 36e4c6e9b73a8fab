// Solves the three equations by Gauss-Jordan elimination in double precision. The solver works for
// any number of equations.

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let corner = self.p0.position.as_dvec3();
        let e1 = self.p1.position.as_dvec3() - corner;
        let e2 = self.p2.position.as_dvec3() - corner;
        let s = ray.origin.as_dvec3() - corner;

        let matrix = [0, 1, 2].map(|axis| [e1[axis], e2[axis], -f64::from(ray.dir[axis])]);
        let [u, v, t] = solve(matrix, s.to_array())?;
        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
        let (u, v, t) = (u as f32, v as f32, t as f32);
        (inside && ray.range.contains(t)).then(|| self.trace_at(ray, t, u, v))
    }
}

/// Solves N linear equations, or returns `None` if the solution isn't unique.
fn solve<const N: usize>(mut matrix: [[f64; N]; N], mut right: [f64; N]) -> Option<[f64; N]> {
    for column in 0..N {
        let size = |row: &usize| matrix[*row][column].abs();
        let pivot = (column..N).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        matrix.swap(column, pivot);
        right.swap(column, pivot);

        let scale = matrix[column][column];
        if scale == 0.0 {
            return None;
        }
        matrix[column] = matrix[column].map(|entry| entry / scale);
        right[column] /= scale;
        let (pivot_row, pivot_right) = (matrix[column], right[column]);
        for row in (0..N).filter(|&row| row != column) {
            let factor = matrix[row][column];
            for (entry, pivot) in matrix[row].iter_mut().zip(pivot_row) {
                *entry -= factor * pivot;
            }
            right[row] -= factor * pivot_right;
        }
    }
    Some(right)
}
