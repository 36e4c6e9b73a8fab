//! Several attempts by one person: whatever the layout, they are never graded as if two people had
//! handed them in.

use crate::harness::{TestClass, assert_contains, cell};

const SAME: &str = "belong to the same person";
const UNCLEAR: &str = "this may be another submission by the person who handed in";

/// Returns the preview of a class in this layout.
fn preview(layout: &str, files: &[(&str, &str)], roster: Option<&str>) -> String {
    let class = TestClass::named("class");
    let class = files
        .iter()
        .fold(class, |class, (path, text)| class.with(path, text));
    let lists = Vec::from_iter(roster.map(|text| ("roster", text)));
    class.previewed_with(&lists, &["--layout", layout])
}

/// Ann hands in twice, in each form that the platform's export can have.
#[test]
fn attempts_by_one_person_belong_to_one_person_in_every_layout() {
    let roster = Some("name,username\nAnn Lee,ann\n");
    for (layout, paths) in [
        (
            "brightspace",
            [
                "104840-17 - Ann Lee - Nov 19, 2026 933 PM/camera.rs",
                "104840-17 - Ann Lee - Nov 20, 2026 1134 PM - camera.rs",
            ],
        ),
        (
            "teams",
            [
                "Ann Lee/Hw/Version 1/camera.rs",
                "Ann Lee/Hw/Version 2/camera.rs",
            ],
        ),
        ("github", ["pt-ann/camera.rs", "pt-ann-1/camera.rs"]),
        ("gitlab", ["pt-Ann Lee/camera.rs", "pt-Ann Lee-1/camera.rs"]),
        ("folders", ["Ann Lee/camera.rs", "Ann_Lee (1)/camera.rs"]),
        ("folders", ["Ann Lee/camera.rs", "Ann Lee - Copy/camera.rs"]),
        ("folders", ["Lee, Ann/camera.rs", "ann/camera.rs"]),
    ] {
        let files = paths.map(|path| (path, "text"));
        let preview = preview(layout, &files, roster);
        assert_contains(&preview, &["2 submissions", SAME]);
    }
    // These platforms export the last attempt, or the files of one submission.
    for (layout, paths) in [
        (
            "canvas",
            [
                "leeann_7001_9001_camera.rs",
                "leeann_LATE_7001_9002_camera-1.rs",
            ],
        ),
        (
            "moodle",
            [
                "Ann Lee_301_assignsubmission_file_/camera.rs",
                "Ann Lee_301_assignsubmission_file_ (1)/camera.rs",
            ],
        ),
        (
            "sakai",
            [
                "Lee, Ann(ann)_Submission attachment(s)_camera.rs",
                "Lee, Ann(ann)_Submission attachment(s)_camera-1.rs",
            ],
        ),
    ] {
        let files = paths.map(|path| (path, "text"));
        assert_contains(&preview(layout, &files, roster), &["1 submission in"]);
    }
}

/// Blackboard's receipt for one of the attempts is missing.
#[test]
fn a_blackboard_attempt_without_a_receipt_belongs_to_the_person_in_the_other_receipt() {
    let [first, second] =
        ["19", "20"].map(|day| format!("gradebook_CG_Hw_ann_attempt_2026-11-{day}-10-00-00"));
    let files = [&first, &second].map(|attempt| format!("{attempt}_camera.rs"));
    for attempt in [first, second] {
        let receipt = format!("{attempt}.txt");
        let files = [
            (receipt.as_str(), "Name: Ann Lee (ann)\nAssignment: Hw\n"),
            (files[0].as_str(), "one"),
            (files[1].as_str(), "two"),
        ];
        let preview = preview("blackboard", &files, None);
        assert_contains(&preview, &["2 submissions", SAME]);
        assert_eq!(preview.matches("  Ann Lee: ").count(), 2, "{preview}");
    }
}

/// Without a receipt, the account begins where it does in the names of the other submissions.
#[test]
fn a_blackboard_account_without_a_receipt_is_read_like_the_others() {
    let name = |account: &str, day: &str| {
        format!("gradebook_CG_Hw_{account}_attempt_2026-11-{day}-10-00-00")
    };
    let class = TestClass::named("class")
        .with(
            &format!("{}.txt", name("john_doe", "19")),
            "Name: John Doe (john_doe)\n",
        )
        .with(&format!("{}_camera.rs", name("john_doe", "19")), "text")
        .with(&format!("{}_camera.rs", name("john_roe", "20")), "text");
    let preview = class.preview();
    assert_contains(&preview, &["  John Doe: 1 of", "  john_roe: 1 of"]);
}

#[test]
fn a_second_download_is_another_attempt_if_a_list_says_so_and_is_refused_otherwise() {
    let class = TestClass::named("class")
        .with_offset_mistake("Ann Lee")
        .with_reference("Ann Lee (1)")
        .with_reference("bob");
    let exam = class.small_exam(&["camera.offset"]);
    let printed = class.graded(&exam, &[]);
    assert_contains(
        &printed,
        &[&format!("Ann Lee: {UNCLEAR} Ann Lee (1)"), "--roster"],
    );
    let status = |id: &str, name: &str| cell(&class, id, name, "status");
    let both = [("Ann_Lee", "Ann Lee"), ("Ann_Lee__1_", "Ann Lee (1)")];
    assert_eq!(
        both.map(|(id, name)| status(id, name)),
        ["person unclear"; 2]
    );
    assert_eq!(status("bob", "bob"), "graded");

    let policy = ("policy", "[attempts]\ncounts = 'best'\n");
    let roster = ("roster", "name\nAnn Lee\nbob\n");
    let printed = class.graded_with(&exam, &[roster, policy], &[]);
    assert!(!printed.contains(UNCLEAR), "{printed}");
    let all = ["Ann_Lee", "Ann_Lee__1_"].map(|id| status(id, "Ann Lee"));
    assert_eq!(all, ["another attempt counts", "graded"]);

    // Both names are on the list.
    let roster = ("roster", "name\nAnn Lee\nAnn Lee (1)\nbob\n");
    class.graded_with(&exam, &[roster, policy], &[]);
    assert_eq!(both.map(|(id, name)| status(id, name)), ["graded"; 2]);
}

#[test]
fn similar_names_of_different_people_are_no_attempts() {
    let class = TestClass::named("class")
        .with_minimal_submission("ann")
        .with_minimal_submission("ann2")
        .with_minimal_submission("Team 1")
        .with_minimal_submission("Team 2")
        .with_minimal_submission("Lee")
        .with_minimal_submission("van Lee")
        .with_minimal_submission("Lee_70010001");
    let preview = class.preview();
    assert!(
        !preview.contains(UNCLEAR) && !preview.contains(SAME),
        "{preview}"
    );
}
