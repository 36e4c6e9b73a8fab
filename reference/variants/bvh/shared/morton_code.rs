/// Returns a point's position along the Z-order curve that fills the box: 16 bits for each axis,
/// interleaved.
fn morton_code(point: glam::Vec3, bbox: &BBox) -> u64 {
    let size = (bbox.max - bbox.min).max(glam::Vec3::splat(f32::MIN_POSITIVE));
    let cell = ((point - bbox.min) / size * 65535.0).as_uvec3();
    (0..16).fold(0, |code, bit| {
        let [x, y, z] = cell
            .to_array()
            .map(|component| u64::from(component >> bit & 1));
        code | (x << 2 | y << 1 | z) << (3 * bit)
    })
}
