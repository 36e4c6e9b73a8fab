//! Everything together.

use glam::{DVec3, UVec2};
use grader::exam::{ExamQuestion, HitCheck, Item, Key};
use protocol::{Question, Rays};

use super::{
    FIRST_UNREFERENCED, item, needs, question_without_decoys, ray_from_around, soup_tree,
    unambiguous_rays,
};
use crate::items::{hits_key, meshes, picture};
use crate::oracle::scan::{self, Scan};
use crate::recording::RecordedPicture;
use crate::seed::{Rng, Seed};

/// A small question that the linear scan gets wrong, and every walk through a tree right.
fn linear_scan_control(draw: &mut Rng) -> ExamQuestion {
    let tree = soup_tree(draw, 12, 0.9, 1);
    question_without_decoys(draw, tree, [8, 4], ray_from_around)
}

pub(super) fn own_tree(seed: Seed) -> Item {
    let mut draw = seed.rng("traverse.own_tree");
    let tree = soup_tree(&mut draw, 400, 0.5, 4);
    let rays = unambiguous_rays(&mut draw, &tree, [40, 16], ray_from_around);
    let key = hits_key(&[HitCheck::Distance], &rays, |beam| {
        scan::closest_hit(beam, &tree.shapes)
    });
    let own = Question::BuildAndTraverse {
        shapes: tree.shapes,
        max_leaf_size: 4,
        rays: Rays::List(rays),
    };
    let item = item(
        "own_tree",
        1,
        [
            "your own tree, walked, finds what asking every primitive finds",
            "If all other items of both tasks pass, see what the tree that you build has and the \
             exam's do not.",
        ],
        vec![ExamQuestion::new(own, key), linear_scan_control(&mut draw)],
    );
    needs::add(item, &needs::TREES)
}

pub(super) fn picture(seed: Seed) -> Item {
    let mut draw = seed.rng("traverse.picture");
    let tree = soup_tree(&mut draw, 300, 0.4, 4);
    let mut tree = tree.with_roots_at_both_ends(&mut draw);
    let eye = DVec3::new(0.4, 0.7, 4.5);
    let view = picture::view_along(eye.as_vec3(), (-eye).normalize(), 0.5, 64);
    // An orphan before the left half of the view, right where the tree begins.
    let corner = |x: f64, y: f64| DVec3::new(x, y, 3.0);
    let curtain = [corner(-4.0, -4.0), corner(0.3, 0.6), corner(-4.0, 4.0)];

    let scan = Scan::new(&tree.shapes);
    let key = picture::first_hits_key(&view, |beam| scan.closest_hit(beam));
    tree.shapes
        .push(meshes::flat_triangle(curtain, FIRST_UNREFERENCED));
    let question = Question::Traverse {
        shapes: tree.shapes,
        nodes: tree.nodes,
        root: tree.root as u32,
        rays: Rays::View(view),
    };
    let item = item(
        "picture",
        2,
        [
            "a picture through a tree is right in hit, depth, normal and uv",
            "If pieces are missing, some nodes are skipped that should be entered; if pieces that \
             lie behind show, the closest hit is not kept.",
        ],
        vec![
            ExamQuestion::new(question, key),
            linear_scan_control(&mut draw),
        ],
    );
    needs::add(item, &needs::SURFACES)
}

/// What the radiance item asks; who records its key asks the reference the same.
pub fn radiance_question(seed: Seed, scene: String) -> Question {
    let mut draw = seed.rng("traverse.radiance.seed");
    Question::Radiance {
        scene,
        film: UVec2::splat(32),
        samples: 16,
        bounces: 3,
        seed: draw.index(1 << 30) as u64,
    }
}

/// A path-traced picture, and the reference's own.
pub fn radiance_item(seed: Seed, recorded: RecordedPicture) -> Item {
    /// Of 1024 pixels. Measured: other right formulas are off in none, cracks of 1e-4 in 13.
    const ALLOWED: u32 = 7;
    let key = Key::Radiance {
        pixels: recorded.pixels,
        max_wrong_pixels: ALLOWED,
    };
    let picture = ExamQuestion::new(recorded.question, key);
    let mut draw = seed.rng("traverse.radiance");
    let item = item(
        "radiance",
        2,
        [
            "all of it together draws the Cornell box",
            "Every random number is the framework's, so the picture must be the same but for a \
                 few pixels. If this is the only item that fails, look at cargo render.",
        ],
        vec![picture, linear_scan_control(&mut draw)],
    );
    let all = [needs::CAMERA.as_slice(), &needs::SURFACES, &needs::TREES];
    all.into_iter().fold(item, needs::add)
}
