//! Submissions are assigned to people by names and lists, never by a number or by something a
//! student wrote.

use crate::harness::{TestClass, assert_contains, unzip};

const ITEMS: [&str; 1] = ["camera.offset"];

/// In Moodle, a team's folder ends in the group's number, which here equals the number of Ann, who
/// is in the other team.
#[test]
fn a_moodle_team_gets_points_by_its_name_and_never_by_its_number() {
    let class = TestClass::named("moodle")
        .with_reference("Team A_51_assignsubmission_file")
        .with_starter("Team B_52_assignsubmission_file");
    let exam = class.small_exam(&ITEMS);
    let worksheet = |group: &str| {
        format!(
            "Identifier,Full name,{group},Grade,Maximum Grade\nParticipant 51,Ann Lee,Team B,,100\n\
             Participant 77,Bob Ray,Team A,,100\nParticipant 78,Cid Fox,Team B,,100\n"
        )
    };
    let grade = |worksheet: &str, more: &[&str]| {
        let worksheet = class.write_beside("worksheet.csv", worksheet);
        let lists = ["--moodle", &worksheet, "--hand-back"];
        let text = class.graded(&exam, &[&lists, more].concat());
        let archive = std::fs::read(class.out().join("hand-back.zip")).unwrap();
        let pages = unzip(&archive).into_iter().map(|(name, _)| name);
        (class.read("moodle.csv"), pages.collect::<Vec<_>>(), text)
    };
    let (moodle, pages, _) = grade(&worksheet("Group"), &[]);
    let rows = [
        "51,Ann Lee,Team B,0,",
        "77,Bob Ray,Team A,2,",
        "78,Cid Fox,Team B,0,",
    ];
    assert_contains(&moodle, &rows);
    let page = |person: &str| format!("{person}_assignfeedback_file_feedback.html");
    assert_eq!(pages, ["Bob Ray_77", "Ann Lee_51", "Cid Fox_78"].map(page));

    // Nothing says who is in the teams.
    let unknown = worksheet("Other");
    let path = class.write_beside("worksheet.csv", &unknown);
    let error = class.refused(&exam, &["--moodle", &path]);
    assert_contains(&error, &["2 of 2 submissions match nobody"]);
    let (moodle, pages, text) = grade(&unknown, &["--accept-unlisted"]);
    assert!(moodle.contains("51,Ann Lee,Team B,,"), "{moodle}");
    assert_eq!(pages, [""; 0]);
    assert_contains(&text, &["the number 51 is that of Ann Lee in a list"]);
}

#[test]
fn a_canvas_name_that_can_be_read_in_two_ways_needs_a_gradebook() {
    let class = TestClass::named("submissions")
        .with("red_2_7001_9001_camera.rs", "text")
        .with("leeann_7002_9002_2026_11_bvh.rs", "text")
        .with("kimbob_7003_9003_bvh.rs", "text");
    let preview = class.preview();
    let expected = [
        "the user number 2 of red or 7001 of red_2",
        "7002 of leeann or 9002 of leeann_7002",
        "1 of 3 can be graded",
    ];
    assert_contains(&preview, &expected);
    let gradebook = class.write_beside(
        "gradebook.csv",
        "Student,ID,SIS Login ID,Section,Path (7)\nRed_2,7001,red,A,\n\"Lee, Ann\",7002,ann,A,\n\
         \"Kim, Eve\",7003,eve,A,\n",
    );
    let preview = class.preview_of(&class.input(), &["--canvas", &gradebook]);
    let who = [
        "  Red_2: 1 of 5 files",
        "  Lee, Ann: ",
        "the number 7003 is that of Kim, Eve",
    ];
    assert_contains(&preview, &who);
}

/// Mallory's own metadata and folders say that Bob handed something in.
#[test]
fn what_is_in_the_only_submission_does_not_describe_the_class() {
    let metadata = "---\nbob:\n  :submitters:\n  - :name: Bob\n  :created_at: 2020-01-01\n";
    for inside in ["", "x/"] {
        let class = TestClass::named("class")
            .with(
                &format!("mallory/{inside}submission_metadata.yml"),
                metadata,
            )
            .with(&format!("mallory/{inside}result.json"), "{}")
            .with_starter(&format!("mallory/{inside}bob/a/b"))
            .with_reference(&format!(
                "mallory/{inside}Bob_51_assignsubmission_file_/a/b"
            ));
        let error = class.refused_preview();
        assert_contains(&error, &["the folder mallory has several submissions"]);
        let roster = class.write_beside("roster.csv", "name\nMallory\nBob\n");
        let preview = class.preview_of(&class.input(), &["--roster", &roster]);
        let expected = [
            "1 submission in folders and archives",
            "  Mallory: all 5 files",
            "there is only the folder mallory",
        ];
        assert_contains(&preview, &expected);
    }
}

#[test]
fn folders_of_tutorials_and_flat_folders_of_several_people_are_refused() {
    let class = TestClass::named("tutorials")
        .with_minimal_submission("mon/ann")
        .with("mon/bob/student/src/bvh.rs", "text")
        .with_minimal_submission("tue/eve")
        .with_minimal_submission("tue/kim");
    let error = class.refused_preview();
    let expected = ["the folder mon has several submissions (ann, bob)"];
    assert_contains(&error, &expected);
    for folder in ["", "Path Tracer/"] {
        for number in ["(1)", " (1)"] {
            let class = TestClass::named("download")
                .with(&format!("{folder}camera.rs"), "a")
                .with(&format!("{folder}camera{number}.rs"), "b")
                .with(&format!("{folder}bvh.rs"), "a")
                .with(&format!("{folder}bvh{number}.rs"), "b");
            let error = class.refused_preview();
            assert_contains(&error, &["has several versions of 2 task files"]);
        }
    }
}

/// Each shard would have too few entries to tell.
#[test]
fn a_class_of_which_most_are_on_no_list_needs_a_confirmation() {
    let class = TestClass::named("class")
        .with_reference("ann")
        .with_reference("bob")
        .with_reference("eve");
    let exam = class.small_exam(&ITEMS);
    let roster = class.write_beside("roster.csv", "username\nann\nkim\n");
    let lists = ["--roster", &roster];
    let preview = class.preview_of(&class.input(), &lists);
    assert_contains(&preview, &["this class would not be graded"]);
    for shard in ["1/3", "2/3"] {
        let error = class.refused(&exam, &[&lists[..], &["--shard", shard]].concat());
        assert!(error.contains("2 of 3 submissions match nobody"), "{error}");
        assert!(!class.out().exists());
    }
    let confirmed = [&lists[..], &["--shard", "1/3", "--accept-unlisted"]].concat();
    class.graded(&exam, &confirmed);
}
