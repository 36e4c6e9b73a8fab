    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest = None;
        self.slides_hit(ray, self.root, &mut closest);
        closest
    }

    // The slides' pseudo-code, taken literally.
    fn slides_hit(&self, ray: &Ray, index: usize, closest: &mut Option<Trace>) {
        let node = &self.nodes[index];
        if node.is_leaf() {
            for primitive in &self.primitives[node.start..node.start + node.size] {
                *closest = Trace::nearer(*closest, primitive.hit(ray));
            }
            return;
        }
        let entry = |child: usize| {
            let inside = self.nodes[child].bbox.hit(ray, ray.range);
            inside.map_or(f32::INFINITY, |inside| inside.min)
        };
        let (hit1, hit2) = (entry(node.l), entry(node.r));
        let (first, second) = if hit1 <= hit2 { (node.l, node.r) } else { (node.r, node.l) };
        self.slides_hit(ray, first, closest);
        if closest.is_none_or(|closest| hit2 < closest.distance) {
            self.slides_hit(ray, second, closest);
        }
    }
