//! The handout sections that teach what the items test.

use judging::section::Section;

/// Returns the section that teaches an item, or `None` if the item is missing from this table. A
/// test of the handout makes sure that none is missing.
pub fn section(item: &str) -> Option<Section> {
    let anchor = match item {
        "camera.corners" => "camera.md#from-pixel-to-sensor",
        "camera.field_of_view" => "camera.md#half-the-angle-and-twice-the-tangent",
        "camera.aspect_ratio" => "camera.md#the-size-of-the-sensor",
        "camera.other_aspect" => "camera.md#the-aspect-ratio-is-not-that-of-the-film",
        "camera.film" => "camera.md#each-axis-has-its-own-size",
        "camera.bottom_left" => "camera.md#row-zero-is-at-the-bottom",
        "camera.offset" | "camera.offset_axes" => "camera.md#the-offset-is-measured-in-pixels",
        "camera.large_film" => "camera.md#integer-division-gives-zero",
        "camera.unit_length" => "camera.md#the-direction-has-length-one",
        "camera.origin_and_range" => "camera.md#the-ray-starts-at-the-camera",

        "triangle.inside" => "triangle.md#three-equations-for-three-unknowns",
        "triangle.outside" => "triangle.md#test-the-third-weight-too",
        "triangle.position" | "triangle.origin_and_material" => "triangle.md#what-to-return",
        "triangle.normal" => "triangle.md#interpolate-the-given-normals",
        "triangle.uv" => "triangle.md#the-weights-are-not-the-texture-coordinates",
        "triangle.uv_corners" => "triangle.md#each-weight-belongs-to-its-corner",
        "triangle.from_behind" => "triangle.md#a-ray-from-behind-has-a-negative-denominator",
        "triangle.normal_from_behind" => "triangle.md#do-not-flip-the-normal",
        "triangle.range_max" | "triangle.range_min" => "triangle.md#check-both-ends-of-the-range",
        "triangle.behind_the_ray" => "triangle.md#hits-behind-the-origin-do-not-count",
        "triangle.tiny" => "triangle.md#do-not-use-an-epsilon-instead-of-zero",
        "triangle.degenerate" => "triangle.md#when-the-denominator-is-zero",

        "sphere.near_side" => "sphere.md#the-quadratic-equation",
        "sphere.beside" => "sphere.md#the-square-root-of-a-negative-number",
        "sphere.radius" => "sphere.md#the-radius-is-not-always-one",
        "sphere.behind" | "sphere.from_inside" | "sphere.far_root" => {
            "sphere.md#the-near-root-can-be-out-of-range"
        }
        "sphere.range_max" | "sphere.range_within" => "sphere.md#check-each-root-by-itself",
        "sphere.position" => "sphere.md#the-sphere-is-not-always-at-the-origin",
        "sphere.normal" => "sphere.md#the-normal-points-away-from-the-centre",
        "sphere.uv" | "sphere.uv_radius" => "sphere.md#the-uv-function-needs-a-unit-direction",
        "sphere.origin_and_material" => "sphere.md#what-to-return",

        "bbox.through" => "boxes.md#from-the-last-entry-to-the-first-exit",
        "bbox.slab_after_slab" => "boxes.md#the-slab-intervals-must-overlap",
        "bbox.octants" => "boxes.md#a-negative-direction-swaps-the-planes",
        "bbox.behind" | "bbox.times_not_range" => "boxes.md#use-times-and-not-the-range-of-the-ray",
        "bbox.from_inside" | "bbox.clipped" => "boxes.md#clip-the-result-to-times",
        "bbox.wholly_inside" => "boxes.md#a-range-wholly-inside-the-box-is-a-hit",
        "bbox.axis_parallel" => "boxes.md#zero-and-minus-zero",
        "bbox.flat" => "boxes.md#flat-boxes-can-be-hit",

        "build.partition" => "building.md#a-leaf-is-a-slice-of-the-list",
        "build.contains" => "building.md#counting-and-partitioning-must-agree",
        "build.tight" | "build.negative" => "building.md#start-each-box-empty",
        "build.leaf_size" | "build.stops" => "building.md#when-a-node-becomes-a-leaf",
        "build.coincident" | "build.concentric" => "building.md#when-all-centres-coincide",
        "build.coplanar" | "build.collinear" => "building.md#an-axis-without-extent",
        "build.outlier" => "building.md#one-primitive-far-from-the-others",
        "build.one_or_none" => "building.md#very-small-inputs",
        "build.one_split" => "building.md#which-partitions-to-try",
        "build.cost_strands" => "building.md#try-all-three-axes-at-every-node",
        "build.cost_sheets" => "building.md#areas-and-counts-in-the-cost-formula",
        "build.cost_town" => "building.md#keep-track-of-the-best-cost",

        "traverse.closest_hit" | "traverse.mixed" => {
            "traversal.md#the-first-hit-need-not-be-the-closest"
        }
        "traverse.first_box_empty" => "traversal.md#no-hit-yet-is-not-a-hit-at-distance-zero",
        "traverse.range" => "traversal.md#only-a-hit-shortens-the-ray",
        "traverse.root" => "traversal.md#the-root-can-be-any-node",
        "traverse.leaf_of_several" => "traversal.md#test-exactly-the-primitives-of-the-leaf",
        "traverse.deep" => "traversal.md#deep-trees",
        "traverse.flat" => "traversal.md#a-flat-box-has-equal-entry-and-exit",
        "traverse.no_nodes" => "traversal.md#an-empty-tree-has-no-nodes",
        "traverse.skips_missed" | "traverse.both_sides" => {
            "traversal.md#do-not-enter-a-box-that-is-missed"
        }
        "traverse.prunes" => "traversal.md#order-the-children-and-prune",
        "traverse.nearer_first" => "traversal.md#compare-the-entry-of-the-second-child",
        "traverse.own_tree" => "traversal.md#your-own-builder-and-your-own-traversal",

        "camera.picture" | "triangle.picture" | "sphere.picture" | "traverse.picture"
        | "traverse.radiance" => "grading.md#reading-a-wrong-picture",
        _ => return None,
    };
    Some(Section::new(anchor))
}
