//! The handout's figures: drawn from numbers, so that none can be a little off.

mod boxes;
mod building;
mod camera;
mod drawing;
mod grading;
mod sphere;
mod svg;
mod traversal;
mod triangle;

/// A figure's name, and what draws it.
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
    ("walking-pruned", traversal::pruned),
    ("walking-overlapping", traversal::overlapping),
    ("walking-walk", traversal::example),
    ("walking-trap", traversal::decoy),
    ("grading-edge", grading::edge),
];

/// All figures: file name and SVG.
pub fn all() -> impl Iterator<Item = (String, String)> {
    FIGURES
        .into_iter()
        .map(|(name, draw)| (format!("{name}.svg"), draw()))
}
