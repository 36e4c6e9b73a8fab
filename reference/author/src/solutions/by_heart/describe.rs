/// Returns the numbers that describe a question about a ray.
fn describe(ray: &Ray, of_shape: &[f32]) -> Vec<f32> {
    let Ray { origin, dir, range } = ray;
    let numbers = [origin.x, origin.y, origin.z, dir.x, dir.y, dir.z, range.min, range.max];
    numbers.iter().chain(of_shape).copied().collect()
}
