//! Items that combine traversal with the other tasks.

use glam::{DVec3, UVec2, Vec3};
use judging::exam::{ExamQuestion, Key};
use protocol::{Geometry, Question, Rows, Table};

use super::{
    FIRST_UNREFERENCED, TRAVERSAL, linear_scan_control, ray_from_around, soup_tree,
    unambiguous_rays,
};
use crate::items::{Declaration, DeclaredItem, Group, hits_key, meshes, picture};
use crate::oracle::{Ray64, scan};
use crate::seed::{Rng, Seed};

pub(super) const OWN_TREE: Declaration = Declaration {
    id: "traverse.own_tree",
    title: "traversing your own tree finds the same hits as testing every primitive",
    look: "Test all primitives with the ray shown, and find out where your traversal skips the \
           closest one or loses its hit. If all other items of both tasks pass, look for something \
           that your tree has and the exam's trees do not.",
    section: "traversal.md#your-own-builder-and-your-own-traversal",
    questions: |rng| {
        let tree = soup_tree(rng, 400, 0.5, 4);
        let rays = unambiguous_rays(rng, &tree, [40, 16], ray_from_around);
        let key = hits_key(&["distance"], &rays, |ray64| {
            scan::closest_hit(ray64, &tree.shapes)
        });
        let built = Geometry::BuiltTree {
            shapes: tree.shapes,
            max_leaf_size: 4,
        };
        let question = Question::hits(built, rays);
        vec![ExamQuestion::new(question, key), linear_scan_control(rng)]
    },
    needs: &[Group::TriangleHits, Group::Boxes, Group::Trees],
    ..TRAVERSAL
};

pub(super) const PICTURE: Declaration = Declaration {
    id: "traverse.picture",
    points: 2,
    title: "a picture through a tree is correct in hits, depth, normals and uv",
    look: "Follow the ray of one wrong pixel from the root: which nodes should it enter, and which \
           primitives should it test? If a piece is missing there, see whether your code skips it \
           or loses it to a farther hit.",
    section: "grading.md#reading-a-wrong-picture",
    questions: picture,
    needs: &[Group::TriangleHits, Group::Boxes, Group::TriangleSurface],
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

/// Returns the question of the radiance item. Its key is the reference's answer to the same
/// question.
pub fn radiance_question(seed: Seed, scene: String) -> Question {
    let mut rng = seed.rng("traverse.radiance.seed");
    Question::Radiance {
        scene,
        film: UVec2::splat(32),
        samples: 16,
        bounces: 3,
        seed: rng.index(1 << 30) as u64,
    }
}

/// A question about a path-traced picture, and the picture that the reference draws for it.
#[derive(Clone, Debug)]
pub struct RecordedPicture {
    /// The question.
    pub question: Question,
    /// Linear red, green and blue of each pixel, row by row from the bottom.
    pub pixels: Vec<Vec3>,
}

/// The item that compares a path-traced picture with the reference's, without its first question, which
/// is recorded.
const RADIANCE: Declaration = Declaration {
    id: "traverse.radiance",
    points: 2,
    title: "all tasks together render the Cornell box",
    look: "The framework draws every random number, so the picture must be the same except for a few \
           pixels. If only this item fails, look at the output of cargo render.",
    section: "grading.md#reading-a-wrong-picture",
    questions: |rng| vec![linear_scan_control(rng)],
    needs: &[
        Group::TriangleHits,
        Group::Boxes,
        Group::CameraRays,
        Group::TriangleSurface,
        Group::Trees,
    ],
    ..TRAVERSAL
};

/// Returns the item with the picture that the reference draws.
pub fn radiance_item(seed: Seed, recorded: RecordedPicture) -> DeclaredItem {
    /// The maximum number of the 1024 pixels that may differ. In measurements, other correct
    /// formulas changed none, and cracks of 1e-4 between triangles changed 13.
    const MAX_WRONG_PIXELS: u32 = 7;
    let key = Key::Radiance {
        pixels: recorded.pixels,
        max_wrong_pixels: MAX_WRONG_PIXELS,
    };
    let mut item = RADIANCE.draw(seed);
    let picture = ExamQuestion::new(recorded.question, key);
    item.questions().insert(0, picture);
    item
}
