//! Submissions are assigned to people by names and lists, never by a number or by something a
//! student wrote.

use grader::handed_out::RAYS;

use crate::harness::{TestClass, all_files, assert_contains, cell, successful_stdout, unzip};

const ITEMS: [&str; 1] = ["camera.offset"];

/// In Moodle, the name of a team's folder contains the group's number. In this test, the number of
/// team A is also the number of Ann, who is in team B.
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
    assert_contains(
        &error,
        &["2 of 2 submissions, such as \"Team A\", don't match anyone"],
    );
    let (moodle, pages, text) = grade(&unknown, &["--accept-unlisted"]);
    assert!(moodle.contains("51,Ann Lee,Team B,,"), "{moodle}");
    assert_eq!(pages, [""; 0]);
    assert_contains(
        &text,
        &["the number 51 was ignored because a list assigns it to Ann Lee"],
    );
}

#[test]
fn a_canvas_name_that_can_be_read_in_two_ways_needs_a_gradebook() {
    let class = TestClass::named("submissions")
        .with("red_2_7001_9001_camera.rs", "text")
        .with("leeann_7002_9002_2026_11_bvh.rs", "text")
        .with("kimbob_7003_9003_bvh.rs", "text");
    let preview = class.preview();
    let expected = [
        "its user number could be 2 (red) or 7001 (red_2)",
        "7002 (leeann) or 9002 (leeann_7002)",
        "1 of 3 can be graded",
    ];
    assert_contains(&preview, &expected);
    let gradebook = "Student,ID,SIS Login ID,Section,Path (7)\nRed_2,7001,red,A,\n\
                     \"Lee, Ann\",7002,ann,A,\n\"Kim, Eve\",7003,eve,A,\n";
    let preview = class.previewed_with(&[("canvas", gradebook)], &[]);
    let who = [
        "  Ann Lee: ",
        &format!("  Red_2: 1 of {} files", RAYS.files.len()),
        "the number 7003 was ignored because a list assigns it to Eve Kim",
    ];
    assert_contains(&preview, &who);
}

/// The metadata and folders in Mallory's submission say that Bob handed something in.
#[test]
fn what_is_in_the_only_submission_does_not_describe_the_class() {
    let metadata = "---\nbob:\n  :submitters:\n  - :name: Bob\n  :created_at: 2020-01-01\n";
    for (inside, why) in [
        ("", "mallory is a Gradescope export, not one submission"),
        ("x/", "the folder mallory contains several submissions"),
    ] {
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
        let error = class.refused_preview(&[]);
        assert_contains(&error, &[why]);
        let preview = class.previewed_with(&[("roster", "name\nMallory\nBob\n")], &[]);
        let expected = [
            "1 submission in folders and archives",
            &all_files("  Mallory"),
            "the only folder is mallory",
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
    let error = class.refused_preview(&[]);
    let expected = ["the folder mon contains several submissions (ann, bob)"];
    assert_contains(&error, &expected);
    for folder in ["", "Path Tracer/"] {
        for number in ["(1)", " (1)"] {
            let class = TestClass::named("download")
                .with(&format!("{folder}camera.rs"), "a")
                .with(&format!("{folder}camera{number}.rs"), "b")
                .with(&format!("{folder}bvh.rs"), "a")
                .with(&format!("{folder}bvh{number}.rs"), "b");
            let error = class.refused_preview(&[]);
            assert_contains(&error, &["contains several versions of 2 task files"]);
        }
    }
}

/// The whole class is checked even if only a shard is graded, since a shard may be too small to
/// check.
#[test]
fn a_class_of_which_most_are_on_no_list_needs_a_confirmation() {
    let class = TestClass::named("class")
        .with_reference("ann")
        .with_reference("bob")
        .with_reference("eve");
    let exam = class.small_exam(&ITEMS);
    let roster = class.write_beside("roster.csv", "username\nann\nkim\n");
    let lists = ["--roster", &roster];
    let preview = class.previewed(&lists);
    assert_contains(&preview, &["this class cannot be graded yet"]);
    for shard in ["1/3", "2/3"] {
        let error = class.refused(&exam, &[&lists[..], &["--shard", shard]].concat());
        assert_contains(
            &error,
            &["2 of 3 submissions, such as \"bob\", don't match anyone"],
        );
        assert!(!class.out().exists());
    }
    let confirmed = [&lists[..], &["--shard", "1/3", "--accept-unlisted"]].concat();
    class.graded(&exam, &confirmed);
}

const WORKSHEET: &str = "Identifier,Full name,Email address,Grade,Maximum Grade\n\
    Participant 400303,Bob O'Hara,bob@x.edu,,100\n\
    Participant 400304,Ann Lee,ann@x.edu,,100\n";

/// Moodle removes characters such as the apostrophe from the names of folders.
#[test]
fn a_name_without_its_punctuation_belongs_to_the_person_on_the_list() {
    let class = TestClass::named("moodle")
        .with_offset_mistake("Bob OHara_400303_assignsubmission_file")
        .with_reference("Ann Lee_400304_assignsubmission_file");
    let exam = class.small_exam(&ITEMS);
    let roster = "name,email\nBob O'Hara,bob@x.edu\nAnn Lee,ann@x.edu\n";
    let points = "student,task,delta,comment,author\nBob O'Hara,camera,1,idea,Tess\n";
    for (list, text, more) in [
        ("roster", roster, &[][..]),
        ("moodle", WORKSHEET, &["--drop-list", "roster"]),
    ] {
        class.graded_with(&exam, &[(list, text), ("manual-points", points)], more);
        let bob = |column: &str| cell(&class, "Bob_OHara_400303", "Bob O'Hara", column);
        assert_eq!([bob("email"), bob("status")], ["bob@x.edu", "graded"]);
        for who in ["Bob O'Hara", "Bob OHara"] {
            let arguments = [who, "camera.offset", "--exam", &exam];
            let text = successful_stdout(&class.replay(&class.out(), &arguments));
            assert_contains(&text, &["Bob_OHara_400303 (Bob O'Hara)"]);
        }
    }
    let corrected = class.path_beside("corrected");
    let folder = corrected.join("Bob O'Hara/student/src");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("camera.rs"), "text").unwrap();
    let corrected = ["--corrected", corrected.to_str().unwrap()];
    let preview = class.previewed_with(&[("roster", roster)], &corrected);
    assert_contains(&preview, &["file (corrected: Bob O'Hara)"]);
}

#[test]
fn people_whose_names_differ_only_in_punctuation_are_not_guessed() {
    let class = TestClass::named("moodle").with_reference("Bob OHara_9_assignsubmission_file");
    let roster = "name,email\nBob O'Hara,bob@x.edu\nBob Ohara,bo@x.edu\n";
    let preview = class.previewed_with(&[("roster", roster)], &[]);
    let expected = [
        "several people on the lists are named Bob OHara",
        "so that it contains one of bo@x.edu, bob@x.edu",
    ];
    assert_contains(&preview, &expected);
}

const GROUPS: &str = "name,email,group\nAnn Lee,a@x.edu,Bob's team\nBob Kim,b@x.edu,Lab 1: Team 8\n\
    Cid Fox,c@x.edu,Müller & Co\nEve Ray,e@x.edu,Team_7\nDora Y,d@x.edu,Team_7\n";

#[test]
fn a_team_whose_name_lost_its_punctuation_is_that_of_the_roster() {
    let class = TestClass::named("moodle")
        .with_reference("Bobs team_1_assignsubmission_file")
        .with_reference("Lab 1 Team 8_2_assignsubmission_file")
        .with_reference("Müller  Co_3_assignsubmission_file")
        .with_reference("Team 7_4_assignsubmission_file");
    let preview = |groups: &str| class.previewed_with(&[("roster", groups)], &[]);
    let text = preview(GROUPS);
    let people = ["  Ann Lee", "  Bob Kim", "  Cid Fox", "  Eve Ray + Dora Y"];
    assert_contains(&text, &people.map(all_files));
    let text = preview(&format!("{GROUPS}Zoe Z,z@x.edu,Team 7\n"));
    let expected = [
        "it could belong to any of the groups Team 7, Team_7",
        &all_files("  Team 7"),
    ];
    assert_contains(&text, &expected);
}

/// Canvas names a group's files after the group, but adds the number of one of its members.
#[test]
fn a_canvas_groups_files_belong_to_its_members() {
    let class = TestClass::named("submissions")
        .with("projectgroup1_7014_9001_camera.rs", "text")
        .with("team_8_7016_9002_camera.rs", "text");
    let canvas = "Student,ID,SIS Login ID,Section,Path (7)\n\"Lee, Ann\",7014,ann,A,\n\
                  \"Kim, Bob\",7015,bob,A,\n\"Fox, Cid\",7016,cid,A,\n";
    let roster = "name,username,group\nAnn Lee,ann,Project Group 1\nBob Kim,bob,Project Group 1\n\
                  Cid Fox,cid,Team_8\n";
    let preview = class.previewed_with(&[("canvas", canvas), ("roster", roster)], &[]);
    assert_contains(&preview, &["  Ann Lee + Bob Kim: 1 of", "  Cid Fox: 1 of"]);
    assert!(!preview.contains("was not used"), "{preview}");
    assert!(!preview.contains("without a submission"), "{preview}");
}

#[test]
fn a_namesakes_folder_that_was_renamed_is_confirmed_by_its_number() {
    let class = TestClass::named("moodle")
        .with_reference("u02lee@uni.example_400306_assignsubmission_file")
        .with_reference("Ann Lee_400307_assignsubmission_file");
    let worksheet = "Identifier,Full name,Email address,Grade,Maximum Grade\n\
                     Participant 400306,Ann Lee,u02lee@uni.example,,100\n\
                     Participant 400307,Ann Lee,u03lee@uni.example,,100\n";
    let roster = "name,email\nAnn Lee,u02lee@uni.example\nAnn Lee,u03lee@uni.example\n";
    let lists = [("moodle", worksheet), ("roster", roster)];
    for lists in [&lists[..1], &lists] {
        let preview = class.previewed_with(lists, &[]);
        assert_eq!(preview.matches(&all_files("  Ann Lee")).count(), 2);
        for problem in ["was not used", "without a submission"] {
            assert!(!preview.contains(problem), "{preview}");
        }
    }
    // The number is Ann's, but the address is Bob's.
    let roster = "name,email\nBob,u02lee@uni.example\n";
    let other = "Identifier,Full name,Email address,Grade,Maximum Grade\n\
                 Participant 400306,Ann Lee,u04@uni.example,,100\n";
    let preview = class.previewed_with(&[("moodle", other), ("roster", roster)], &[]);
    assert_contains(
        &preview,
        &["the number 400306 was ignored because a list assigns it to Ann Lee"],
    );
}

#[test]
fn a_roster_may_write_the_family_name_first() {
    let class = TestClass::named("class")
        .with_minimal_submission("Zoë Müller")
        .with_minimal_submission("Jane Doe Jr");
    let text = "name,email\n\"Müller, Zoë\",z@x.edu\n\"Jane Doe, Jr.\",j@x.edu\n";
    let preview = class.previewed_with(&[("roster", text)], &[]);
    let people = ["Zoë Müller", "Jane Doe, Jr."].map(all_files);
    assert_contains(&preview, &people);
    assert!(!preview.contains("without a submission"), "{preview}");
}
