//! Part two's code: saving a file redraws the picture, and each kind of bad value has its message.

use serde_json::json;

use crate::harness::{Submission, Viewer, notes, view_of};

/// Starts the viewer on a submission for part two.
fn start(submission: &Submission) -> Viewer {
    let arguments = "cornell-box --size 16x16 --samples 2 --assignment light";
    Viewer::run(view_of(submission).args(arguments.split(' '))).unwrap()
}

#[test]
fn a_save_redraws_and_an_error_is_shown_with_its_line() {
    let submission = Submission::reference_light();
    let viewer = start(&submission);
    assert_eq!(notes(&viewer.wait_for_picture()), "");
    let correct = viewer.picture();
    let path = submission.read("path.rs");
    let black = "throughput *= 0.0 * scattered.attenuation;";
    submission.replace("path.rs", "throughput *= scattered.attenuation;", black);
    viewer.wait_for(|state| state["build"] == "compiling");
    viewer.wait_for_picture();
    assert_ne!(
        viewer.picture(),
        correct,
        "the picture has no indirect light"
    );

    submission.write("path.rs", &format!("{path}\nlet oops\n"));
    let failed = viewer.wait_for(|state| state["build"] == "failed");
    let error = &failed["errors"][0];
    assert_eq!(error["file"], "path.rs");
    assert_eq!(error["line"], path.lines().count() + 2);
    submission.write("path.rs", &path);
    viewer.wait_for_picture();
    assert_eq!(viewer.picture(), correct);
}

#[test]
fn each_kind_of_bad_value_has_its_message_in_the_picture_and_at_its_bounce() {
    let submission = Submission::reference_light();
    let viewer = start(&submission);
    viewer.wait_for_picture();
    let not_finite = "black because `radiance` returned NaN or infinity";
    for (file, from, to, in_picture, at_sample) in [
        (
            "path.rs",
            "    light\n    // end solution",
            "    light / 0.0",
            not_finite,
            not_finite,
        ),
        (
            "material.rs",
            "pdf: Some(self.pdf(out, direction)),",
            "pdf: Some(-1.0),",
            "At bounce 0 of the first path through pixel (8, 8), a pdf is negative",
            "a pdf is negative, at bounce 0",
        ),
        (
            "material.rs",
            "attenuation: self.albedo,",
            "attenuation: self.albedo / 0.0,",
            "an attenuation or a scattered direction is NaN or infinite",
            "an attenuation or a scattered direction is NaN or infinite, at bounce 0",
        ),
        (
            "lights.rs",
            "Some(distance) if cosine > 0.0 => distance",
            "Some(distance) if cosine > 0.0 => 0.0 * distance",
            "light arrives from a direction whose light pdf is 0",
            "light arrives from a direction whose light pdf is 0, at bounce 0",
        ),
    ] {
        let correct = submission.read(file);
        submission.replace(file, from, to);
        let state = viewer.wait_for(|state| notes(state).contains(in_picture));
        assert_eq!(state["has_stopped"], false);
        // A pixel of the back wall, which the light reaches.
        let explanation = viewer.explain([8, 8], Some(0));
        let problems = explanation["history"][0]["problems"].as_array().unwrap();
        assert!(problems.contains(&json!(at_sample)), "{to}: {problems:?}");
        submission.write(file, &correct);
        viewer.wait_for(|state| state["build"] == "ready" && notes(state).is_empty());
    }
}

#[test]
fn an_endless_path_is_named_with_and_without_rays() {
    let submission = Submission::reference_light();
    let correct = submission.read("path.rs");
    let first = "    let mut ray = ray;\n";
    let with_rays =
        format!("{first}    loop {{ world.hit(&ray); }}\n    #[allow(unreachable_code)]\n");
    submission.replace("path.rs", first, &with_rays);
    let viewer = start(&submission);
    let state = viewer.wait_for(|state| state["panics"] != json!([]));
    let message = state["panics"][0]["message"].as_str().unwrap();
    assert!(message.contains("the path never ends"), "{message}");
    let explanation = viewer.explain([8, 1], Some(0));
    let problem = explanation["history"][1]["problems"][0].as_str().unwrap();
    assert!(problem.contains("the path never ends"), "{problem}");

    submission.write("path.rs", &correct);
    viewer.wait_for_picture();
    let without_rays = format!("{first}    while bounces < 9999 {{ std::hint::black_box(()); }}\n");
    submission.replace("path.rs", first, &without_rays);
    let state = viewer.wait_for(|state| state["has_stopped"] == true);
    let message = state["panics"][0]["message"].as_str().unwrap();
    assert!(
        message.contains("`radiance`: ") && message.contains("it took too long"),
        "{message}"
    );
    let line = correct
        .lines()
        .position(|line| line.contains("pub fn radiance("));
    let location = format!("path.rs:{}", line.unwrap() + 1);
    assert_eq!(state["panics"][0]["location"], location);
}
