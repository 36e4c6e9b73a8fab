//! Items that combine traversal with the other tasks.

use glam::{DVec3, UVec2};
use judging::exam::{ExamQuestion, Key};
use judging::symptom::Symptom;
use protocol::{Geometry, Question, Ray, Rows, Shape, Table};

use super::{
    FIRST_UNREFERENCED, TRAVERSAL, linear_scan_control, ray_from_around, soup_tree, trace,
    unambiguous_rays,
};
use crate::items::{Declaration, groups, hits_key, meshes, picture, ray};
use crate::oracle::{Ray64, scan};
use crate::seed::Rng;
use crate::tree::{Tree, construction};

pub(super) const OWN_TREE: Declaration = Declaration {
    id: "traverse.own_tree",
    title: "traversal finds the closest hit in a leaf, in your own trees too",
    look: "Test all primitives with the ray shown, and find out where your traversal skips the \
           closest one or loses its hit. If all other items of both tasks pass, look for something \
           that sets your tree apart from the exam's trees.",
    look_fits: &[Symptom::MISS, Symptom::more("distance")],
    section: "traversal.md#your-own-builder-and-your-own-traversal",
    tests: &["Returns the ray's…"],
    questions: own_tree,
    needs: &[
        groups::TRIANGLE_HITS,
        groups::BOXES,
        groups::TREES,
        groups::TRIANGLE_SURFACE,
    ],
    ..TRAVERSAL
};

fn own_tree(rng: &mut Rng) -> Vec<ExamQuestion> {
    let mut questions = Vec::new();
    for (count, max_leaf_size) in [(400, 4), (260, 257)] {
        let shapes = meshes::soup(rng, count, 2.0, 0.5);
        let judged = &["distance"];
        let kind = ray_from_around;
        questions.push(own_tree_question(rng, shapes, max_leaf_size, judged, kind));
    }
    for (kind, count, max_leaf_size) in [(0, 1, 1), (1, 4, 2), (1, 40, 1), (0, 20, 20)] {
        let shapes = trace::shapes(rng, kind, count);
        let judged = &trace::QUANTITIES;
        let kind = trace::ray_with_range;
        questions.push(own_tree_question(rng, shapes, max_leaf_size, judged, kind));
    }
    questions.push(long_row(rng));
    let rays = rng.list(8, |rng| ray(4.0 * rng.direction(), rng.point(1.0)));
    questions.push(built_tree_question(vec![], 4, &["distance"], rays));
    questions.push(linear_scan_control(rng));
    questions
}

/// Creates a question about the tree that a submission builds.
fn own_tree_question(
    rng: &mut Rng,
    shapes: Vec<Shape>,
    max_leaf_size: u32,
    judged: &[&str],
    kind: impl FnMut(&mut Rng, &Tree) -> Ray,
) -> ExamQuestion {
    let tree = construction::median_split(shapes, 4);
    let rays = unambiguous_rays(rng, &tree, [26, 10], kind);
    built_tree_question(tree.shapes, max_leaf_size, judged, rays)
}

fn built_tree_question(
    shapes: Vec<Shape>,
    max_leaf_size: u32,
    judged: &[&str],
    rays: Vec<Ray>,
) -> ExamQuestion {
    let key = hits_key(judged, &rays, |ray64| scan::closest_hit(ray64, &shapes));
    let built = Geometry::BuiltTree {
        shapes,
        max_leaf_size,
    };
    ExamQuestion::new(Question::hits(built, rays), key)
}

/// Creates a question about a row of as many triangles as in a typical mesh. The rays enter every
/// node, since they pass through a corner of every box, but they hit only the larger triangle at
/// the end.
fn long_row(rng: &mut Rng) -> ExamQuestion {
    const COUNT: usize = 5000;
    const STEP: f64 = 0.02;
    let axis = rng.index(3);
    let axes = [0, 1, 2].map(|next| rng.sign() * DVec3::AXES[(axis + next) % 3]);
    let [along, y, z] = axes;
    let triangles = (0..COUNT).map(|index| {
        let size = if index + 1 == COUNT { 9.0 } else { 1.0 };
        let corner =
            |ahead: f64, across: DVec3| STEP * (index as f64 + ahead) * along + across - (y + z);
        let corners = [
            corner(0.3, DVec3::ZERO),
            corner(0.0, 2.0 * size * y),
            corner(0.0, 2.0 * size * z),
        ];
        meshes::flat_triangle(corners, 0)
    });
    let length = STEP * COUNT as f64;
    let rays = (0..12).map(|index| {
        let ahead = rng.uniform(1.5, 2.5);
        let mut across = |axis: DVec3| rng.uniform(0.8, 0.9) * axis;
        let start = across(y) + across(z) - ahead * along;
        let ray = Ray::new(start.as_vec3(), along.as_vec3());
        match index % 6 {
            0 => ray.within(0.0, rng.uniform(0.2, 0.9) as f32 * length as f32),
            1 => ray.within(0.0, rng.uniform(0.8, 0.9) as f32 * length as f32),
            2 => ray.within(0.0, 1.5 * length as f32),
            _ => ray,
        }
    });
    let rays = rays.collect();
    built_tree_question(meshes::number_shapes(triangles), 1, &["distance"], rays)
}

pub(super) const PICTURE: Declaration = Declaration {
    id: "traverse.picture",
    title: "a picture of the primitives in a tree is correct in every quantity",
    look: "Follow the ray of one wrong pixel from the root: which nodes should it enter, and which \
           primitives should it test? If your traversal leaves a primitive out, see whether it \
           skips a node or keeps a farther hit instead.",
    section: "grading.md#reading-a-wrong-picture",
    tests: &["Returns the ray's…"],
    questions: picture,
    needs: &[
        groups::TRIANGLE_HITS,
        groups::BOXES,
        groups::TRIANGLE_SURFACE,
    ],
    ..TRAVERSAL
};

fn picture(rng: &mut Rng) -> Vec<ExamQuestion> {
    let tree = soup_tree(rng, 300, 0.4, 4);
    let mut tree = tree.with_roots_at_both_ends(rng);
    let side = rng.sign();
    let eye = DVec3::new(rng.uniform(0.2, 0.8), rng.uniform(-0.8, 0.8), 4.5 * side);
    let camera = picture::camera_along(eye.as_vec3(), (-eye).normalize(), 0.5, 64);
    // An unreferenced triangle covers one half of the view, just in front of the tree.
    let corner = |x: f64, y: f64| DVec3::new(x, y, 3.0 * side);
    let curtain = [corner(-4.0, -4.0), corner(0.3, 0.6), corner(-4.0, 4.0)];

    let nearest = |ray64: &Ray64| scan::closest_hit(ray64, &tree.shapes);
    let key = picture::first_hits_key(&camera, nearest);
    tree.shapes
        .push(meshes::flat_triangle(curtain, FIRST_UNREFERENCED));
    let question = Question::Hit(Table {
        subject: tree.geometry(),
        rows: Rows::Picture(camera),
    });
    vec![ExamQuestion::new(question, key), linear_scan_control(rng)]
}

/// The item that compares a picture rendered in clay with the reference's picture.
pub(super) const RADIANCE: Declaration = Declaration {
    id: "traverse.radiance",
    points: 2,
    title: "all tasks together render the Cornell box in clay",
    look: "All random numbers come from the framework, so your picture must match the correct one \
           except for a few pixels. If only this item fails, look at the output of cargo render \
           cornell-box --view clay.",
    section: "grading.md#reading-a-wrong-picture",
    tests: &["Returns the ray's…"],
    questions: |rng| vec![clay_picture(rng), linear_scan_control(rng)],
    needs: &[
        groups::TRIANGLE_HITS,
        groups::BOXES,
        groups::CAMERA_RAYS,
        groups::TRIANGLE_SURFACE,
        groups::TREES,
    ],
    ..TRAVERSAL
};

/// Creates the question about a picture in clay. The key is empty until the reference has
/// rendered the picture.
fn clay_picture(rng: &Rng) -> ExamQuestion {
    const SCENE: &str = include_str!(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../scenes/cornell-box.json"
    ));
    /// The number of the 1024 pixels that may differ. In measurements, other correct formulas
    /// changed no pixels, and cracks of 1e-4 between triangles changed 13.
    const MAX_WRONG_PIXELS: u32 = 7;
    let question = Question::Radiance {
        scene: SCENE.to_owned(),
        film: UVec2::splat(32),
        samples: 32,
        seed: rng.sequence("traverse.radiance.seed").index(1 << 30) as u64,
    };
    let key = Key::Radiance {
        pixels: Vec::new(),
        max_wrong_pixels: MAX_WRONG_PIXELS,
    };
    ExamQuestion::new(question, key)
}
