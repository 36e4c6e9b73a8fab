//! The handout's figures. They are computed from numbers, so that they are exact.

mod boxes;
mod building;
mod camera;
mod drawing;
mod grading;
mod label;
mod sphere;
mod traversal;
mod triangle;

/// A figure's name, and the function that draws it.
type Figure = (&'static str, fn() -> String);

const FIGURES: [Figure; 18] = [
    ("camera-sensor", camera::sensor),
    ("camera-side", camera::side),
    ("camera-pixels", camera::pixels),
    ("triangle-weights", triangle::weights),
    ("triangle-signs", triangle::signs),
    ("sphere-roots", sphere::roots),
    ("sphere-chord", sphere::chord),
    ("boxes-slabs", boxes::slabs),
    ("boxes-times", boxes::times),
    ("boxes-special", boxes::special),
    ("building-tree", building::tree),
    ("building-buckets", building::buckets),
    ("building-costs", building::costs),
    ("traversal-pruned", traversal::pruned),
    ("traversal-overlapping", traversal::overlapping),
    ("traversal-example", traversal::example),
    ("traversal-decoy", traversal::decoy),
    ("grading-edge", grading::edge),
];

/// Returns the file name and the SVG of every figure.
pub fn all() -> impl Iterator<Item = (String, String)> {
    FIGURES
        .into_iter()
        .map(|(name, draw)| (format!("{name}.svg"), draw()))
}
