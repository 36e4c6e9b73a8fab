//! What is looked at: real meshes from a folder, where there is one, else a scene of our own.

use std::fs::{self, File};
use std::io::{BufReader, Read};
use std::path::{Path, PathBuf};

use flate2::read::GzDecoder;
use glam::{Vec3, vec3};
use protocol::Shape;
use reference::bbox::BBox;

/// Triangles, and from where they are looked at.
pub struct Mesh {
    pub name: String,
    pub corners: Vec<[Vec3; 3]>,
    pub bbox: BBox,
    /// Whether it is a building, which is looked at from inside.
    pub is_building: bool,
}

/// The three of the research, with the names of their files.
const FILES: [(&str, &str, bool); 3] = [
    ("bunny", "bunny69k.obj.gz", false),
    ("sponza", "sponza66k.obj.gz", true),
    ("dragon", "dragon871k.obj.gz", false),
];

/// Those in the folder that the variable `MESHES` names, or our own. `ONLY` picks one by its name.
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
            println!(
                "MESHES names no folder with bunny69k.obj.gz, ...: a scene of our own instead"
            );
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

    /// As questions and scenes have them.
    pub fn shapes(&self) -> impl Iterator<Item = Shape> {
        let shape = |(material, corners): (u32, &[Vec3; 3])| Shape::FlatTriangle {
            corners: *corners,
            material,
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

/// Vertices and triangles of an OBJ file; whatever else may stand there does not matter here.
fn parse_obj(text: &str, path: &Path) -> Vec<[Vec3; 3]> {
    let number = |word: &str| word.parse::<f32>().expect("a coordinate");
    let place = |word: &str| {
        let place = word.split('/').next().unwrap_or_default();
        place.parse::<usize>().expect("the number of a vertex") - 1
    };
    let mut points = Vec::new();
    let mut triangles = Vec::new();
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words[..] {
            ["v", x, y, z, ..] => points.push(vec3(number(x), number(y), number(z))),
            ["f", a, b, c] => triangles.push([a, b, c].map(|word| points[place(word)])),
            ["f", ..] => panic!("{}: triangles only, not `{line}`", path.display()),
            _ => {}
        }
    }
    triangles
}

/// The largest of the project's own scenes, its triangles divided as there: into four, twice.
fn gyroid() -> Vec<[Vec3; 3]> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/gyroid.obj");
    let quarters = |[a, b, c]: [Vec3; 3]| {
        let (ab, bc, ca) = (a.midpoint(b), b.midpoint(c), c.midpoint(a));
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    };
    let text = fs::read_to_string(&path).expect("the mesh is part of the project");
    let triangles = parse_obj(&text, &path).into_iter();
    triangles.flat_map(quarters).flat_map(quarters).collect()
}
