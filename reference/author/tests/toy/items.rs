//! The items of the toy. Correct answers are computed in double precision, from the definitions.

use author::items::{Declaration, DeclaredItem, Group, draw_items, hits_key, ray};
use author::oracle::{Ray64, scan};
use author::seed::{Rng, Seed};
use author::tree::{Tree, construction, decoy};
use glam::DVec3;
use judging::exam::{ExamQuestion, Key};
use protocol::{Corners, Geometry, Interval, Query, Question, Ray, Shape};

/// The items about a ball, which is hit as often in a list of balls.
const BALLS: Group = Group("balls");

/// The number of rays that hit, and of rays that miss.
const OF_EACH: usize = 8;

/// Draws the items of the task `ball`.
pub fn ball(seed: Seed) -> Vec<DeclaredItem> {
    draw_items(seed, &[NEAR_SIDE])
}

/// Draws the items of the task `slab`.
pub fn slab(seed: Seed) -> Vec<DeclaredItem> {
    draw_items(seed, &[CLIPPED])
}

/// Draws the items of the task `nearest`.
pub fn nearest(seed: Seed) -> Vec<DeclaredItem> {
    draw_items(seed, &[OF_TWO])
}

const NEAR_SIDE: Declaration = Declaration {
    id: "ball.near_side",
    points: 40,
    title: "a ray from outside hits the near side of a ball",
    look: "Which of the two intersections comes first along the ray?",
    section: "sphere.md#the-near-root-can-be-out-of-range",
    questions: |rng| {
        let tree = construction::median_split(vec![random_ball(rng, DVec3::ZERO, 0)], 1);
        let (rays, key) = rays_and_key(rng, &tree);
        let shapes = tree.shapes;
        vec![ExamQuestion::new(
            Question::hits(Geometry::List { shapes }, rays),
            key,
        )]
    },
    ..Declaration::in_group(BALLS)
};

const CLIPPED: Declaration = Declaration {
    id: "slab.clipped",
    points: 20,
    title: "the time in a slab is clipped to the times asked about",
    look: "When does the ray enter the slab, and when does it leave? Which of it is in `times`?",
    section: "boxes.md#clip-the-result-to-times",
    questions: |rng| {
        let min = rng.point(3.0).as_vec3();
        let max = min + rng.vector(1.0, 4.0).as_vec3();
        let queries: Vec<Query> = (0..2 * OF_EACH)
            .map(|number| random_query(rng, [min.x, max.x], number < OF_EACH))
            .collect();
        let spans = queries.iter().map(|query| span(query, [min.x, max.x]));
        let key = Key::spans(spans.collect());
        vec![ExamQuestion::new(
            Question::boxes(Corners { min, max }, queries),
            key,
        )]
    },
    ..Declaration::ALONE
};

const OF_TWO: Declaration = Declaration {
    id: "nearest.of_two",
    points: 40,
    title: "the nearest of two balls is hit, in any order",
    look: "Which of the hits do you keep if the second ball is farther away?",
    section: "traversal.md#the-algorithm",
    questions: |rng| {
        let center = 2.0 * rng.direction();
        let balls = [random_ball(rng, center, 0), random_ball(rng, -center, 1)];
        let mut tree = construction::median_split(balls.into(), 2);
        let (rays, key) = rays_and_key(rng, &tree);
        // In each of the two orders, some rays hit the first ball first, and some the second.
        let in_one_order = Question::hits(tree.geometry(), rays.clone());
        tree.shapes.reverse();
        let in_the_other = Question::hits(tree.geometry(), rays);
        vec![
            ExamQuestion::new(in_one_order, key.clone()),
            ExamQuestion::new(in_the_other, key),
        ]
    },
    needs: &[BALLS],
    ..Declaration::ALONE
};

/// Returns a ball with a radius of about one, near this point.
fn random_ball(rng: &mut Rng, center: DVec3, shape: u32) -> Shape {
    Shape::Sphere {
        center: (center + rng.point(0.2)).as_vec3(),
        radius: rng.uniform(0.5, 1.5) as f32,
        shape,
    }
}

/// Returns rays from outside that hit every ball in a tree, as many that miss all of them, and the
/// key. No answer depends on rounding.
fn rays_and_key(rng: &mut Rng, tree: &Tree) -> (Vec<Ray>, Key) {
    let wanted = (0..2 * OF_EACH).map(|number| number < OF_EACH);
    let rays = wanted.map(|is_hit| {
        rng.retry(|rng| {
            let ray = ray(rng.direction() * 9.0, rng.point(3.0));
            let ray64 = Ray64::from(&ray);
            let mut balls = tree.shapes.iter();
            let is_wanted = balls.all(|ball| scan::intersect(&ray64, ball).is_some() == is_hit);
            (is_wanted && decoy::is_fair(tree, &[ray])).then_some(ray)
        })
    });
    let rays: Vec<Ray> = rays.collect();
    let key = hits_key(&["distance", "normal"], &rays, |ray64| {
        tree.expected_hit(ray64)
    });
    (rays, key)
}

/// Returns a ray that crosses the slab, with times in which it is clearly there, or is clearly not.
fn random_query(rng: &mut Rng, planes: [f32; 2], is_hit: bool) -> Query {
    rng.retry(|rng| {
        let dir = rng.direction();
        let ray = Ray::new(rng.point(8.0).as_vec3(), dir.as_vec3());
        let start = rng.uniform(-9.0, 9.0);
        let times = Interval::new(start as f32, (start + rng.uniform(1.0, 9.0)) as f32);
        let query = Query { ray, times };
        let grown = |by: f32| Query {
            times: Interval::new(times.min - by, times.max + by),
            ..query
        };
        let mut all = [-0.1, 0.0, 0.1].into_iter();
        let is_clear = all.all(|by| span(&grown(by), planes).is_some() == is_hit);
        (is_clear && dir.x.abs() > 0.2).then_some(query)
    })
}

/// Returns when a ray is between the planes with these x coordinates.
fn span(Query { ray, times }: &Query, planes: [f32; 2]) -> Option<Interval> {
    let at = |plane: f32| (f64::from(plane) - f64::from(ray.origin.x)) / f64::from(ray.dir.x);
    let [one, other] = planes.map(at);
    let enter = one.min(other).max(times.min.into());
    let leave = one.max(other).min(times.max.into());
    (enter <= leave).then(|| Interval::new(enter as f32, leave as f32))
}
