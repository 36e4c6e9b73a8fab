//! Formats questions and values as text for reports.

pub mod answer;

use std::fmt::Write;

use glam::{Vec2, Vec3};
use protocol::{Interval, Question, Ray, Rays, Shape, Trace};

/// Formats a number with six significant digits and no trailing zeros.
pub fn number(value: f32) -> String {
    if value == 0.0 || !value.is_finite() {
        return match value {
            _ if value.is_nan() => "NaN".to_owned(),
            _ if value == f32::INFINITY => "∞".to_owned(),
            _ if value == f32::NEG_INFINITY => "-∞".to_owned(),
            _ => "0".to_owned(),
        };
    }
    let magnitude = value.abs().log10().floor();
    if !(-5.0..7.0).contains(&magnitude) {
        return format!("{value:.5e}");
    }
    let decimals = (5.0 - magnitude).clamp(0.0, 9.0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// Formats a point, a vector or a colour.
pub fn point(value: Vec3) -> String {
    let [x, y, z] = value.to_array().map(number);
    format!("({x}, {y}, {z})")
}

/// Formats texture coordinates.
pub fn uv(value: Vec2) -> String {
    format!("({}, {})", number(value.x), number(value.y))
}

/// Formats an interval of distances along a ray.
pub fn interval(value: Interval) -> String {
    format!("[{}, {}]", number(value.min), number(value.max))
}

/// Formats the result of `BBox::hit`.
pub fn span(value: Option<Interval>) -> String {
    value.map_or("None".to_owned(), interval)
}

/// Formats a hit by its distance along the ray.
pub fn hit_at(distance: f32) -> String {
    format!("a hit at distance {}", number(distance))
}

/// Formats a ray, with its range unless the range is `[0, ∞)`.
pub fn ray(ray: &Ray) -> String {
    let mut text = format!("ray from {} toward {}", point(ray.origin), point(ray.dir));
    if ray.range != Interval::AHEAD {
        write!(text, " within {}", interval(ray.range)).expect("writing to a string cannot fail");
    }
    text
}

/// Formats every field of a `Trace`, or "no hit".
pub fn trace(value: Option<&Trace>) -> String {
    value.map_or("no hit".to_owned(), |trace| {
        format!(
            "distance {}, position {}, normal {}, uv {}, material {}",
            number(trace.distance),
            point(trace.position),
            point(trace.normal),
            uv(trace.uv),
            trace.material
        )
    })
}

/// Describes one element of a question: the ray, sample, box or tree that was tested.
pub fn element(question: &Question, element: usize) -> String {
    match question {
        Question::Camera { camera, samples } => {
            let samples = samples.to_vec(camera.film);
            let position = samples.get(element).map_or(String::new(), |sample| {
                let (pixel, offset) = (sample.pixel, uv(sample.offset));
                format!(", pixel ({}, {}) + {offset}", pixel.x, pixel.y)
            });
            format!(
                "camera of {}° and aspect {}, film {}×{}{position}",
                number(camera.vertical_fov),
                number(camera.aspect_ratio),
                camera.film.x,
                camera.film.y,
            )
        }
        Question::Shapes { shapes, rays } => {
            format!("{}; {}", nth_ray(rays, element), shapes_text(shapes))
        }
        Question::BBox { min, max, queries } => {
            let query = queries
                .get(element)
                .map_or(String::new(), |(query, times)| {
                    format!("{}, times {}; ", ray(query), interval(*times))
                });
            format!("{query}box {} to {}", point(*min), point(*max))
        }
        Question::Build {
            shapes,
            max_leaf_size,
        } => format!(
            "build a tree over {}, with at most {max_leaf_size} in each leaf",
            shapes_text(shapes)
        ),
        Question::Traverse {
            shapes,
            nodes,
            root,
            rays,
        } => format!(
            "{}; a tree from the exam: {} nodes, root {root}, over {}",
            nth_ray(rays, element),
            nodes.len(),
            shapes_text(shapes)
        ),
        Question::BuildAndTraverse {
            shapes,
            max_leaf_size,
            rays,
        } => format!(
            "{}; your own tree over {}, with at most {max_leaf_size} in each leaf",
            nth_ray(rays, element),
            shapes_text(shapes)
        ),
        Question::Radiance { film, samples, .. } => {
            let (x, y) = (element as u32 % film.x, element as u32 / film.x);
            format!(
                "a path-traced picture of {}×{} pixels, {samples} samples; pixel ({x}, {y})",
                film.x, film.y
            )
        }
        Question::Done => String::new(),
    }
}

fn nth_ray(rays: &Rays, element: usize) -> String {
    let text = rays.to_vec().get(element).map_or(String::new(), ray);
    match rays {
        Rays::List(_) => text,
        Rays::View(view) => {
            let pixel = element / protocol::PIXEL_OFFSETS.len();
            let (x, y) = (pixel as u32 % view.film.x, pixel as u32 / view.film.x);
            format!("pixel ({x}, {y}) of a picture, {text}")
        }
    }
}

/// Describes each of a few shapes in full. For more, returns only their number.
pub fn each_shape(shapes: &[Shape]) -> String {
    const FEW: usize = 6;
    if shapes.len() > FEW {
        return shapes_text(shapes);
    }
    let texts: Vec<String> = shapes.iter().map(shape_text).collect();
    texts.join("; ")
}

/// Describes a single shape in full. For several shapes, returns only their number.
fn shapes_text(shapes: &[Shape]) -> String {
    match shapes {
        [one] => shape_text(one),
        _ => format!("{} primitives", shapes.len()),
    }
}

fn shape_text(shape: &Shape) -> String {
    match *shape {
        Shape::Triangle { vertices, .. } => {
            let [p0, p1, p2] = vertices.map(|vertex| point(vertex.position));
            format!("triangle {p0} {p1} {p2}")
        }
        Shape::FlatTriangle { corners, .. } => {
            let [p0, p1, p2] = corners.map(point);
            format!("triangle {p0} {p1} {p2}")
        }
        Shape::Sphere { center, radius, .. } => {
            format!(
                "sphere around {} of radius {}",
                point(center),
                number(radius)
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prints_six_significant_digits() {
        for (value, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (0.1, "0.1"),
            (1234.5678, "1234.57"),
            (100.0, "100"),
            (-0.000123456, "-0.000123456"),
            (1e20, "1.00000e20"),
            (1e-12, "1.00000e-12"),
            (f32::NAN, "NaN"),
            (f32::NEG_INFINITY, "-∞"),
        ] {
            assert_eq!(number(value), text);
        }
    }
}
