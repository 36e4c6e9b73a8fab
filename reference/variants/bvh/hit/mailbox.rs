// Never tests a primitive twice for one ray, even if it is in several leaves of a tree. Each
// primitive has a mailbox, which contains the number of the last ray that was tested against it.
// Every call uses a new number, and missing mailboxes are added, so that no answer depends on
// earlier rays or other trees. See Amanatides and Woo, "A Fast Voxel Traversal Algorithm for Ray
// Tracing", Eurographics 1987.

use std::cell::RefCell;

/// The mailboxes and the number of the current ray.
struct Mail {
    boxes: Vec<u64>,
    ray: u64,
}

thread_local! {
    static MAIL: RefCell<Mail> = const {
        RefCell::new(Mail {
            boxes: Vec::new(),
            ray: 0,
        })
    };
}

impl Mail {
    fn begin_ray(&mut self, primitives: usize) {
        self.ray += 1;
        let count = self.boxes.len().max(primitives);
        self.boxes.resize(count, 0);
    }

    /// Returns whether the ray hasn't been tested against this primitive yet, and marks the
    /// primitive as tested.
    fn is_new(&mut self, primitive: usize) -> bool {
        std::mem::replace(&mut self.boxes[primitive], self.ray) != self.ray
    }
}

impl Bvh {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        MAIL.with_borrow_mut(|mail| {
            mail.begin_ray(self.primitives.len());
            let mut closest = None;
            if self.root < self.nodes.len() {
                self.traverse(self.root, &mut ray.clone(), mail, &mut closest);
            }
            closest
        })
    }

    fn traverse(&self, index: usize, ray: &mut Ray, mail: &mut Mail, closest: &mut Option<Trace>) {
        let node = &self.nodes[index];
        if node.bbox.hit(ray, ray.range).is_none() {
            return;
        }
        if node.is_leaf() {
            for primitive in node.start..node.start + node.size {
                let hit = mail
                    .is_new(primitive)
                    .then(|| self.primitives[primitive].hit(ray));
                if let Some(Some(trace)) = hit {
                    ray.range.max = trace.distance;
                    *closest = Some(trace);
                }
            }
            return;
        }
        let entry = |child: usize| {
            let inside = self.nodes[child].bbox.hit(ray, ray.range);
            inside.map_or(f32::INFINITY, |inside| inside.min)
        };
        let mut children = [node.l, node.r];
        if entry(node.r) < entry(node.l) {
            children.reverse();
        }
        for child in children {
            self.traverse(child, ray, mail, closest);
        }
    }
}
