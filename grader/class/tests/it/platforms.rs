//! Exports of platforms that record several attempts. The names come from the platforms' sources and
//! from tools that read their exports.

use std::fs;
use std::path::Path;

use grader::handed_out::RAYS;
use insta::assert_snapshot;

use crate::harness::{
    TestClass, all_files, assert_contains, cell, files_below, source, successful_stdout, zip,
};

/// Returns the receipt that Blackboard writes for each attempt.
fn receipt(person: &str) -> String {
    format!(
        "\u{feff}Name: {person}\r\nAssignment: Path_tracer\r\n\
         Date Submitted: Friday, 20 November 2026 23:34:05 o'clock CET\r\nCurrent Mark: Needs Marking\r\n\r\n\
         Submission Field:\r\nThere is no student submission text data for this assignment.\r\n"
    )
}

fn blackboard() -> TestClass {
    let title = "gradebook_CG26_Path_tracer";
    let early = format!("{title}_john_doe_attempt_2026-11-19-10-00-00");
    let late = format!("{title}_john_doe_attempt_2026-11-21-10-00-00");
    let zoe = format!("{title}_u42_attempt_2026-11-20-23-34-05");
    let text = format!("{title}_bob_attempt_2026-11-20-12-00-00");
    let receiptless = format!("{title}_eve_attempt_2026-11-20-13-00-00");
    TestClass::named("export")
        .with(&format!("{early}.txt"), receipt("John Doe (john_doe)"))
        .with(
            &format!("{early}_camera.rs"),
            source("reference/src/camera.rs"),
        )
        .with(&format!("{late}.txt"), receipt("John Doe (john_doe)"))
        .with(
            &format!("{late}_camera.rs"),
            source("grader/starter/camera.rs"),
        )
        .with(&format!("{zoe}.txt"), receipt("Zoë O'Hara (PhD) (u42)"))
        .with(
            &format!("{zoe}_my work.zip"),
            zip([("src/camera.rs", "text")]),
        )
        // One of Zoë's files is named like somebody else's receipt.
        .with(
            &format!("{zoe}_x_bob_attempt_2026-11-20-12-00-00.txt"),
            receipt("Bob (bob)"),
        )
        .with(&format!("{text}.txt"), receipt("Bob Lee (bob)"))
        .with(&format!("{receiptless}_camera.rs"), "text")
        .with("notes.txt", "text")
}

#[test]
fn reads_blackboard_attempts_with_the_people_in_their_receipts() {
    assert_snapshot!(blackboard().preview());
}

#[test]
fn the_policy_chooses_among_attempts_by_their_times() {
    let class = blackboard();
    let policy = "[late]\ndue = 2026-11-20T23:59:59+01:00\ntimezone = 'Europe/Berlin'\n\
                  percent_per_day = 10\n[attempts]\ncounts = 'latest'\n";
    let exam = class.small_exam(&["camera.offset"]);
    class.graded_with(&exam, &[("policy", policy)], &[]);
    let of = |time: &str, column: &str| {
        cell(
            &class,
            &format!("john_doe_2026-11-{time}-10-00-00"),
            "John Doe",
            column,
        )
    };
    assert_eq!(of("19", "counts"), "");
    assert_contains(&of("19", "why"), &["john_doe_2026-11-21-10-00-00"]);
    assert_eq!(of("21", "late_days"), "1");
    assert_eq!(of("21", "submitted"), "2026-11-21 10:00:00");

    // The change is listed once for each person, although two of the submissions' grades changed.
    let best = ("policy", &*policy.replace("latest", "best"));
    let printed = class.graded_with(&exam, &[best], &[]);
    let [one, other] = ["19", "21"].map(|day| format!("john_doe_2026-11-{day}-10-00-00"));
    let change =
        format!("\n  {one} (John Doe): 0 → 2: this attempt counts instead of {other}, graded");
    assert_contains(
        &printed,
        &["1 final grade changed (changed: the policy)", &change],
    );
}

#[test]
fn reads_brightspace_attempts_in_folders_and_flat() {
    let class = TestClass::named("Path tracer Download Nov 27, 2026 1124 AM")
        .with("index.html", "<html>")
        .with_minimal_submission("104840-170649 - Ann - Marie Lee - Nov 19, 2026 933 PM")
        .with_minimal_submission("104840-170649 - Ann - Marie Lee - Nov 20, 2026 1134 PM")
        .with(
            "104860-170649 - . Karan Singh - Nov 20, 2026 1059 PM/hw.zip",
            zip([("bvh.rs", "text")]),
        )
        .with(
            "104861-170649 - Bob O'Hara - Nov 20, 2026 12:01 AM - camera.rs",
            "text",
        )
        .with(
            "104861-170649 - Bob O'Hara - Nov 20, 2026 12:01 AM - bvh.rs",
            "text",
        )
        .with_folder("someone else");
    assert_snapshot!(class.preview());
}

/// Sakai strips non-Latin letters from folder names, but not from its list.
fn sakai(folder: &str) -> TestClass {
    let class = TestClass::named("bulk_download");
    let path = |name: &str| format!("{folder}/{name}");
    let attachments = |name: &str| path(&format!("{name}/Submission attachment(s)"));
    let with_time = |class: TestClass, name: &str, time: &str| {
        class.with(&path(&format!("{name}/timestamp.txt")), time)
    };
    let group = "Team A (0d5a2a1e-96a8-4a0b-9a1c-1f2e3d4c5b6a)";
    let hidden = "7c9e6679-7425-40de-944b-e07fc1f90ae7 Anonymous";
    let class = with_time(class, "Lee, Ann(ann)", "20261121093405000");
    let class = with_time(
        class,
        "Kim, Bob (Bobby)(bob@x.edu)",
        "2026-11-20T22:34:05.123Z",
    );
    let class = with_time(class, group, "2026-11-20T22:34:05.123Z");
    class
        .with(
            &path("grades.csv"),
            "\"Path tracer\",\"SCORE_GRADE_TYPE\"\n\"\"\n\
             \"Display ID\",\"ID\",\"Last Name\",\"First Name\",\"grade\"\n\
             \"u12\",\"li\",\"李\",\"明\",\"\"\n\"u13\",\"zoe\",\"Z\",\"Zoë\",\"\"\n",
        )
        .with(
            &format!("{}/camera.rs", attachments("Lee, Ann(ann)")),
            source("reference/src/camera.rs"),
        )
        // The instructor's file is not the student's.
        .with(
            &path("Lee, Ann(ann)/Feedback Attachment(s)/camera.rs"),
            "better",
        )
        .with(
            &path("Lee, Ann(ann)/Lee, Ann(ann)_submissionText.html"),
            "text",
        )
        .with_minimal_submission(&attachments("Kim, Bob (Bobby)(bob@x.edu)"))
        .with_folder(&attachments("Mono,(mono)"))
        .with_minimal_submission(&attachments(", (li)"))
        .with_minimal_submission(&attachments(group))
        .with(
            &path(&format!("{group}/members.txt")),
            // Sakai writes letters outside ASCII as entities.
            "Roe Garc&#237;a, Jos&#233;(jose); Li &#55360;&#56512;,(li2); Doe & Co,(doe)",
        )
        .with_minimal_submission(&attachments(hidden))
}

#[test]
fn reads_sakai_folders_with_times_and_groups() {
    let class = sakai("Path tracer");
    let preview = class.preview();
    assert_snapshot!(preview);
    let file = class.path_beside("bulk_download (1).zip");
    let files = files_below(&class.input()).into_iter().map(|path| {
        let name = path.strip_prefix(class.input()).unwrap().to_str().unwrap();
        (name.to_owned(), fs::read(&path).unwrap())
    });
    fs::write(&file, zip(files)).unwrap();
    // Archives don't have an entry for the empty folder.
    let packed = class.preview_of(&file, &[]);
    assert_contains(
        &packed,
        &[
            "5 submissions in a Sakai download",
            &all_files("明 李"),
            &all_files("José Roe García + Li \u{200c0} + Doe & Co"),
        ],
    );
}

#[test]
fn the_times_in_sakais_folders_count() {
    let class = sakai("Path tracer");
    let policy = "[late]\ndue = 2026-11-20T23:59:59+01:00\npercent_per_day = 10\n";
    let exam = class.small_exam(&["camera.offset"]);
    class.graded_with(&exam, &[("policy", policy)], &[]);
    let late = |id: &str, name: &str| cell(&class, id, name, "late_days");
    assert_eq!(late("Lee__Ann_ann_", "Ann Lee"), "1");
    assert_eq!(late("Kim__Bob__Bobby__bob_x.edu_", "Bob (Bobby) Kim"), "0");
}

/// No list names the group, which is only known by the names of its folder and its members. The
/// folder's time is two days after the due time.
#[test]
fn an_extension_can_have_any_name_that_is_shown_for_a_group_or_its_members() {
    let class = sakai("Path tracer");
    let exam = class.small_exam(&["camera.offset"]);
    let policy = |extensions: &str| {
        let due = "[late]\ndue = 2026-11-18T23:59:59+01:00\n";
        ("policy", format!("{due}[late.extensions]\n{extensions}"))
    };
    let members = ["José Roe García", "Li \u{200c0}", "Doe & Co"];
    let late_days = |extensions: &str| {
        let (list, text) = policy(extensions);
        let lists = class.lists(&[(list, &text)]);
        let lists: Vec<&str> = lists.iter().map(String::as_str).collect();
        let output = class.grade(&exam, &lists);
        successful_stdout(&output);
        let warnings = String::from_utf8(output.stderr).unwrap();
        assert!(!warnings.contains("an extension for"), "{warnings}");
        members.map(|name| cell(&class, "Team_A", name, "late_days"))
    };
    assert_eq!(late_days(""), ["2"; 3]);
    for name in [
        "Team A",
        "team_a",
        "Team A (0d5a2a1e-96a8-4a0b-9a1c-1f2e3d4c5b6a)",
        "José Roe García + Li \u{200c0} + Doe & Co",
    ] {
        assert_eq!(late_days(&format!("'{name}' = 2\n")), ["0"; 3], "{name}");
    }
    for name in ["jose", "JOSÉ ROE GARCÍA", "José Roe-García"] {
        let expected = ["0", "2", "2"];
        assert_eq!(late_days(&format!("'{name}' = 2\n")), expected, "{name}");
    }
    assert_eq!(late_days("'Team A' = 1\nli2 = 2\n"), ["1", "0", "1"]);
}

#[test]
fn reads_sakai_files_without_folders() {
    let class = TestClass::named("Path tracer")
        .with("Lee, Ann(ann)_Submission attachment(s)_camera.rs", "text")
        .with(
            "Lee, Ann(ann)_Submission attachment(s)_my (1).zip",
            zip([("bvh.rs", "text")]),
        )
        .with("Lee, Ann(ann)_submissionText.html", "text")
        .with("Kim, Bob(bob)_submissionText.html", "text")
        .with("grades.csv", "");
    assert_snapshot!(class.preview());
}

fn teams(class: TestClass) -> TestClass {
    let submitted = |person: &str, version: &str| {
        format!("Submitted files/{person}/Path tracer/Version {version}")
    };
    class
        .with_minimal_submission(&submitted("Ann Lee", "1"))
        .with_minimal_submission(&submitted("Ann Lee", "2"))
        .with(
            &format!("{}/hw.zip", submitted("Bob O'Hara", "1")),
            zip([("bvh.rs", "text")]),
        )
        .with("Submitted files/Bob O'Hara/Path tracer/stray.rs", "text")
        .with("Working files/Ann Lee/Path tracer/camera.rs", "draft")
}

#[test]
fn reads_the_versions_in_a_teams_library() {
    let class = teams(TestClass::named("CG26 - Student Work"));
    let preview = class.preview();
    assert_snapshot!(preview);
    let submitted = class.input().join("Submitted files");
    assert_contains(
        &class.preview_of(&submitted, &[]),
        &["3 submissions in the submitted files"],
    );
}

#[test]
fn one_of_several_assignments_in_teams_is_chosen_by_its_title() {
    let class = teams(TestClass::named("library"))
        .with_minimal_submission("Submitted files/Ann Lee/Essay/Version 1");
    let error = class.refused_preview(&[]);
    assert_contains(
        &error,
        &[
            "several assignments (Essay, Path tracer)",
            "choose one with --title",
        ],
    );
    let preview = class.previewed(&["--title", "Essay"]);
    assert_contains(
        &preview,
        &[
            "1 submission in the submitted files",
            "Ann Lee/Essay/Version 1",
        ],
    );
    let error = class.refused_preview(&["--title", "Eßay"]);
    assert_contains(&error, &["has the title \"Eßay\"", "Essay, Path tracer"]);
}

/// The tenth version is the last one, although its name sorts before the names of earlier versions.
#[test]
fn the_last_version_in_teams_counts_if_the_policy_says_so() {
    let version = |number: u32| format!("Submitted files/Ann Lee/Path tracer/Version {number}");
    let class = TestClass::named("library")
        .with_starter(&version(2))
        .with_reference(&version(10))
        .with_starter(&version(9));
    let exam = class.small_exam(&["camera.offset"]);
    let policy = ("policy", "[attempts]\ncounts = 'latest'\n");
    let roster = ("roster", "name\nBob Kim\n");
    let text = class.graded_with(&exam, &[policy, roster], &["--accept-unlisted"]);
    assert_contains(&text, &["1 handed in by people who aren't on the lists"]);
    assert!(!text.contains("belong to the same person"), "{text}");
    let status = |id: &str| cell(&class, id, "Ann Lee", "status");
    let all = ["Ann_Lee_2", "Ann_Lee_9", "Ann_Lee_10"].map(status);
    let other = "another attempt counts";
    assert_eq!(all, [other, other, "graded"]);
}

/// Microsoft translates the names of the folders.
#[test]
fn a_teams_library_in_another_language_is_read_if_it_is_chosen() {
    let class = TestClass::named("Eingereichte Dateien")
        .with_minimal_submission("Ann Lee/Path tracer/Version 1");
    let preview = class.previewed(&["--layout", "teams"]);
    assert_contains(&preview, &["1 submission in the submitted files"]);
    let class = class
        .with_minimal_submission("Bob/Path tracer/Version 1")
        .with_minimal_submission("Bob/Path tracer/Version 2");
    let preview = class.previewed(&["--layout", "teams"]);
    assert_contains(
        &preview,
        &[
            "3 submissions in the submitted files",
            "3 of 3 can be graded",
        ],
    );
}

/// If there is only one attempt and no receipt, it is unclear where the account name begins in the
/// file name.
#[test]
fn a_chosen_layout_enters_a_folder_that_is_no_submission() {
    let class = TestClass::named("download").with(
        "unpacked/Path_tracer_ann_attempt_2026-11-20-10-00-00_camera.rs",
        "text",
    );
    assert_contains(&class.preview(), &["1 submission in folders and archives"]);
    let preview = class.previewed(&["--layout", "blackboard"]);
    let expected = [
        "1 submission in a Blackboard download",
        &format!("  Path_tracer_ann: 1 of {} files", RAYS.files.len()),
    ];
    assert_contains(&preview, &expected);
    let file = class.path_beside("cg26.zip");
    let files = ["ann", "bob"].map(|name| (format!("cg26/{name}/camera.rs"), "text"));
    fs::write(&file, zip(files)).unwrap();
    let preview = class.preview_of(&file, &["--layout", "folders"]);
    assert_contains(&preview, &["2 submissions in folders and archives"]);
}

#[test]
fn names_of_two_platforms_are_refused_with_both_readings() {
    let class = TestClass::named("class")
        .with("leeann_302_9001_assignsubmission_file_camera.rs", "text")
        .with("doejane_303_9002_assignsubmission_file_camera.rs", "text");
    let error = class.refused_preview(&[]);
    assert_snapshot!(error, @"error: the input can be read in two ways: as a Canvas download, or as a Moodle download; choose one with --layout canvas or --layout moodle");
    let preview = class.previewed(&["--layout", "canvas"]);
    assert_contains(&preview, &["2 submissions in a Canvas download"]);
    let preview = class.previewed(&["--layout", "moodle"]);
    assert_contains(&preview, &["2 submissions in a Moodle download"]);
}

/// A link in any folder may lead to another student's files.
#[cfg(unix)]
#[test]
fn links_between_the_folders_of_a_platform_are_not_followed() {
    let class = teams(TestClass::named("library"));
    let submitted = class.input().join("Submitted files");
    let target = submitted.join("Ann Lee/Path tracer");
    let link = |path: &str, target: &Path| {
        std::os::unix::fs::symlink(target, submitted.join(path)).unwrap()
    };
    link(
        "Bob O'Hara/Path tracer/Version 2",
        &target.join("Version 1"),
    );
    link("Mallory", &submitted.join("Ann Lee"));
    let preview = class.preview();
    let expected = [
        "Version 2 is a link, and links are not followed",
        "Mallory: it is not in a version's folder",
    ];
    assert_contains(&preview, &expected);
    assert_eq!(preview.matches(&all_files("")).count(), 2);
}
