/// Returns the area of the box around some boxes.
fn area_around(boxes: &[BBox]) -> f32 {
    let mut all = BBox::EMPTY;
    for bbox in boxes {
        all.enclose(*bbox);
    }
    all.surface_area()
}
