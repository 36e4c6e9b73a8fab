//! Loads the meshes: well-known ones if the environment variable `MESHES` is set to the folder with
//! their files, otherwise a mesh from this project's scenes.

use std::fs::{self, File};
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

use flate2::read::GzDecoder;
use glam::{Vec3, vec3};
use protocol::Shape;
use reference::bbox::BBox;

/// A triangle mesh. Its box determines the position of the camera.
pub struct Mesh {
    pub name: String,
    pub corners: Vec<[Vec3; 3]>,
    pub bbox: BBox,
    /// Whether the mesh is a building. If it is, the camera is inside.
    pub is_building: bool,
}

/// The names of three well-known meshes, their files, and whether they are buildings.
const FILES: [(&str, &str, bool); 3] = [
    ("bunny", "bunny69k.obj.gz", false),
    ("sponza", "sponza66k.obj.gz", true),
    ("dragon", "dragon871k.obj.gz", false),
];

/// Returns the meshes in the folder named by the variable `MESHES`. If the variable isn't set,
/// returns one of this project's meshes. The variable `ONLY` selects one mesh in the folder by
/// name.
pub fn meshes() -> Vec<Mesh> {
    let only = std::env::var("ONLY").ok();
    match std::env::var_os("MESHES").map(PathBuf::from) {
        Some(folder) => FILES
            .iter()
            .filter(|(name, _, _)| only.as_deref().is_none_or(|only| only == *name))
            .map(|(name, file, is_building)| {
                let path = folder.join(file);
                let corners = parse_obj(&read_gzip(&path), &path);
                Mesh::new(name, corners, *is_building)
            })
            .collect(),
        None => {
            println!("MESHES is not set: using scenes/gyroid.obj");
            vec![Mesh::new("gyroid", gyroid(), false)]
        }
    }
}

impl Mesh {
    fn new(name: &str, corners: Vec<[Vec3; 3]>, is_building: bool) -> Self {
        let mut bbox = BBox::EMPTY;
        for point in corners.iter().flatten() {
            bbox.enclose_point(*point);
        }
        Mesh {
            name: name.to_owned(),
            corners,
            bbox,
            is_building,
        }
    }

    /// Returns the triangles as shapes.
    pub fn shapes(&self) -> impl Iterator<Item = Shape> {
        let shape = |(shape, corners): (u32, &[Vec3; 3])| Shape::FlatTriangle {
            corners: *corners,
            shape,
        };
        (0..).zip(&self.corners).map(shape)
    }
}

fn read_gzip(path: &Path) -> String {
    let file = File::open(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut text = String::new();
    let read = GzDecoder::new(BufReader::new(file)).read_to_string(&mut text);
    read.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    text
}

/// Parses the vertices and triangles of an OBJ file. Ignores everything else.
fn parse_obj(text: &str, path: &Path) -> Vec<[Vec3; 3]> {
    let number = |word: &str| word.parse::<f32>().expect("coordinates are numbers");
    let index = |word: &str| {
        let number = word.split('/').next().unwrap_or_default();
        number.parse::<usize>().expect("faces have vertex numbers") - 1
    };
    let mut points = Vec::new();
    let mut triangles = Vec::new();
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["v", x, y, z, ..] => points.push(vec3(number(x), number(y), number(z))),
            ["f", a, b, c] => triangles.push([a, b, c].map(|word| points[index(word)])),
            ["f", ..] => panic!("{}: `{line}` is not a triangle", path.display()),
            _ => {}
        }
    }
    triangles
}

/// Returns the largest of this project's meshes. As in the scene that uses it, each triangle is
/// split into four, twice.
fn gyroid() -> Vec<[Vec3; 3]> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gyroid.obj");
    let quarters = |[a, b, c]: [Vec3; 3]| {
        let (ab, bc, ca) = (a.midpoint(b), b.midpoint(c), c.midpoint(a));
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    };
    let text = fs::read_to_string(&path).expect("scenes/gyroid.obj is in the repository");
    let triangles = parse_obj(&text, &path).into_iter();
    triangles.flat_map(quarters).flat_map(quarters).collect()
}
