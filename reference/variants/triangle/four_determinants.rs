// Applies Cramer's rule as in a textbook: computes the determinant of the matrix and of three
// matrices with one column replaced.

use glam::Mat3;

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        self.cramer(ray, |a, b, c| Mat3::from_cols(a, b, c).determinant())
    }
}
