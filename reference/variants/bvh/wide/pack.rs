// The leaves in memory, and the test of a ray against eight triangles.

/// A leaf with up to eight triangles, or with the indices of up to eight spheres.
///
/// The triangles have at most eight distinct corners, because neighbours share them. Three
/// registers hold the corners' coordinates, and the fourth holds one word per triangle with the
/// lanes of its corners. A lane without a triangle contains the same corner three times, so no ray
/// hits it.
struct Pack<'a>(&'a [CacheLine; Pack::LINES]);

/// A word that describes a triangle. It packs the lanes of the three corners (three bits each), 22
/// bits of extra data, and a flag.
#[derive(Clone, Copy, Default)]
struct Word(u32);

impl Word {
    /// The end (exclusive) of the extra data.
    const EXTRA_LIMIT: u32 = 1 << 22;
    const FLAG: u32 = 1 << 31;

    fn new([a, b, c]: [u32; 3]) -> Self {
        Word(a | b << 3 | c << 6)
    }

    fn corners(self) -> [usize; 3] {
        [0, 3, 6].map(|shift| (self.0 >> shift & 7) as usize)
    }

    fn set_extra(&mut self, extra: u32) {
        self.0 |= extra << 9;
    }

    fn extra(self) -> u32 {
        self.0 >> 9 & (Word::EXTRA_LIMIT - 1)
    }

    fn set_flag(&mut self) {
        self.0 |= Word::FLAG;
    }

    fn is_flagged(self) -> bool {
        self.0 & Word::FLAG != 0
    }
}

fn cross(a: &[f32x8; 3], b: &[f32x8; 3]) -> [f32x8; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

fn dot(a: &[f32x8; 3], b: &[f32x8; 3]) -> f32x8 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

impl<'a> Pack<'a> {
    const LINES: usize = 2;

    /// The lane whose flag marks a pack of spheres.
    const SPHERES_FLAG: usize = 0;
    /// The lane whose flag marks a pack with triangles that aren't flat. In that case, the extra
    /// data of the first two words is the index of the first triangle's surface. Otherwise, the
    /// extra data of each word is the triangle's number.
    const SURFACES_FLAG: usize = 1;

    fn at(lines: &'a [CacheLine], start: u32) -> Self {
        Pack(lines_at(lines, start))
    }

    fn lines(registers: [[u32; 8]; 4]) -> [CacheLine; Pack::LINES] {
        let [x, y, z, words] = registers.map(cast);
        [CacheLine([x, y]), CacheLine([z, words])]
    }

    fn word(&self, lane: usize) -> Word {
        let CacheLine([_, words]) = &self.0[1];
        Word(words.as_array()[lane].to_bits())
    }

    fn has_flag(&self, lane: usize) -> bool {
        self.word(lane).is_flagged()
    }

    /// Returns the indices of the spheres.
    fn spheres(&self) -> impl Iterator<Item = u32> {
        let CacheLine([indices, _]) = &self.0[0];
        let indices = indices.to_array().map(f32::to_bits);
        indices.into_iter().take_while(|&index| index != NO_SPHERE)
    }

    /// Returns the index of the triangle's surface, or `None` if all triangles of the pack are
    /// flat.
    fn surface_index(&self, lane: usize) -> Option<u32> {
        let first = || self.word(0).extra() + self.word(1).extra() * Word::EXTRA_LIMIT;
        self.has_flag(Pack::SURFACES_FLAG)
            .then(|| first() + lane as u32)
    }

    fn shading(&self, lane: usize) -> Shading {
        if let Some(index) = self.surface_index(lane) {
            return Shading::Stored { index };
        }
        let word = self.word(lane);
        let [CacheLine([x, y]), CacheLine([z, _])] = self.0;
        let [p0, p1, p2] = word
            .corners()
            .map(|corner| Vec3::from([x, y, z].map(|lanes| lanes.as_array()[corner])));
        Shading::Computed {
            normal: (p1 - p0).cross(p2 - p0).normalize(),
            shape: word.extra(),
        }
    }

    /// Returns the three corners of each triangle.
    fn corners(&self) -> [[f32x8; 3]; 3] {
        let [CacheLine([x, y]), CacheLine([z, words])] = *self.0;
        let [x, y, z, words]: [u32x8; 4] = [x, y, z, words].map(cast);
        [words, words >> 3, words >> 6].map(|corner| {
            let corner = corner & u32x8::splat(7);
            [x, y, z].map(|lanes| cast(lanes.shuffle(corner)))
        })
    }

    /// Tests eight triangles with Möller and Trumbore's algorithm and returns the closest hit up to
    /// `max`.
    fn hit(&self, wide_ray: &WideRay, max: f32) -> Option<PackHit> {
        let [p0, p1, p2] = self.corners();
        let from = |p: &[f32x8; 3]| [0, 1, 2].map(|axis| p[axis] - p0[axis]);
        let (e1, e2, s) = (from(&p1), from(&p2), from(&wide_ray.origin));

        let p = cross(&wide_ray.dir, &e2);
        let q = cross(&s, &e1);
        // Only hits need a division: u, v and t are compared with multiples of the determinant,
        // after both sides have been multiplied by its sign.
        let determinant = dot(&p, &e1);
        let sign = determinant & f32x8::splat(-0.0);
        let determinant = determinant ^ sign;
        let u = dot(&p, &s) ^ sign;
        let v = dot(&q, &wide_ray.dir) ^ sign;
        let t = dot(&q, &e2) ^ sign;
        // Comparisons with NaN are false, so NaN is never a hit.
        let inside = u.simd_ge(f32x8::ZERO) & v.simd_ge(f32x8::ZERO) & (u + v).simd_le(determinant);
        let latest = f32x8::splat(max) * determinant;
        let ahead = t.simd_ge(wide_ray.min * determinant) & t.simd_le(latest);
        let mut mask = (inside & ahead & determinant.simd_gt(f32x8::ZERO)).to_bitmask();
        if mask == 0 {
            return None;
        }

        let [u, v, t] = [u, v, t].map(|times| (times / determinant).to_array());
        let range = Interval::new(wide_ray.min.as_array()[0], max);
        let mut nearest: Option<PackHit> = None;
        while mask != 0 {
            let lane = mask.trailing_zeros() as usize & 7;
            mask &= mask - 1;
            if range.contains(t[lane]) && nearest.as_ref().is_none_or(|hit| t[lane] <= hit.distance)
            {
                nearest = Some(PackHit {
                    distance: t[lane],
                    lane,
                    u: u[lane],
                    v: v[lane],
                });
            }
        }
        nearest
    }
}

/// A hit on a triangle in a pack. `u` and `v` are the barycentric weights of its second and third
/// corners.
struct PackHit {
    distance: f32,
    lane: usize,
    u: f32,
    v: f32,
}

/// The source of a triangle's shading data.
enum Shading {
    /// Computed from the corners. See [`Shape::flat_triangle_vertices`].
    Computed { normal: Vec3, shape: u32 },
    /// The surface with this index.
    Stored { index: u32 },
}

/// The shading data of a triangle, in one cache line.
#[derive(Clone, Debug)]
#[repr(align(64))]
struct Surface {
    normals: [Vec3; 3],
    uvs: [Vec2; 3],
    shape: u32,
}

impl Surface {
    fn new(triangle: &Triangle) -> Self {
        let Triangle { p0, p1, p2, .. } = triangle;
        Surface {
            normals: [p0.normal, p1.normal, p2.normal],
            uvs: [p0.uv, p1.uv, p2.uv],
            shape: triangle.shape,
        }
    }

    /// Returns the normal, the texture coordinates and the shape's number at a point, given the
    /// weights of two corners.
    fn interpolate(&self, u: f32, v: f32) -> (Vec3, Vec2, u32) {
        let w = 1.0 - u - v;
        let [n0, n1, n2] = self.normals;
        let [uv0, uv1, uv2] = self.uvs;
        let normal = (w * n0 + u * n1 + v * n2).normalize();
        (normal, w * uv0 + u * uv1 + v * uv2, self.shape)
    }
}
