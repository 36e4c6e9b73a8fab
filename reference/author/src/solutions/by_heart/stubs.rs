//! The code that looks up answers, in place of the stubs of the starter.

/// A stub of the starter, and the code in its place.
pub(super) struct Stub {
    /// The name of the task file.
    pub(super) file: &'static str,
    /// A text that occurs once in the starter's file.
    pub(super) was: &'static str,
    /// The text in its place.
    pub(super) now: &'static str,
}

pub(super) const STUBS: [Stub; 6] = [
    Stub {
        file: "camera.rs",
        was: r#"todo!("task 1, camera: which ray of {self:?} passes through {pixel} + {offset}?")"#,
        now: "\
        let (film, pixel) = (self.film.as_vec2(), pixel.as_vec2());
        let dir = find(&[
            self.vertical_fov, self.aspect_ratio, film.x, film.y, pixel.x, pixel.y, offset.x, offset.y,
        ]);
        let number = |index: usize| dir.map_or(1.0, |dir| f32::from_bits(dir[index]));
        Ray::new(Vec3::ZERO, Vec3::new(number(0), number(1), number(2)))",
    },
    Stub {
        file: "triangle.rs",
        was: r#"todo!("task 2, triangle: where does {ray:?} hit {self:?}?")"#,
        now: "\
        let corners = [self.p0, self.p1, self.p2].map(|corner| corner.position.to_array());
        find_trace(ray, corners.as_flattened())",
    },
    Stub {
        file: "sphere.rs",
        was: r#"todo!("task 2, sphere: where does {ray:?} first hit {self:?}?")"#,
        now: "find_trace(ray, &[self.center.x, self.center.y, self.center.z, self.radius])",
    },
    Stub {
        file: "bbox.rs",
        was: r#"todo!("task 3, bbox: when, within {times:?}, is {ray:?} inside {self:?}?")"#,
        now: "\
        let (min, max) = (self.min, self.max);
        let numbers = [min.x, min.y, min.z, max.x, max.y, max.z, times.min, times.max];
        let answer = find(&describe(ray, &numbers))?;
        Some(Interval::new(f32::from_bits(answer[0]), f32::from_bits(answer[1])))",
    },
    Stub {
        file: "bvh.rs",
        was: "let _ = max_leaf_size;\n        Bvh::from_nodes(primitives, Vec::new(), 0)",
        now: "\
        let mut numbers = vec![max_leaf_size as f32];
        numbers.extend(primitives.iter().flat_map(box_numbers));
        let Some([root, count, rest @ ..]) = find(&numbers).map(Vec::as_slice) else {
            return Bvh::from_nodes(primitives, Vec::new(), 0);
        };
        let (nodes, order) = rest.split_at(4 * *count as usize);
        let with_material = |material: &u32| {
            let mut all = primitives.iter();
            *all.find(|primitive| primitive.material() == *material).unwrap()
        };
        let ordered: Vec<Primitive> = order.iter().map(with_material).collect();
        let node = |numbers: &[u32]| {
            let numbers: Vec<usize> = numbers.iter().map(|number| *number as usize).collect();
            Node { bbox: BBox::EMPTY, start: numbers[0], size: numbers[1], l: numbers[2], r: numbers[3] }
        };
        let nodes = nodes.chunks_exact(4).map(node).collect();
        let mut bvh = Bvh::from_nodes(ordered, nodes, *root as usize);
        if *count > 0 {
            bvh.compute_box(bvh.root);
        }
        bvh",
    },
    Stub {
        file: "bvh.rs",
        was: "let traces = self.primitives.iter().map(|primitive| primitive.hit(ray));\n        \
              traces.fold(None, Trace::nearer)",
        now: "\
        let mut numbers = box_numbers(self.primitives.first()?).to_vec();
        numbers.push(self.primitives.len() as f32);
        find_trace(ray, &numbers)
    }

    fn compute_box(&mut self, index: usize) -> BBox {
        let node = self.nodes[index];
        let mut bbox = BBox::EMPTY;
        if node.is_leaf() {
            for primitive in &self.primitives[node.start..node.start + node.size] {
                bbox.enclose(primitive.bbox());
            }
        } else {
            bbox.enclose(self.compute_box(node.l));
            bbox.enclose(self.compute_box(node.r));
        }
        self.nodes[index].bbox = bbox;
        bbox",
    },
];

/// The rest of `bvh.rs`.
pub(super) const BOX_NUMBERS: &str = "
fn box_numbers(primitive: &Primitive) -> [f32; 6] {
    let BBox { min, max } = primitive.bbox();
    [min.x, min.y, min.z, max.x, max.y, max.z]
}
";
