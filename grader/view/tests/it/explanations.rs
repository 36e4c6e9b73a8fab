//! Compares the tests listed for one ray with an independently computed list, and checks the steps
//! that the viewer marks in a wrong traversal.

use std::collections::BTreeSet;

use glam::uvec2;
use serde_json::Value;

use crate::expected_tests::{Expected, listed_tests, marks};
use crate::harness::{SLIDES_HIT, Submission, Viewer};

#[test]
fn the_tests_of_a_pixel_are_those_of_the_references_traversal() {
    let expected = Expected::of_scene("checkered-teapot", uvec2(48, 36));
    let arguments = "checkered-teapot --size 48x36 --samples 1";
    let viewer = Viewer::start(&Submission::reference(), arguments);
    let mut hits = 0;
    for pixel in [
        uvec2(20, 18),
        uvec2(24, 20),
        uvec2(30, 16),
        uvec2(10, 5),
        uvec2(47, 35),
    ] {
        let explanation = viewer.explain(pixel.to_array(), None);
        let explained = &explanation["rays"][0];
        assert_eq!(listed_tests(explained), expected.tests(pixel), "{pixel}");
        assert_eq!(explained["notes"].as_array().unwrap().len(), 0);
        hits += usize::from(explained["hit"] != Value::Null);
        assert_eq!(marks(explained), []);
    }
    assert!(hits >= 3, "{hits}");
}

#[test]
fn every_ray_of_a_path_is_listed() {
    let viewer = Viewer::start(&Submission::reference(), "--size 32x32 --samples 1");
    let explanation = viewer.explain([16, 8], Some(0));
    let rays = explanation["rays"].as_array().unwrap();
    let kinds: Vec<&str> = rays
        .iter()
        .map(|ray| ray["kind"].as_str().unwrap())
        .collect();
    assert_eq!(kinds[0], "camera ray");
    assert!(kinds.contains(&"shadow ray to a light"), "{kinds:?}");
    assert!(kinds.contains(&"ray after bounce 1"), "{kinds:?}");
    for ray in rays {
        let is_shadow_ray = ray["kind"] == "shadow ray to a light";
        assert_eq!(ray["is_shadow_ray"], is_shadow_ray);
    }
    assert!(rays.iter().all(|ray| ray["boxes"].as_u64() > Some(0)));
    assert_eq!(explanation["radiance"].as_array().unwrap().len(), 3);
    let steps = explanation["steps"].as_array().unwrap();
    let begin_with = |word: &str| {
        steps
            .iter()
            .any(|step| step.as_str().unwrap().starts_with(word))
    };
    assert!(
        ["hit: ", "light: ", "light pdf: ", "scatter: "]
            .into_iter()
            .all(begin_with),
        "{steps:?}"
    );
    let no_path = viewer.explain([16, 8], None);
    assert_eq!(no_path["steps"].as_array().unwrap().len(), 0);
}

/// A ray to the sky has no end, just like a ray after a bounce.
#[test]
fn a_ray_that_collects_light_from_the_sky_is_a_shadow_ray() {
    let viewer = Viewer::start(
        &Submission::reference(),
        "open-sky --size 32x24 --samples 1",
    );
    let explanation = viewer.explain([16, 3], Some(0));
    let rays = explanation["rays"].as_array().unwrap().iter();
    let of_kind = |kind: &str| {
        let rays = rays.clone().filter(|ray| ray["kind"] == kind);
        rays.map(|ray| ray["is_shadow_ray"] == true)
            .collect::<Vec<_>>()
    };
    let to_sky = of_kind("shadow ray to the sky");
    assert!(
        !to_sky.is_empty() && to_sky.iter().all(|is| *is),
        "{explanation}"
    );
    assert_eq!(of_kind("ray after bounce 1"), [false], "{explanation}");
}

/// Returns the rules that a submission's traversal breaks in a sample of a scene's pixels.
fn broken_rules(submission: &Submission) -> Vec<String> {
    let arguments = "gyroid --size 24x24 --samples 1";
    let viewer = Viewer::start(submission, arguments);
    let pixels = (0..36).map(|n| [2 + 4 * (n % 6), 2 + 4 * (n / 6)]);
    let marks = pixels.flat_map(|pixel| marks(&viewer.explain(pixel, None)["rays"][0]));
    let rules: BTreeSet<String> = marks.map(|(rule, _)| rule).collect();
    rules.into_iter().collect()
}

#[test]
fn a_correct_traversal_has_no_marks_and_the_slides_pseudo_code_has() {
    let submission = Submission::reference();
    assert_eq!(broken_rules(&submission), [""; 0]);
    submission.replace_traversal(SLIDES_HIT);
    assert_eq!(
        broken_rules(&submission),
        ["beyond_closest_hit", "missed_box"]
    );
}

/// Returns the numbers in a list.
fn numbers(list: &Value) -> Vec<f64> {
    let list = list.as_array().unwrap().iter();
    list.map(|number| number.as_f64().unwrap()).collect()
}

#[test]
fn the_history_of_a_pixel_has_each_path_and_its_mean_is_the_pictures_value() {
    let arguments = "--size 32x32 --samples 6";
    let viewer = Viewer::start(&Submission::reference(), arguments);
    viewer.wait_for_picture();
    let explanation = viewer.explain([16, 8], Some(4));
    let history = explanation["history"].as_array().unwrap();
    assert_eq!(history.len(), 6);
    // The history and the explained path are computed separately.
    assert_eq!(history[4]["radiance"], explanation["radiance"]);
    let first = viewer.explain([16, 8], Some(0));
    assert_eq!(history[0]["radiance"], first["radiance"]);
    assert_eq!(first["history"], explanation["history"]);

    let last = &history[5];
    let mean = numbers(&last["mean"]);
    let value = viewer.get_json("/value?x=16&y=8");
    let [r, g, b] = mean[..].try_into().unwrap();
    let expected: String = format!("radiance ({r:.2}, {g:.2}, {b:.2})");
    assert_eq!(value, expected);
    let luminances = history.iter().map(|row| row["luminance"].as_f64().unwrap());
    let mean = luminances.clone().sum::<f64>() / 6.0;
    let variance = luminances.map(|x| (x - mean).powi(2)).sum::<f64>() / 5.0;
    let near = |name: &str, expected: f64| {
        let got = last[name].as_f64().unwrap();
        assert!((got - expected).abs() < 1e-6, "{name}: {got}, {expected}");
    };
    near("mean_luminance", mean);
    near("variance", variance);
    near("standard_error", (variance / 6.0).sqrt());
    assert_eq!(history[0]["variance"], Value::Null);
}

#[test]
fn each_bounce_has_the_product_of_the_attenuations_before_it() {
    let viewer = Viewer::start(&Submission::reference(), "--size 32x32 --samples 1");
    let explanation = viewer.explain([16, 8], Some(0));
    let bounces = explanation["bounces"].as_array().unwrap();
    assert!(bounces.len() >= 3, "{bounces:?}");
    let steps = explanation["steps"].as_array().unwrap();
    let mut expected = vec![1.0; 3];
    for (number, bounce) in (0..).zip(bounces) {
        assert_eq!(bounce["number"], number);
        let throughput = numbers(&bounce["throughput"]);
        let pairs = throughput.iter().zip(&expected);
        let is_product = pairs
            .clone()
            .all(|(got, expected)| (got - expected).abs() < 1e-5);
        assert!(is_product, "{number}: {throughput:?}, {expected:?}");
        let first = bounce["first_step"].as_u64().unwrap();
        let first = steps[usize::try_from(first).unwrap()].as_str().unwrap();
        assert!(first.starts_with("hit: ") || first == "no hit", "{first}");
        assert_eq!(bounce["problems"], serde_json::json!([]));
        if bounce["attenuation"] != Value::Null {
            let attenuation = numbers(&bounce["attenuation"]);
            expected = expected
                .iter()
                .zip(attenuation)
                .map(|(x, y)| x * y)
                .collect();
        }
    }
    assert!(expected[0] < 1.0, "nothing is attenuated");
}
