//! Previews of each platform's export. The names are as unusual as in real classes.

use std::fs::{self, File};
use std::io::Write;

use grader::handed_out::RAYS;
use insta::assert_snapshot;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use crate::harness::{TestClass, all_files, assert_contains, cell, files_below, zip};

/// Returns an archive with the task files in a subfolder.
fn archive() -> Vec<u8> {
    zip(RAYS
        .file_names()
        .map(|file| (format!("my work/src/{file}"), "text")))
}

/// Metadata as Ruby writes it, with symbols, unquoted numbers, tags and the results of earlier
/// grading.
const GRADESCOPE: &str = "---
submission_101:
  :submitters:
  - :name: Zoë Ångström, Jr.
    :sid: 70010001
    :email: zoe@example.edu
  :created_at: 2026-11-20 22:59:58.000000000 Z
  :score: 12.0
  :status: processed
  :results: !ruby/hash:ActiveSupport::HashWithIndifferentAccess
    output: |
      submission_999:
        :submitters:
        - :name: nobody
    tests: []
  :history:
  - :id: 99
    :created_at: 2026-11-19 10:00:00.000000000 Z
    :score:
    :submitters: []
submission_102:
  :submitters:
  - :name: \"=HYPERLINK(\\\"http://x\\\")\"
    :sid:
    :email: ann@example.edu
  - :name: 'Bob O''Hara'
    :sid: u42
    :email: bob@example.edu
  :created_at: 2026-11-21 00:10:00.000000000 Z
  :score:
  :status: processed
submission_103:
  :submitters:
  - :name: Empty Handed
    :sid: '0007'
    :email: empty@example.edu
  :created_at: 2026-11-20 12:00:00.000000000 Z
";

fn gradescope() -> TestClass {
    TestClass::named("assignment_55_export")
        .with("submission_metadata.yml", GRADESCOPE)
        .with_minimal_submission("submission_101")
        .with_minimal_submission("submission_102/student/src")
        .with("submission_102/student/Cargo.toml", "no")
        .with_minimal_submission("submission_104")
}

#[test]
fn reads_a_gradescope_export_with_groups() {
    assert_snapshot!(gradescope().preview());
}

/// The folder of submission 103 is missing, and submission 104 is not in the metadata.
#[test]
fn a_gradescope_record_without_a_folder_gets_no_points_and_no_message() {
    let class = gradescope();
    let printed = class.graded(&class.small_exam(&["camera.offset"]), &[]);
    let expected = [
        "submission_104: it is not in submission_metadata.yml",
        "its folder is not in the export; correct this in the input, or give manual points",
    ];
    assert_contains(&printed, &expected);
    let of = |column| cell(&class, "submission_103", "Empty Handed", column);
    let expected = ["nothing to grade", "", "its folder is not in the export"];
    assert_eq!(["status", "counts", "why"].map(of), expected);
    assert!(!class.out().join("hand-in-again").exists());
}

#[test]
fn an_archived_export_gives_the_same_preview() {
    let class = gradescope();
    let file = class.path_beside("assignment_55_export.zip");
    let files = files_below(&class.input()).into_iter().map(|path| {
        let name = path.strip_prefix(class.path_beside("")).unwrap();
        (name.to_str().unwrap().to_owned(), fs::read(&path).unwrap())
    });
    fs::write(&file, zip(files)).unwrap();
    let entered = "\n  the submissions are in the folder assignment_55_export\n";
    let preview = class.preview_of(&file, &[]);
    assert!(preview.contains(entered), "{preview}");
    assert_eq!(preview.replace(entered, ""), class.preview());
}

#[test]
fn unusual_files_of_one_student_do_not_affect_the_others() {
    let class = TestClass::named("beside");
    let file = class.path_beside("class.zip");
    let mut writer = ZipWriter::new(File::create(&file).unwrap());
    let plain = SimpleFileOptions::default();
    let mut write = |path: &str, bytes: &[u8]| {
        writer.start_file(path, plain).unwrap();
        writer.write_all(bytes).unwrap();
    };
    for file in RAYS.file_names() {
        write(&format!("class/fine/{file}"), b"text");
    }
    write("class/long/camera.rs", &[b' '; (1 << 20) + 1]);
    write("class/outside/../../escaped.rs", b"text");
    write(&format!("class/{}/camera.rs", "n".repeat(300)), b"text");
    // Files that aren't needed are created as empty files, even if they are large in the archive.
    write("class/junk/notes.bin", &[0; 2 << 20]);
    writer.add_directory("class/empty/", plain).unwrap();
    writer
        .add_symlink("class/link/camera.rs", "/etc/passwd", plain)
        .unwrap();
    writer.finish().unwrap();
    let preview = class.preview_of(&file, &[]);
    assert_snapshot!(preview.replace(&"n".repeat(300), "NNN"));
}

#[test]
fn reports_invalid_gradescope_metadata() {
    let class = TestClass::named("export").with("submission_metadata.yml", "submission_1: [");
    let error = class.refused_preview(&[]);
    let expected = ["submission_metadata.yml", "export the submissions again"];
    assert_contains(&error, &expected);
}

#[test]
fn groups_canvas_files_by_user_and_takes_the_newest() {
    let class = TestClass::named("submissions")
        .with("doejane_7001_9001_hw.zip", archive())
        .with("doejane_7001_9005_hw-1.zip", archive())
        .with("nunezjose_LATE_7002_9010_camera.rs", "old")
        .with("nunezjose_LATE_7002_9020_camera-1.rs", "text")
        .with("nunezjose_LATE_7002_9021_bvh.rs", "text")
        .with("nunezjose_LATE_7002_9022_notes.pdf", "text")
        .with("oharabob_7003_9030_report.pdf", "text")
        .with("leeann_LATE_7004_text.html", "text")
        .with("doejane_7001_link.html", "text")
        .with("anon_xK3f9_9040_hw.zip", archive());
    assert_snapshot!(class.preview());
}

#[test]
fn canvas_attachments_are_in_the_order_of_their_numbers() {
    let class = TestClass::named("submissions")
        .with("doejane_7001_999_hw.zip", archive())
        .with("doejane_7001_1000_hw-1.zip", archive())
        .with("leeann_7002_9001_hw.zip", archive());
    let preview = class.preview();
    let older = "doejane_7001_999_hw.zip: a newer archive with this name is graded";
    assert_contains(&preview, &["doejane_7001_1000_hw-1.zip and 1 more", older]);
}

#[test]
fn numbered_archives_of_one_canvas_user_can_be_parts() {
    let part = |file: &'static str| zip([(file, "text")]);
    let class = TestClass::named("submissions")
        .with("doejane_7001_9001_part-1.zip", part("camera.rs"))
        .with("doejane_7001_9002_part-2.zip", part("bvh.rs"))
        .with("leeann_7002_9003_hw-1.zip", part("bvh.rs"))
        .with("leeann_7002_9004_hw-2.zip", zip([("bvh.rs", "newer")]));
    let preview = class.preview();
    let expected = [
        &format!("doejane: 2 of {} files", RAYS.files.len()),
        "leeann: nothing to grade",
        "hw-1.zip",
    ];
    assert_contains(&preview, &expected);
}

#[test]
fn an_export_is_not_graded_as_one_submission() {
    let moodle = |people: &[&str]| {
        let path = |name| format!("{name}_assignsubmission_file_/camera.rs");
        zip(people.iter().map(|name| (path(name), "text")))
    };
    let class = TestClass::named("downloads")
        .with("CG-77.zip", moodle(&["Ann Lee_301", "Bob_302"]))
        .with("CG-78.zip", moodle(&["Carl_303"]));
    let expected = [
        "CG-77.zip is a Moodle download, not one submission: pass its path; to grade several",
        "or --layout folders if each folder is one submission",
    ];
    assert_contains(&class.refused_preview(&[]), &expected);
    let preview = class.previewed(&["--layout", "folders"]);
    assert_contains(&preview, &["2 of 2 can be graded"]);

    // One student's files from a platform are one submission.
    let class = TestClass::named("class")
        .with("ann/leeann_7001_9001_hw.zip", archive())
        .with("bob.zip", moodle(&["Bob_302"]));
    assert_contains(&class.preview(), &["ann: all", "2 of 2 can be graded"]);

    // Sakai's archive has a fixed name, unless somebody has renamed it.
    let file = "Path tracer/Doe, Jane(jdoe)/Submission attachment(s)/camera.rs";
    let list =
        "Path tracer,Points\n\nDisplay ID,ID,Last Name,First Name,grade\njdoe,jdoe,Doe,Jane,\n";
    let sakai = zip([(file, "text"), ("Path tracer/grades.csv", list)]);
    let class = TestClass::named("beside").with("week 3.zip", &sakai);
    let error = class.refused_preview(&[]);
    let expected = "week 3.zip is a Sakai download, not one submission: pass its path;";
    assert_contains(&error, &[expected]);
    let archive = class.input().join("week 3.zip");
    let preview = class.preview_of(&archive, &["--layout", "sakai"]);
    assert_contains(&preview, &["1 submission in a Sakai download", "Jane Doe"]);
    let class = TestClass::named("week 3")
        .with(file, "text")
        .with("Path tracer/grades.csv", list);
    let error = class.refused_preview(&[]);
    assert_contains(&error, &["pass its path, or use --layout sakai;"]);
}

#[test]
fn reads_moodle_folders_with_files_or_an_archive() {
    let class = TestClass::named("CG-Path tracing-77")
        .with_minimal_submission("José Núñez_301_assignsubmission_file_")
        .with(
            "Ann Lee, PhD_302_assignsubmission_file_/abgabe.zip",
            archive(),
        )
        .with("Bob_303_assignsubmission_file_/a.zip", archive())
        .with("Bob_303_assignsubmission_file_/b.zip", archive())
        .with_folder("Team A-Zoë_304_assignsubmission_file_")
        .with(
            "Carl_305_assignsubmission_onlinetext_/onlinetext.html",
            "text",
        )
        .with(
            "José Núñez_301_assignsubmission_onlinetext_/onlinetext.html",
            "text",
        );
    assert_snapshot!(class.preview());
}

#[test]
fn groups_flat_moodle_downloads_by_participant() {
    let class = TestClass::named("flat")
        .with("Ann Lee_302_assignsubmission_file_camera.rs", "text")
        .with("Ann Lee_302_assignsubmission_file_my_notes.txt", "text")
        .with("Participant_303_assignsubmission_file_hw.tar.gz", "text")
        .with("Bob_304_assignsubmission_file_a.zip", archive())
        .with("Bob_304_assignsubmission_file_b.zip", archive())
        .with("Eve_305_assignsubmission_file_bvh.rs", "text")
        .with("Eve_305_assignsubmission_file_scenes.zip", "text");
    assert_snapshot!(class.preview());
}

#[test]
fn names_github_clones_by_account_and_joins_the_roster() {
    let class = TestClass::named("pathtracing-submissions")
        .with_minimal_submission("pathtracing-ann-lee/student/src")
        .with_minimal_submission("pathtracing-zoe/student/src")
        .with("pathtracing-empty/README.md", "text");
    let roster = "name,email,github_username\n\"Lee, Ann\",ann@example.edu,Ann-Lee\n\
                  Bob,bob@example.edu,bob\n";
    assert_snapshot!(class.previewed_with(&[("roster", roster)], &[]));
}

#[test]
fn recognises_classroom50_clones() {
    let class = TestClass::named("2026-11-20")
        .with_minimal_submission("cg-pathtracing-ann/student/src")
        .with("cg-pathtracing-ann/result.json", "{}")
        .with_minimal_submission("cg-pathtracing-bob/student/src")
        .with("cg-pathtracing-bob/result.json", "{}")
        .with(
            "scores.csv",
            "username,first_name,last_name,email,datetime,late
ann,Ann,Lee,ann@example.edu,2026-11-20T10:00:00Z,true
ann,Ann,Lee,ann@example.edu,2026-11-19T10:00:00Z,false
bob,Bob,O'Hara,bob@example.edu,2026-11-19T10:00:00Z,false
dora,Dora,Y,dora@example.edu,,
",
        );
    assert_snapshot!(class.preview());
}

#[test]
fn reads_a_plain_folder_and_lists_everything_it_cannot_use() {
    let class = TestClass::named("class")
        .with_minimal_submission("ann lee")
        .with_minimal_submission("ANN_LEE")
        .with("bob.zip", archive())
        .with("bob/notes.txt", "text")
        .with("carl.rar", "Rar!\x1a\x07\x01\x00")
        .with("dora.tar.gz", "not at all")
        .with("evil\u{202e}.zip", &archive()[..100])
        .with("grades.xlsx", "text")
        .with_minimal_submission("two/a")
        .with_minimal_submission("two/b")
        .with("two/b/bvh.rs", "other")
        .with("eve.tar.xz", [0xfd, b'7', b'z', b'X', b'Z', 0, 0, 0]);
    assert_snapshot!(class.preview());
}

/// In each of these cases, files would be hidden or lost if only the top level was searched.
#[test]
fn nothing_that_was_handed_in_is_chosen_or_lost_silently() {
    let class = TestClass::named("class")
        .with_minimal_submission("a stray copy/student/src")
        .with("a stray copy/bvh.rs", "old")
        .with_starter("b starter at the top")
        .with_minimal_submission("b starter at the top/solution")
        .with("c file beside an archive/camera.rs", "text")
        .with("c file beside an archive/hw.zip", archive())
        .with("d other file beside an archive/camera.rs", "newer")
        .with("d other file beside an archive/hw.zip", archive())
        .with_minimal_submission("e deep/my/own/folder/of/work")
        .with_starter("f whole project/grader/starter")
        .with_minimal_submission("f whole project/student/src")
        .with(
            "f whole project/student/framework/src/scene/camera.rs",
            "given",
        )
        .with_minimal_submission("f whole project/target/package/src")
        .with_minimal_submission("g two versions/final")
        .with_minimal_submission("g two versions/final2")
        .with("g two versions/final2/bvh.rs", "newer")
        .with("h browser copies/bvh (1).rs", "text")
        .with("i two browser copies/bvh (1).rs", "text")
        .with("i two browser copies/bvh (2).rs", "other")
        .with("j damaged archive beside a file/bvh.rs", "text")
        .with("j damaged archive beside a file/hw.zip", &archive()[..100])
        .with("k something else/report.pdf", "text");
    assert_snapshot!(class.preview());
}

#[test]
fn loose_files_and_an_archive_of_one_canvas_user_are_taken_together() {
    let class = TestClass::named("submissions")
        .with("doejane_7001_9001_hw.zip", archive())
        .with("doejane_7001_9002_camera.rs", "text")
        .with("leeann_7002_9003_hw.zip", archive())
        .with("leeann_7002_9004_camera.rs", "newer");
    assert_snapshot!(class.preview());
}

#[test]
fn rejects_a_single_submission() {
    let class = TestClass::named("student").with("camera.rs", "text");
    let error = class.refused_preview(&[]);
    assert_contains(&error, &["to grade a single submission, use `cargo grade`"]);
}

#[test]
fn the_preview_says_who_has_not_started() {
    let class = TestClass::named("class")
        .with_reference("ann")
        .with_starter("bob");
    let preview = class.preview();
    let started = format!("{}\n", all_files("ann"));
    let unstarted = format!("{}, unmodified\n", all_files("bob"));
    assert_contains(&preview, &[started, unstarted]);
}
