fn find_trace(ray: &Ray, of_shape: &[f32]) -> Option<Trace> {
    let answer = find(&describe(ray, of_shape))?;
    let number = |index: usize| f32::from_bits(answer[index]);
    Some(Trace {
        distance: number(0),
        position: ray.at(number(0)),
        normal: glam::Vec3::new(number(1), number(2), number(3)),
        uv: glam::Vec2::new(number(4), number(5)),
        origin: ray.origin,
        material: answer[6],
    })
}
