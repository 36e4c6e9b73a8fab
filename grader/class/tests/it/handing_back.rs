//! The archive with the pages to hand back. The pages are named as each platform expects.

use crate::harness::{TestClass, assert_contains, files_below, solution, source, unzip};

const ITEMS: [&str; 1] = ["camera.offset"];

fn hand_back(class: &TestClass, lists: &[(&str, &str)]) -> (Vec<(String, Vec<u8>)>, String) {
    let exam = class.small_exam(&ITEMS);
    let text = class.graded_with(&exam, lists, &["--hand-back"]);
    let archive = std::fs::read(class.out().join("hand-back.zip")).unwrap();
    (unzip(&archive), text)
}

fn names(files: &[(String, Vec<u8>)]) -> Vec<&str> {
    files.iter().map(|(name, _)| name.as_str()).collect()
}

/// Canvas identifies a submission by the user's id and the id of one of their attachments.
#[test]
fn canvas_gets_each_page_under_the_name_of_an_attachment() {
    let bvh = source("reference/src/bvh.rs");
    let class = TestClass::named("submissions")
        .with("doejane_7001_9001_hw.zip", solution())
        .with("doejane_7001_9002_notes.pdf", "text")
        .with("leeann_LATE_7002_9003_bvh.rs", bvh)
        .with("anon_xK3f9_9040_hw-1.zip", solution())
        .with("emptyeve_7005_text.html", "text");
    let gradebook = "Student,ID,SIS User ID,SIS Login ID,Section,Path (7)\n\
                     \"Doe, Jane\",7001,u1,jane,A,\n\"Lee, Ann\",7002,u2,ann,A,\n";
    let (files, text) = hand_back(&class, &[("canvas", gradebook)]);
    let expected = [
        "anon_xK3f9_9040_hw-1.zip",
        "doejane_7001_9001_hw.zip",
        "leeann_LATE_7002_9003_bvh.rs.html",
    ];
    assert_eq!(names(&files), expected);
    let expected = [
        "to hand back: 3 pages",
        "left out: emptyeve: nothing to grade",
    ];
    assert_contains(&text, &expected);
    let inner = unzip(&files[1].1);
    assert_eq!(names(&inner), ["Jane_Doe_feedback.html"]);
    let page = String::from_utf8(inner[0].1.clone()).unwrap();
    assert!(page.contains("Jane Doe") && page.ends_with("</html>"));
    // The name in the gradebook is also in the table and on the class's page.
    assert_contains(&class.read("grades.csv"), &["doejane_7001,Jane Doe,"]);
    assert_contains(&class.read("class.html"), &["Jane Doe"]);
}

/// Canvas finds the student by the attachment in the page's name, and Eve has none.
#[test]
fn on_canvas_a_page_about_corrected_text_is_sent_separately() {
    let class = TestClass::named("submissions")
        .with("doejane_7001_9001_hw.zip", solution())
        .with("emptyeve_7005_text.html", "text");
    let corrected = class.path_beside("corrected");
    std::fs::create_dir(&corrected).unwrap();
    std::fs::write(corrected.join("emptyeve_7005.zip"), solution()).unwrap();
    let exam = class.small_exam(&ITEMS);
    let arguments = ["--hand-back", "--corrected", corrected.to_str().unwrap()];
    let text = class.graded_with(&exam, &[], &arguments);
    let expected = [
        "to hand back: 1 page",
        "left out: emptyeve: Canvas can only show a page next to a file",
    ];
    assert_contains(&text, &expected);
    let archive = std::fs::read(class.out().join("hand-back.zip")).unwrap();
    assert_eq!(names(&unzip(&archive)), ["doejane_7001_9001_hw.zip"]);
    let page = class.read("hand-back/emptyeve_feedback.html");
    assert!(page.ends_with("</html>"));
}

/// Canvas shows the same page to Ann and Bob, so it can't contain Bob's points.
#[test]
fn members_of_a_canvas_group_with_different_points_get_pages_of_their_own() {
    let class = TestClass::named("submissions")
        .with("owls_7001_9001_hw.zip", solution())
        .with("foxcid_7003_9002_hw.zip", solution());
    let gradebook = "Student,ID,SIS Login ID,Section,Path (7)\n\"Lee, Ann\",7001,ann,A,\n\
                     \"Kim, Bob\",7002,bob,A,\n\"Fox, Cid\",7003,cid,A,\n";
    let roster = "name,username,group\nAnn Lee,ann,Owls\nBob Kim,bob,Owls\nCid Fox,cid,\n";
    let manual = "student,task,delta,comment,author\nbob,camera,-1,late,Tess\n";
    let lists = [
        ("canvas", gradebook),
        ("roster", roster),
        ("manual-points", manual),
    ];
    let (files, text) = hand_back(&class, &lists);
    assert_eq!(
        names(&files),
        ["foxcid_7003_9002_hw.zip", "owls_7001_9001_hw.zip"]
    );
    let warning = "left out: Ann Lee + Bob Kim: Canvas shows all members of a group the same page";
    assert_contains(&text, &[warning]);
    let pages = || {
        let files = files_below(&class.out().join("hand-back")).into_iter();
        let page = |path: std::path::PathBuf| {
            let text = std::fs::read_to_string(&path).unwrap();
            let name = path.file_name().unwrap().display().to_string();
            (name, text.contains("by Tess: late"))
        };
        files.map(page).collect::<Vec<_>>()
    };
    let own = [
        ("Ann_Lee_feedback.html", false),
        ("Bob_Kim_feedback.html", true),
    ];
    assert_eq!(pages(), own.map(|(name, has)| (name.to_owned(), has)));
    let exam = class.small_exam(&ITEMS);
    class.graded(&exam, &["--drop-list", "manual-points"]);
    assert_eq!(pages(), []);
}

/// Moodle splits the name at its first four underscores. The second part is the participant's
/// number.
#[test]
fn moodle_gets_each_page_as_a_feedback_file_of_the_participant() {
    let class = TestClass::named("CG-Path tracing-77")
        .with_reference("José Núñez_301_assignsubmission_file_")
        .with("An_n Lee_302_assignsubmission_file_/hw.zip", solution());
    // Without a list, the number could be a group's, and the wrong person would get the page.
    let (files, text) = hand_back(&class, &[]);
    assert_eq!(names(&files), [""; 0]);
    assert_contains(&text, &["pass Moodle's worksheet with --moodle"]);
    let worksheet = "Identifier,Full name,Grade\nParticipant 301,José Núñez,\n\
                     Participant 302,An_n Lee,\n";
    let (files, _) = hand_back(&class, &[("moodle", worksheet)]);
    let expected = [
        "An n Lee_302_assignfeedback_file_feedback.html",
        "José Núñez_301_assignfeedback_file_feedback.html",
    ];
    assert_eq!(names(&files), expected);
    for (name, _) in &files {
        let parts: Vec<&str> = name.splitn(5, '_').collect();
        assert!(parts[1].parse::<u32>().is_ok(), "{name}");
        assert_eq!(parts[2..], ["assignfeedback", "file", "feedback.html"]);
    }
}

#[test]
fn elsewhere_each_person_gets_a_page_with_a_safe_name() {
    let folders = ["a", "b", "c", "d", "e", "f"].into_iter();
    let class = folders.fold(TestClass::named("class"), TestClass::with_reference);
    let roster = "name,username,group,datetime\n../../Ann,a,,\nCON,b,,\n-rf,c,,\n\
                  Zoë Lee,d,One,2026-11-20 12:00Z\nBea Berg,bea,One,\nZOË LEE,e,,\nLate,f,,yesterday\n";
    let lists = [
        ("roster", roster),
        ("policy", "[late]\ndue = 2026-11-20T23:59:59Z\n"),
        (
            "manual-points",
            "student,task,delta,comment,author\nBea Berg,camera,-1,late,Tess\n",
        ),
    ];
    let (files, text) = hand_back(&class, &lists);
    let expected = [
        "_.._Ann_feedback.html",
        "_CON_feedback.html",
        "_-rf_feedback.html",
        "Zoë_Lee_d_feedback.html",
        "Bea_Berg_feedback.html",
        "ZOË_LEE_e_feedback.html",
    ];
    assert_eq!(names(&files), expected);
    assert!(text.contains("left out: Late: time unclear"), "{text}");
    // Members of a group must not see each other's comments.
    let page = |index: usize| String::from_utf8(files[index].1.clone()).unwrap();
    assert!(page(4).contains("by Tess: late") && !page(3).contains("Tess"));
}

#[test]
fn namesakes_in_brightspace_are_told_apart_by_their_numbers() {
    let class = TestClass::named("class")
        .with_reference("104-17 - Ann Lee - Nov 20, 2026 1134 PM")
        .with_reference("108-17 - Ann Lee - Nov 20, 2026 1135 PM")
        .with_reference("109-17 - Bob Kim - Nov 20, 2026 1136 PM");
    let (files, _) = hand_back(&class, &[]);
    let expected = [
        "Ann_Lee_104_feedback.html",
        "Ann_Lee_108_feedback.html",
        "Bob_Kim_feedback.html",
    ];
    assert_eq!(names(&files), expected);
}
