// The contents of a pack: spheres, or triangles with at most eight distinct corners.

/// Returns the registers for a pack of the spheres with these indices.
fn sphere_registers(indices: impl Iterator<Item = u32>) -> [[u32; 8]; 4] {
    let (mut lanes, mut words) = ([NO_SPHERE; 8], [Word::default(); 8]);
    for (lane, index) in lanes.iter_mut().zip(indices) {
        *lane = index;
    }
    words[Pack::SPHERES_FLAG].set_flag();
    [lanes, [0; 8], [0; 8], words.map(|Word(word)| word)]
}

/// The index in a lane without a sphere. No primitive has this index.
const NO_SPHERE: u32 = u32::MAX;

fn positions(triangle: &Triangle) -> [Vec3; 3] {
    [&triangle.p0, &triangle.p1, &triangle.p2].map(|corner| corner.position)
}

/// Returns whether all shading data can be computed from the corners.
fn is_flat(triangle: &Triangle) -> bool {
    let corners = [&triangle.p0, &triangle.p1, &triangle.p2];
    Shape::flat_triangle_vertices(positions(triangle))
        .iter()
        .eq(corners)
}

/// The distinct corners of some triangles, at most eight.
#[derive(Default)]
struct Corners {
    positions: [Vec3; 8],
    len: usize,
}

impl Corners {
    /// Returns the lane of a corner, adding the corner if it is new, or `None` if all lanes are
    /// used.
    fn lane(&mut self, position: Vec3) -> Option<u32> {
        let mut known = self.positions[..self.len].iter();
        let lane = known.position(|known| *known == position);
        if lane.is_none() {
            *self.positions.get_mut(self.len)? = position;
            self.len += 1;
        }
        Some(lane.unwrap_or(self.len - 1) as u32)
    }

    fn registers(&self) -> [[u32; 8]; 3] {
        [0, 1, 2].map(|axis| self.positions.map(|position| position[axis].to_bits()))
    }
}

/// Returns whether the primitives with these indices fit in one pack.
fn fits_in_pack(primitives: &[Primitive], indices: impl ExactSizeIterator<Item = usize>) -> bool {
    let (mut corners, mut triangles, mut spheres) = (Corners::default(), 0, 0);
    indices.len() <= 8
        && indices
            .map(|index| &primitives[index])
            .all(|primitive| match primitive {
                Primitive::Triangle(triangle) => {
                    triangles += 1;
                    let mut positions = positions(triangle).into_iter();
                    positions.all(|position| corners.lane(position).is_some())
                }
                Primitive::Sphere(_) => {
                    spheres += 1;
                    true
                }
            })
        && (triangles == 0 || spheres == 0)
}

/// Converts an index to `u32` and checks that it leaves the bit [`LEAF`] free.
fn to_u32(index: usize) -> u32 {
    let index = u32::try_from(index).ok().filter(|&index| index < LEAF);
    index.expect("there are fewer than 2^31 lines and primitives")
}
