//! The items of the toy. Correct answers are computed from the definitions, in double precision.

use author::domains::{Aspect, FunctionDomain, not_asked};
use author::items::{AuthoredTask, Declaration, Group, hits_key, ray};
use author::oracle::{Ray64, scan};
use author::seed::Rng;
use author::tree::{Tree, construction, decoy};
use glam::DVec3;
use judging::exam::{ExamQuestion, ExpectedRows, Key};
use protocol::{Geometry, LightQuestion, LocalDirection, Question, Ray, Shape, Table};

/// The items about a single ball, which the items about lists of balls need.
const BALLS: Group = Group("balls");

/// The number of rays that hit. The same number of rays miss.
const OF_EACH: usize = 8;

/// The task `ball`.
pub static BALL: AuthoredTask = AuthoredTask {
    items: &[NEAR_SIDE],
    ..AuthoredTask::NEW
};

/// The task `mirror`.
pub static MIRROR: AuthoredTask = AuthoredTask {
    items: &[REFLECTS],
    domains: &[&DIRECTIONS],
    ..AuthoredTask::NEW
};

/// The task `nearest`.
pub static NEAREST: AuthoredTask = AuthoredTask {
    items: &[OF_TWO],
    ..AuthoredTask::NEW
};

const NEAR_SIDE: Declaration = Declaration {
    id: "ball.near_side",
    points: 40,
    title: "a ray from outside hits the near side of a ball",
    look: "Which of the two intersections comes first along the ray?",
    section: "sphere.md#the-near-root-can-be-out-of-range",
    tests: &["Returns the first point of the ball along the ray."],
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

const REFLECTS: Declaration = Declaration {
    id: "mirror.reflects",
    points: 20,
    title: "a mirror turns a direction around its normal",
    look: "Which components of the direction change, and which one stays?",
    section: "sphere.md#the-figure",
    tests: &["Returns the direction that is reflected toward the viewer."],
    questions: |rng| {
        // Use a direction in each quadrant in turn.
        let sign = |is_negative: bool| if is_negative { -1.0 } else { 1.0 };
        let signs = |number: usize| DVec3::new(sign(number & 1 > 0), sign(number & 2 > 0), 1.0);
        let directions = (0..2 * OF_EACH).map(|number| rng.direction().abs() * signs(number));
        let directions: Vec<DVec3> = directions.collect();
        let reflected = directions.iter().map(|dir| 2.0 * dir.z * DVec3::Z - dir);
        let rows = ExpectedRows::Directions(reflected.map(local).collect());
        let key = Key::table(&["direction", "unit_direction"], rows);
        let rows = directions.into_iter().map(local).collect();
        let question = LightQuestion::Reflect(Table::of_list((), rows));
        vec![ExamQuestion::new(question.into(), key)]
    },
    ..Declaration::ALONE
};

/// The domain of `reflect`: directions above the surface.
static DIRECTIONS: FunctionDomain<LocalDirection> = FunctionDomain {
    aspects: &[&[Aspect::new(
        "direction",
        &[
            "x > 0, y > 0",
            "x < 0, y > 0",
            "x > 0, y < 0",
            "x < 0, y < 0",
        ],
        |call| Some((call.direction.is_negative_bitmask() & 3) as usize),
    )]],
    not_asked: &[not_asked(&["first call"])
        .classes(&["after another subject"])
        .because("`reflect` isn't called on a subject.")],
    ..FunctionDomain::new("reflect", |question| {
        let Question::Light(LightQuestion::Reflect(table)) = question else {
            return Vec::new();
        };
        table.rows.to_vec().into_owned()
    })
};

/// Returns a direction in single precision.
fn local(direction: DVec3) -> LocalDirection {
    LocalDirection {
        direction: direction.as_vec3(),
    }
}

const OF_TWO: Declaration = Declaration {
    id: "nearest.of_two",
    points: 40,
    title: "the nearest of two balls is hit, in any order",
    look: "Which of the hits do you keep if the second ball is farther away?",
    section: "traversal.md#the-algorithm",
    tests: &["Returns the nearest hit on any of the balls."],
    questions: |rng| {
        let center = 2.0 * rng.direction();
        let balls = [random_ball(rng, center, 0), random_ball(rng, -center, 1)];
        let mut tree = construction::median_split(balls.into(), 2);
        let (rays, key) = rays_and_key(rng, &tree);
        // In both orders, some rays hit the first ball and others hit the second.
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

/// Returns rays and their key. All rays start outside the balls in a tree. Half of the rays hit
/// every ball, and the other half miss every ball. No answer depends on rounding.
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
