// Applies Cramer's rule with all cofactors written out, and computes t before the weights. This
// follows Marschner and Shirley, "Fundamentals of Computer Graphics" (4th edition), section 4.4.2,
// with the book's variable names.

impl Triangle {
    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let [p0, p1, p2] = [self.p0, self.p1, self.p2].map(|corner| corner.position);
        let [a, b, c] = (p0 - p1).to_array();
        let [d, e, f] = (p0 - p2).to_array();
        let [g, h, i] = ray.dir.to_array();
        let [j, k, l] = (p0 - ray.origin).to_array();

        let ei_minus_hf = e * i - h * f;
        let gf_minus_di = g * f - d * i;
        let dh_minus_eg = d * h - e * g;
        let m = a * ei_minus_hf + b * gf_minus_di + c * dh_minus_eg;
        if m == 0.0 {
            return None;
        }

        let ak_minus_jb = a * k - j * b;
        let jc_minus_al = j * c - a * l;
        let bl_minus_kc = b * l - k * c;
        let t = -(f * ak_minus_jb + e * jc_minus_al + d * bl_minus_kc) / m;
        if t < ray.range.min || t > ray.range.max {
            return None;
        }

        let gamma = (i * ak_minus_jb + h * jc_minus_al + g * bl_minus_kc) / m;
        if !(0.0..=1.0).contains(&gamma) {
            return None;
        }

        let beta = (j * ei_minus_hf + k * gf_minus_di + l * dh_minus_eg) / m;
        if beta < 0.0 || beta > 1.0 - gamma {
            return None;
        }
        Some(self.trace_at(ray, t, beta, gamma))
    }
}
