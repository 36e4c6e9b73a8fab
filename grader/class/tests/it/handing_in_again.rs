//! Messages to people whose submissions cannot be graded, and the corrected hand-ins that replace
//! them.

use std::fs;

use crate::harness::{
    TestClass, all_files, assert_contains, cell, files_below, solution, source, workspace,
};

const ITEMS: [&str; 1] = ["camera.offset"];
const ROSTER: &str = "name,username,email,datetime\n\
    Ann Lee,ann,,\n\
    Bob Kim,bob,bob@x.edu,2026-11-20 12:00:00 +0000\n\
    Carl Ode,carl,carl@x.edu,2026-11-20 13:00:00 +0000\n\
    Dora Day,dora,,\n\
    Eve Fox,eve,eve@x.edu,\n";
const SENTENCE: &str = "The files were handed in again";

/// Bob's archive is damaged, Carl handed in some other file, and Dora handed in nothing. Eve handed
/// in one file twice, in two submissions. Only staff can find out who the files in `tut` belong to.
fn class() -> TestClass {
    TestClass::named("class")
        .with_reference("ann")
        .with("bob.zip", "PK\x03\x04 and no more")
        .with("carl/notes.txt", "later")
        .with_folder("dora")
        .with("eve/a/camera.rs", "// one")
        .with("eve/b/camera.rs", "// another")
        .with_folder("eve@x.edu")
        .with("tut/camera.rs", "// one")
        .with("tut/camera (1).rs", "// another")
        .with("tut/camera (2).rs", "// a third")
}

/// Adds a corrected hand-in to the folder `corrected`, next to the class's folder. Returns the path
/// of this folder.
fn correct(class: &TestClass, path: &str, bytes: impl AsRef<[u8]>) -> String {
    let folder = class.path_beside("corrected");
    let path = folder.join(path);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(path, bytes).unwrap();
    folder.to_str().unwrap().to_owned()
}

fn remove_corrections(class: &TestClass) {
    fs::remove_dir_all(class.path_beside("corrected")).unwrap();
}

fn texts(class: &TestClass) -> Vec<String> {
    let files = files_below(&class.out().join("hand-in-again")).into_iter();
    let text = |path: std::path::PathBuf| {
        let name = path.file_name().unwrap().display().to_string();
        format!("== {name}\n{}", fs::read_to_string(path).unwrap())
    };
    files.map(text).collect()
}

#[test]
fn a_corrected_hand_in_is_graded_with_the_time_of_the_first() {
    let class = class();
    let exam = class.small_exam(&ITEMS);
    let lists = [("roster", ROSTER)];
    let printed = class.graded_with(&exam, &lists, &[]);
    let expected = [
        "4 messages for students who need to resubmit",
        "  nothing to grade; ask for the files, using the message in hand-in-again, or give manual \
         points:\n    it is damaged (Missing end of central directory): download or pack it again: \
         bob (Bob Kim)\n    no task files were handed in, only notes.txt: carl (Carl Ode)\n    \
         nothing was handed in: dora (Dora Day)\n",
        "  nothing to grade: the folder tut contains several versions",
    ];
    assert_contains(&printed, &expected);
    insta::assert_snapshot!(texts(&class).join("\n"));

    correct(&class, "bob@x.edu.zip", solution());
    correct(
        &class,
        "Carl Ode/student/src/camera.rs",
        source("reference/src/camera.rs"),
    );
    let folder = correct(&class, "dora/still not.txt", "");
    let corrected = ["--corrected", &folder];
    let printed = class.graded_with(&exam, &lists, &corrected);
    assert_contains(&printed, &["2 messages for students who need to resubmit"]);
    let of = |id, name, columns: [&str; 3]| columns.map(|column| cell(&class, id, name, column));
    let columns = ["status", "submitted", "from"];
    let time = "2026-11-20 12:00:00 +0000";
    let bob = of("bob", "Bob Kim", columns);
    assert_eq!(bob, ["graded", time, "bob.zip (corrected: bob@x.edu.zip)"]);
    let carl = of("carl", "Carl Ode", columns);
    let time = "2026-11-20 13:00:00 +0000";
    assert_eq!(carl, ["graded", time, "carl (corrected: Carl Ode)"]);
    let dora = cell(&class, "dora", "Dora Day", "why");
    assert_contains(&dora, &["only still not.txt"]);
    for page in [
        "class.html",
        "students/bob/report.html",
        "students/bob/feedback.html",
    ] {
        assert_contains(&class.read(page), &[SENTENCE]);
    }
    assert!(!class.read("students/ann/feedback.html").contains(SENTENCE));

    let refused = class.refused(&exam, &[]);
    let expected = "contains points for corrected submissions, such as bob: pass the folder";
    assert_contains(&refused, &[expected]);
    let empty = class.path_beside("empty");
    fs::create_dir(&empty).unwrap();
    let printed = class.graded(&exam, &["--corrected", empty.to_str().unwrap()]);
    let why = "previously graded 2, the corrected files are no longer used";
    assert_contains(&printed, &[why]);
    assert_eq!(
        of("bob", "Bob Kim", columns),
        ["nothing to grade", "2026-11-20 12:00:00 +0000", "bob.zip"]
    );
    assert_eq!(texts(&class).len(), 4);
}

/// The other files that Fay's submission lacks are not in the exam.
#[test]
fn a_missing_file_costs_its_tasks_points_and_can_be_handed_in_later() {
    let class = TestClass::named("class")
        .with_reference("ann")
        .with("fay/sphere.rs", source("reference/src/sphere.rs"));
    let exam = class.small_exam(&["camera.offset", "sphere.radius"]);
    let printed = class.graded(&exam, &[]);
    assert_contains(&printed, &["1 message for students who need to resubmit"]);
    let [text] = texts(&class).try_into().unwrap();
    let expected = [
        "To: fay",
        "- fay: these files are missing, so their tasks earn 0 points: camera.rs\n",
    ];
    assert_contains(&text, &expected);
    let page = class.read("students/fay/feedback.html");
    assert_contains(&page, &["camera.rs is missing"]);

    let remedy = "a file is missing: camera.rs; ask for it, using the message in hand-in-again";
    assert_contains(&printed, &[remedy]);

    let manual = "student,task,delta,comment,author\nfay,camera,1,shown in class,Tess\n";
    let blind = class.path_beside("blind");
    let options = ["--anonymous", blind.to_str().unwrap()];
    let printed = class.graded_with(&exam, &[("manual-points", manual)], &options);
    assert!(texts(&class).is_empty(), "staff have decided");
    let page = fs::read_to_string(blind.join("class.html")).unwrap();
    for text in [printed, class.read("class.html"), page] {
        assert_contains(&text, &["a file is missing: camera.rs"]);
        assert!(!text.contains("using the message"), "{text}");
    }
}

#[test]
fn a_corrected_hand_in_without_its_submission_is_an_error() {
    let class = class();
    let roster = class.write_beside("roster.csv", ROSTER);
    let run = |folder: &str| {
        let folder = class.path_beside(folder).display().to_string();
        let error = class.refused_preview(&["--roster", &roster, "--corrected", &folder]);
        error.replace(&class.path_beside("").display().to_string(), "")
    };
    let mut errors = vec![run("missing"), run("class/dora")];
    for names in [
        &["bobb.zip"][..],
        &["Eve Fox.zip"],
        &["bob.zip", "Bob Kim.zip"],
    ] {
        for name in names {
            correct(&class, name, solution());
        }
        errors.push(run("corrected"));
        remove_corrections(&class);
    }
    insta::assert_snapshot!(errors.join("\n"));
}

#[test]
fn the_dry_run_shows_corrected_files_and_those_of_nobody() {
    let class = class();
    correct(&class, "bob.zip", solution());
    let folder = correct(&class, "camera.rs", "// whose?");
    let preview = class.previewed(&["--corrected", &folder]);
    let expected = [
        "corrected/camera.rs: neither a folder nor an archive",
        &(all_files("bob") + "\n      bob.zip (corrected: bob.zip)"),
    ];
    assert_contains(&preview, &expected);
}

/// By default, `cargo handin` packs a different assignment.
#[test]
fn the_message_names_the_assignment_and_its_archive() {
    let class = TestClass::named("class").with("bob.zip", "PK\x03\x04 and no more");
    let exam = workspace().join("grader/exams/light.json");
    class.graded(exam.to_str().unwrap(), &[]);
    let [text] = texts(&class).try_into().unwrap();
    let expected = [
        "\n    cargo handin --assignment light\n",
        "creates the archive handin-light.zip from your material.rs, ",
        "send us handin-light.zip in reply",
    ];
    assert_contains(&text, &expected);
}

/// Ann's corrected files earn less than her other attempt, which therefore counts.
#[test]
fn the_same_name_stands_for_the_same_attempt_in_every_run() {
    let class = TestClass::named("class")
        .with_offset_mistake("ann")
        .with_reference("u1");
    let exam = class.small_exam(&["camera.offset", "sphere.radius"]);
    let roster = "name,sid,username\nAnn Lee,u1,ann\n";
    let policy = "[attempts]\ncounts = 'best'\n";
    class.graded_with(&exam, &[("roster", roster), ("policy", policy)], &[]);
    for file in ["camera.rs", "sphere.rs"] {
        let text = source(&format!("grader/starter/{file}"));
        correct(&class, &format!("Ann Lee/{file}"), text);
    }
    let folder = class.path_beside("corrected").display().to_string();
    for _ in 0..3 {
        class.graded(&exam, &["--corrected", &folder]);
        let points = ["ann", "u1"].map(|id| cell(&class, id, "Ann Lee", "points"));
        assert_eq!(points, ["1", "0"]);
    }
}

#[test]
fn a_corrected_hand_in_may_have_the_name_of_the_archive_that_it_replaces() {
    let class = TestClass::named("submissions")
        .with("leeann_7001_9001_notes.txt", "text")
        .with("leeann_7001_9002_hw.zip", "PK\x03\x04 and no more")
        .with("kimbob_7002_9003_hw.zip", solution());
    for path in ["leeann_7001_9002_hw.zip", "leeann_7001_9002_hw/hw.zip"] {
        let folder = correct(&class, path, solution());
        let preview = class.previewed(&["--corrected", &folder]);
        let name = path.trim_end_matches("/hw.zip");
        let expected = format!("(corrected: {name})");
        assert_contains(&preview, &[all_files("leeann"), expected]);
        remove_corrections(&class);
    }
}

#[test]
fn a_second_download_is_a_correction_too() {
    let broken = "PK\x03\x04 and no more";
    let class = TestClass::named("class")
        .with("Ann Lee.zip", broken)
        .with("bob.zip", broken);
    let folder = class.path_beside("corrected").display().to_string();
    for name in [
        "Ann_Lee-2.zip",
        "Ann Lee (1).zip",
        "Ann Lee(1).zip",
        "Ann Lee copy.zip",
        "Ann Lee - Copy (2).zip",
        "Copy of Ann Lee.zip",
        "Ann_Lee.zip (1)",
        "Ann Lee 2/handin.zip",
    ] {
        correct(&class, name, solution());
        let preview = class.previewed(&["--corrected", &folder]);
        let name = name.trim_end_matches("/handin.zip");
        let expected = format!("\n      Ann Lee.zip (corrected: {name})");
        assert_contains(&preview, &[all_files("Ann Lee") + &expected]);
        remove_corrections(&class);
    }
    let refused = |names: &[&str]| {
        for name in names {
            correct(&class, name, solution());
        }
        let error = class.refused_preview(&["--corrected", &folder]);
        remove_corrections(&class);
        error
    };
    let error = refused(&["Ann Lee.zip", "Ann Lee (1).zip"]);
    assert_contains(
        &error,
        &["Ann Lee.zip and Ann Lee (1).zip both contain corrections"],
    );
    assert_contains(&refused(&["bobb-2.zip"]), &["\"bobb-2\" doesn't match any"]);

    correct(&class, "bob.zip", solution());
    correct(&class, ".Ann Lee.zip", solution());
    let preview = class.previewed(&["--corrected", &folder]);
    assert_contains(
        &preview,
        &["corrected/.Ann Lee.zip: its name begins with a dot"],
    );
}

#[test]
fn a_second_download_that_could_be_somebody_elses_is_refused_with_both_readings() {
    let broken = "PK\x03\x04 and no more";
    let class = TestClass::named("pt-submissions")
        .with("pt-ann/notes.txt", "")
        .with("pt-ann-2/notes.txt", "");
    let roster = class.write_beside("roster.csv", "name,username\nAnn Lee,ann\nAnn Ray,ann-2\n");
    let folder = correct(&class, "ann-2.zip", solution());
    let options = ["--roster", &roster, "--corrected", &folder];
    let error = class.refused_preview(&options);
    let expected = "ann-2.zip: it could be for pt-ann-2 or pt-ann, since \"ann-2\" is also the name \
                    that browsers give to a second download: rename the file to one of these names";
    assert_contains(&error, &[expected]);
    remove_corrections(&class);
    correct(&class, "pt-ann-2.zip", solution());
    let preview = class.previewed(&options);
    assert_contains(&preview, &["pt-ann-2 (corrected: pt-ann-2.zip)"]);

    // Eve has two attempts.
    let class = TestClass::named("class")
        .with("eve.zip", broken)
        .with("e1/x.txt", "");
    let roster = class.write_beside("roster.csv", "name,username,sid\nEve Fox,eve,e1\n");
    let folder = correct(&class, "Eve_Fox (1).zip", solution());
    let error = class.refused_preview(&["--roster", &roster, "--corrected", &folder]);
    assert_contains(
        &error,
        &["\"Eve_Fox\" could be e1 or eve: use one of these names"],
    );
}
