//! Tests that every file that looks like a task file or an archive but isn't graded is mentioned
//! wherever people might look for it, and that an untouched starter file next to a changed copy is
//! never graded.

use grader::handed_out::RAYS;

use crate::harness::{TestClass, all_files, assert_contains, source, zip};

const WORK: &str = "// finished";

/// Returns an entry's line in the output of `--dry-run`.
fn line<'a>(preview: &'a str, who: &str) -> &'a str {
    let begin = format!("{who}: ");
    let line = preview.lines().map(str::trim);
    let mut line = line.filter(|line| line.starts_with(&begin));
    line.next().unwrap_or_else(|| panic!("{who}: {preview}"))
}

#[test]
fn a_starter_file_beside_a_changed_copy_is_left_to_a_person() {
    let work = zip([("hw/camera.rs", WORK)]);
    let inner = zip([("work.zip", &work)]);
    let copies = [
        "camera (1).rs",
        "camera(1).rs",
        "camera - Copy.rs",
        "camera 2.rs",
        "camera-1.rs",
        "Camera.rs",
        "CAMERA.RS",
        "camera_final.rs",
        "camera.rs.txt",
        "camera.rs.bak",
        "camera.rs~",
        "camera.txt",
        "mycamera.rs",
        "Kopie von camera.rs",
        "camera (conflicted copy 2026-11-20).rs",
        "#camera.rs#",
        ".camera.rs.swp",
        "old/camera_v2.rs",
        "camera.rs.rs",
        "CAMERA (2).RS.orig",
    ];
    let copies = copies.map(|copy| (copy, copy, WORK.as_bytes()));
    let archives = [
        ("sub/work.zip", "sub/work.zip/hw/camera.rs", &*work),
        ("work (1).zip", "work (1).zip/hw/camera.rs", &work),
        ("outer.zip", "outer.zip/work.zip/hw/camera.rs", &inner),
    ];
    let files = copies.iter().chain(&archives).enumerate();
    let files = files.map(|(number, file)| (format!("s{number}"), file));
    let add = |class: TestClass, (who, (path, _, bytes)): (String, &(&str, _, &[u8]))| {
        class
            .with_starter(&who)
            .with(&format!("{who}/{path}"), bytes)
    };
    let class = files.clone().fold(TestClass::named("class"), add);
    let preview = class.preview();
    for (who, (_, copy, _)) in files {
        let expected = format!(
            "{who}: nothing to grade: it contains the unmodified starter version of camera.rs, and \
             modified copies in {copy}: keep"
        );
        let line = line(&preview, &who);
        assert!(line.starts_with(&expected), "{line}");
    }
}

#[test]
fn a_copy_counts_only_if_no_other_file_could_be_meant() {
    let copies = [
        ("firefox", "camera(1).rs"),
        ("finder", "camera 2.rs"),
        ("explorer", "camera - Copy.rs"),
        ("capital", "Camera.rs"),
        ("named", "camera_final.rs"),
        ("two", "camera (1).rs"),
    ];
    let input = |class: TestClass, (who, copy): (&str, &str)| {
        let class = class
            .with_reference(who)
            .with(&format!("{who}/{copy}"), WORK);
        std::fs::remove_file(class.input().join(who).join("camera.rs")).unwrap();
        class
    };
    let class = copies.into_iter().fold(TestClass::named("class"), input);
    let class = class.with("two/camera (2).rs", "// another");
    let preview = class.preview();
    for (who, copy) in &copies[..3] {
        let expected = format!("{}; {copy} is graded as camera.rs", all_files(who));
        assert_eq!(line(&preview, who), expected);
    }
    let (count, points) = (RAYS.files.len(), RAYS.assignment.tasks[0].points);
    for (who, copy) in &copies[3..5] {
        let expected = format!(
            "{who}: {} of {count} files; camera.rs is missing; {copy} is not graded because its \
             name is not camera.rs; this costs {points} points",
            count - 1
        );
        assert_eq!(line(&preview, who), expected);
    }
    let two = "two: nothing to grade: it contains different copies of camera.rs, in camera (1).rs \
        and camera (2).rs: keep";
    assert!(line(&preview, "two").starts_with(two), "{preview}");
}

#[test]
fn a_folder_for_each_task_is_one_submission_if_no_file_has_two_versions() {
    let part = |who: &str, folder: &str, name: &str| {
        (
            format!("Ann_{who}_assignsubmission_file_/{folder}/{name}"),
            WORK,
        )
    };
    let folders = ["task1", "task2"].into_iter().cycle();
    let complete = folders
        .zip(RAYS.file_names())
        .map(|(folder, name)| part("301", folder, name));
    let others = [
        part("302", "task1", "camera.rs"),
        part("302", "task2", "bvh.rs"),
        (
            "Ann_302_assignsubmission_file_/old/bvh.rs".to_owned(),
            "// old",
        ),
    ];
    let add = |class: TestClass, (path, text): (String, &str)| class.with(&path, text);
    let preview = complete
        .chain(others)
        .fold(TestClass::named("class"), add)
        .preview();
    let refused = "it contains different copies of bvh.rs, in old and task2: keep only the one \
                   that should be graded";
    assert_contains(&preview, &[refused, &format!("{}\n", all_files(""))]);
}

#[test]
fn files_with_other_names_are_named_once() {
    let class = TestClass::named("class")
        .with("ann/camera.rs.txt", WORK)
        .with("ann/bvh.rs.txt", WORK)
        .with("bob/.git/HEAD", "");
    let preview = class.preview();
    let expected = "ann: nothing to grade: no task files were handed in, only camera.rs.txt, \
                    bvh.rs.txt: name each file exactly like its task file, such as camera.rs; \
                    names must end in .rs";
    assert_eq!(line(&preview, "ann"), expected);
    assert_contains(&preview, &["bob: nothing to grade: nothing was handed in"]);
}

#[test]
fn files_that_are_not_graded_are_named_on_every_page() {
    let reference = source("reference/src/camera.rs");
    let class = TestClass::named("class")
        .with_reference("ann")
        .with_replaced(
            "ann/camera.rs",
            "pixel.as_vec2() + offset",
            "pixel.as_vec2() + 0.5",
        )
        .with("ann/camera_final.rs", reference)
        .with("ann/old/pictures.rar", "Rar!\x1a\x07\x01\0")
        .with_reference("bob");
    let exam = class.small_exam(&["camera.offset", "sphere.radius"]);
    let printed = class.graded(&exam, &[]);
    let notes = [
        "camera_final.rs differs from camera.rs and is ignored",
        "old/pictures.rar is not graded: it is a .rar archive",
    ];
    let page = class.read("class.html");
    let (_, attention) = page.split_once("Submissions that need attention").unwrap();
    let (attention, _) = attention.split_once("</section>").unwrap();
    assert_contains(attention, &["href=\"students/ann/report.html\""]);
    assert!(!attention.contains("bob"), "{attention}");
    for note in notes {
        for file in [
            "grades.csv",
            "students/ann/report.html",
            "students/ann/feedback.html",
        ] {
            assert_contains(&class.read(file), &[note]);
        }
        assert_contains(attention, &[note]);
        assert_contains(&printed, &[&note[..20]]);
        assert_contains(&class.preview(), &[note]);
    }
}

/// A class's archive in which one entry is a zip bomb, another contains too many files, and a third
/// contains too many archives.
#[test]
fn a_submission_that_is_too_large_affects_no_other() {
    let class = TestClass::named("class");
    let mut files = Vec::new();
    for who in ["ann", "bomb", "many", "archives"] {
        for file in RAYS.file_names() {
            files.push((format!("{who}/{file}"), b"text".to_vec()));
        }
    }
    let empty = |number| (format!("many/{number}.txt"), Vec::new());
    files.extend((0..50_001).map(empty));
    let inner = zip([("a.txt", "")]);
    let inner = |number| (format!("archives/{number}.zip"), inner.clone());
    files.extend((0..200).map(inner));
    files.push(("bomb/work.zip".to_owned(), vec![0; 257 << 20]));
    let archive = class.path_beside("class.zip");
    std::fs::write(&archive, zip(files)).unwrap();
    let preview = class.preview_of(&archive, &[]);
    assert_eq!(line(&preview, "ann"), all_files("ann"));
    for (who, why) in [
        ("bomb", "work.zip cannot be unpacked: it is 257 MiB"),
        (
            "many",
            "it contains too many files and folders (more than 50000): hand in only the task files",
        ),
        (
            "archives",
            "it contains too many archives (more than 32): hand in only the task files",
        ),
    ] {
        let line = line(&preview, who);
        assert!(line.contains(&format!("nothing to grade: {why}")), "{line}");
    }
}

#[test]
fn files_that_a_platform_writes_into_a_folder_are_not_handed_in() {
    let class = TestClass::named("Path tracer")
        .with_minimal_submission("Lee, Ann(ann)/Submission attachment(s)")
        .with("Kim, Bob(bob)/timestamp.txt", "20261120173000000");
    assert_contains(
        &class.preview(),
        &["Bob Kim: nothing to grade: nothing was handed in\n"],
    );
    let class = TestClass::named("pt-submissions")
        .with_minimal_submission("pt-ann")
        .with("pt-bob/README.md", "# Path tracer")
        .with("pt-bob/result.json", "{}");
    let expected = "bob: nothing to grade: no task files were handed in, only README.md\n";
    assert_contains(&class.preview(), &[expected]);
}
