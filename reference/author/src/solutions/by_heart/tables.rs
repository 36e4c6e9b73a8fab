//! The tables of answers, one for each task file.

use std::collections::BTreeMap;

use glam::Vec3;
use judging::exam::{Exam, Item, Key};
use protocol::{
    Answer, ElementOutcome, Interval, PinholeCamera, Question, Ray, Sample, Shape, Tree,
};

use super::Table;
use super::question_hash::question_hash;
use crate::oracle::{Ray64, scan};
use crate::solutions::workbench::{BuiltSolution, WorkbenchError};

/// The tables, by the names of the task files.
type Tables = BTreeMap<&'static str, Table>;

/// Returns the answers to all questions of an exam, except path-traced pictures.
pub(super) fn tables(exam: &Exam, builder: &BuiltSolution) -> Result<Tables, WorkbenchError> {
    let mut tables = Tables::new();
    for item in &exam.items {
        for question in &item.questions {
            add_question(&mut tables, &question.question, &question.key);
        }
        if item
            .questions
            .iter()
            .any(|it| matches!(it.key, Key::Tree { .. }))
        {
            add_trees(&mut tables, item, builder)?;
        }
    }
    Ok(tables)
}

fn add(tables: &mut Tables, file: &'static str, question: &[f32], answer: Vec<u32>) {
    let table = tables.entry(file).or_default();
    table.insert(question_hash(question), answer);
}

fn add_question(tables: &mut Tables, question: &Question, key: &Key) {
    match (question, key) {
        (Question::Camera { camera, samples }, Key::Rays { directions, .. }) => {
            for (sample, dir) in samples.to_vec(camera.film).iter().zip(directions) {
                let question = camera_numbers(camera, sample);
                add(tables, "camera.rs", &question, bits(&dir.to_array()));
            }
        }
        (Question::BBox { min, max, queries }, Key::Spans { spans }) => {
            for ((ray, times), span) in queries.iter().zip(spans) {
                if let Some(Interval {
                    min: enter,
                    max: leave,
                }) = span
                {
                    let (min, max) = (min.to_array(), max.to_array());
                    let question = [
                        ray_numbers(ray),
                        [min, max].concat(),
                        vec![times.min, times.max],
                    ];
                    add(
                        tables,
                        "bbox.rs",
                        &question.concat(),
                        bits(&[*enter, *leave]),
                    );
                }
            }
        }
        (Question::Shapes { shapes, rays }, key) => {
            for (ray, answer) in rays.to_vec().iter().zip(hits(key)) {
                if let (Some(answer), Some(shape)) = (answer, closest_shape(ray, shapes)) {
                    let (file, of_shape) = shape_numbers(shape);
                    add(tables, file, &[ray_numbers(ray), of_shape].concat(), answer);
                }
            }
        }
        (
            Question::Traverse { shapes, rays, .. }
            | Question::BuildAndTraverse { shapes, rays, .. },
            key,
        ) => {
            let Some(first) = shapes.first() else { return };
            for (ray, answer) in rays.to_vec().iter().zip(hits(key)) {
                let of_tree = [box_numbers(first), vec![shapes.len() as f32]].concat();
                if let Some(answer) = answer {
                    add(
                        tables,
                        "bvh.rs",
                        &[ray_numbers(ray), of_tree].concat(),
                        answer,
                    );
                }
            }
        }
        _ => {}
    }
}

/// Adds the trees that `builder` builds.
fn add_trees(
    tables: &mut Tables,
    item: &Item,
    builder: &BuiltSolution,
) -> Result<(), WorkbenchError> {
    let answers = builder.answers(item)?.unwrap_or_default();
    for (question, answer) in item.questions.iter().zip(answers) {
        if let (
            Question::Build {
                shapes,
                max_leaf_size,
            },
            Answer::Tree(ElementOutcome::Value(tree)),
        ) = (&question.question, answer)
        {
            let mut question = vec![*max_leaf_size as f32];
            question.extend(shapes.iter().flat_map(box_numbers));
            add(tables, "bvh.rs", &question, tree_words(&tree));
        }
    }
    Ok(())
}

fn tree_words(tree: &Tree) -> Vec<u32> {
    let nodes = tree.nodes.iter();
    let nodes = nodes.flat_map(|node| [node.start, node.size, node.l, node.r]);
    let head = [tree.root, tree.nodes.len() as u32];
    head.into_iter()
        .chain(nodes)
        .chain(tree.order.iter().copied())
        .collect()
}

/// Returns the answer to each ray of a question about hits.
fn hits(key: &Key) -> Vec<Option<Vec<u32>>> {
    let words = |distance: f32, normal: Vec3, uv: glam::Vec2, material: u32| {
        let numbers = [distance, normal.x, normal.y, normal.z, uv.x, uv.y];
        [bits(&numbers), vec![material]].concat()
    };
    match key {
        Key::Hits { hits, .. } => hits
            .iter()
            .map(|hit| hit.map(|hit| words(hit.distance, hit.normal, hit.uv, hit.material)))
            .collect(),
        Key::FirstHits { hits, .. } => hits
            .iter()
            .map(|hit| hit.map(|hit| words(hit.depth, hit.normal, hit.uv, 0)))
            .collect(),
        Key::Rays { .. } | Key::Spans { .. } | Key::Tree { .. } | Key::Radiance { .. } => {
            Vec::new()
        }
    }
}

fn closest_shape<'a>(ray: &Ray, shapes: &'a [Shape]) -> Option<&'a Shape> {
    let ray64 = Ray64::from(ray);
    let hits = shapes
        .iter()
        .filter_map(|shape| Some((shape, scan::intersect(&ray64, shape)?)));
    let closest = hits.min_by(|(_, a), (_, b)| a.distance.total_cmp(&b.distance));
    closest.map(|(shape, _)| shape)
}

fn camera_numbers(camera: &PinholeCamera, sample: &Sample) -> [f32; 8] {
    let (film, pixel) = (camera.film.as_vec2(), sample.pixel.as_vec2());
    let PinholeCamera {
        vertical_fov,
        aspect_ratio,
        ..
    } = *camera;
    let offset = sample.offset;
    [
        vertical_fov,
        aspect_ratio,
        film.x,
        film.y,
        pixel.x,
        pixel.y,
        offset.x,
        offset.y,
    ]
}

fn ray_numbers(ray: &Ray) -> Vec<f32> {
    let (origin, dir) = (ray.origin.to_array(), ray.dir.to_array());
    [&origin[..], &dir, &[ray.range.min, ray.range.max]].concat()
}

/// Returns the task file that intersects a shape, and the numbers of the shape.
fn shape_numbers(shape: &Shape) -> (&'static str, Vec<f32>) {
    let corners = |corners: [Vec3; 3]| ("triangle.rs", corners.map(|it| it.to_array()).concat());
    match *shape {
        Shape::Triangle { vertices, .. } => corners(vertices.map(|vertex| vertex.position)),
        Shape::FlatTriangle {
            corners: points, ..
        } => corners(points),
        Shape::Sphere { center, radius, .. } => {
            ("sphere.rs", vec![center.x, center.y, center.z, radius])
        }
    }
}

/// Returns the box of a shape, in single precision as submissions compute it.
fn box_numbers(shape: &Shape) -> Vec<f32> {
    let around = |[a, b, c]: [Vec3; 3]| (a.min(b).min(c), a.max(b).max(c));
    let (min, max) = match *shape {
        Shape::Triangle { vertices, .. } => around(vertices.map(|vertex| vertex.position)),
        Shape::FlatTriangle { corners, .. } => around(corners),
        Shape::Sphere { center, radius, .. } => (center - radius, center + radius),
    };
    [min.to_array(), max.to_array()].concat()
}

fn bits(numbers: &[f32]) -> Vec<u32> {
    numbers.iter().map(|number| number.to_bits()).collect()
}
