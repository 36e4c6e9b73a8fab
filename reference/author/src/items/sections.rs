//! Which section of the handout teaches what an item asks.

use grader::section::Section;

/// The section that teaches an item. None for an item that nobody has put in this table: a test of
/// the handout fails then.
pub fn section(item: &str) -> Option<Section> {
    let place = match item {
        "camera.corners" => "camera.md#where-the-sample-is",
        "camera.field_of_view" => "camera.md#half-the-angle-and-twice-the-tangent",
        "camera.aspect_ratio" => "camera.md#how-large-the-sensor-is",
        "camera.other_aspect" => "camera.md#the-aspect-ratio-is-not-the-film",
        "camera.film" => "camera.md#each-axis-has-a-size-of-its-own",
        "camera.bottom_left" => "camera.md#row-zero-is-at-the-bottom",
        "camera.offset" | "camera.offset_axes" => "camera.md#the-offset-belongs-to-the-pixel",
        "camera.large_film" => "camera.md#integers-divide-to-zero",
        "camera.unit_length" => "camera.md#a-direction-of-length-one",
        "camera.origin_and_range" => "camera.md#the-ray-starts-at-the-camera",

        "triangle.inside" => "triangle.md#three-equations-for-three-unknowns",
        "triangle.outside" => "triangle.md#the-third-weight-counts-too",
        "triangle.position" | "triangle.origin_and_material" => "triangle.md#what-the-answer-holds",
        "triangle.normal" => "triangle.md#the-normals-are-given",
        "triangle.uv" => "triangle.md#the-weights-are-not-the-texture-coordinates",
        "triangle.uv_corners" => "triangle.md#each-weight-belongs-to-its-corner",
        "triangle.from_behind" => "triangle.md#from-behind-the-denominator-is-negative",
        "triangle.normal_from_behind" => "triangle.md#the-normal-stays-on-its-side",
        "triangle.range_max" | "triangle.range_min" => "triangle.md#the-range-has-two-ends",
        "triangle.behind_the_ray" => "triangle.md#behind-the-origin-is-not-ahead",
        "triangle.tiny" => "triangle.md#no-small-number-will-do-in-place-of-zero",
        "triangle.degenerate" => "triangle.md#when-the-denominator-is-zero",

        "sphere.near_side" => "sphere.md#the-quadratic",
        "sphere.beside" => "sphere.md#the-square-root-of-a-negative-number",
        "sphere.radius" => "sphere.md#the-radius-is-not-always-one",
        "sphere.behind" | "sphere.from_inside" | "sphere.far_root" => {
            "sphere.md#the-near-root-can-be-out-of-range"
        }
        "sphere.range_max" | "sphere.range_within" => "sphere.md#each-root-is-asked-by-itself",
        "sphere.position" => "sphere.md#the-sphere-is-not-always-at-the-origin",
        "sphere.normal" => "sphere.md#the-normal-points-away-from-the-centre",
        "sphere.uv" | "sphere.uv_radius" => "sphere.md#the-uv-wants-a-unit-direction",
        "sphere.origin_and_material" => "sphere.md#what-the-answer-holds",

        "bbox.through" => "boxes.md#from-the-last-entry-to-the-first-exit",
        "bbox.slab_after_slab" => "boxes.md#the-slabs-must-agree-with-each-other",
        "bbox.octants" => "boxes.md#a-negative-direction-swaps-the-planes",
        "bbox.behind" | "bbox.times_not_range" => "boxes.md#only-times-counts",
        "bbox.from_inside" | "bbox.clipped" => "boxes.md#what-comes-back-is-clipped",
        "bbox.wholly_inside" => "boxes.md#a-range-wholly-inside-the-box-is-a-hit",
        "bbox.axis_parallel" => "boxes.md#zero-and-minus-zero",
        "bbox.flat" => "boxes.md#flat-boxes-have-no-inside-but-count",

        "build.partition" => "building.md#a-leaf-is-a-piece-of-the-list",
        "build.contains" => "building.md#counting-and-partitioning-must-agree",
        "build.tight" | "build.negative" => "building.md#boxes-grow-from-nothing",
        "build.leaf_size" | "build.stops" => "building.md#a-leaf-may-be-full",
        "build.coincident" | "build.concentric" => "building.md#all-centers-in-one-place",
        "build.coplanar" | "build.collinear" => "building.md#an-axis-without-extent",
        "build.outlier" => "building.md#one-far-from-all-others",
        "build.one_or_none" => "building.md#almost-nothing-to-build",
        "build.one_split" => "building.md#which-partitions-are-tried",
        "build.cost_strands" => "building.md#all-three-axes-at-every-node",
        "build.cost_sheets" => "building.md#areas-belong-to-children-and-counts-to-primitives",
        "build.cost_town" => "building.md#the-best-cost-must-be-kept",

        "traverse.closest_hit" | "traverse.mixed" => "walking.md#the-first-hit-is-not-the-closest",
        "traverse.first_box_empty" => "walking.md#no-hit-yet-is-not-a-hit-at-zero",
        "traverse.range" => "walking.md#only-a-hit-shortens-the-ray",
        "traverse.root" => "walking.md#the-root-has-a-place-of-its-own",
        "traverse.leaf_of_several" => "walking.md#a-leaf-holds-its-own-primitives",
        "traverse.deep" => "walking.md#deep-is-not-endless",
        "traverse.flat" => "walking.md#a-flat-box-is-left-when-it-is-entered",
        "traverse.no_nodes" => "walking.md#no-nodes-at-all",
        "traverse.skips_missed" | "traverse.both_sides" => "walking.md#a-missed-box-is-not-entered",
        "traverse.prunes" => "walking.md#nearer-first-and-then-compare",
        "traverse.nearer_first" => "walking.md#the-prune-asks-the-second-child",
        "traverse.own_tree" => "walking.md#your-own-tree",

        "camera.picture" | "triangle.picture" | "sphere.picture" | "traverse.picture"
        | "traverse.radiance" => "grading.md#reading-a-wrong-picture",
        _ => return None,
    };
    Some(Section::new(place))
}
