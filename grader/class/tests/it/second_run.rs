//! A second run into the same folder uses the first run's lists and reports every final grade that
//! it changes. The commands in a report name the files that were graded.

use std::fs;

use crate::harness::{
    TestClass, assert_contains, cell, refusal, source, successful_stdout, unzip, zip,
};

const ITEMS: [&str; 2] = ["camera.offset", "sphere.radius"];
const POLICY: &str =
    "[points]\nout_of = 100\n[late]\ndue = 2026-11-20T12:00:00Z\npercent_per_day = 10\n";
/// The roster says how late the submission is, that a one-day extension applies, and that somebody
/// handed in nothing.
const ROSTER: &str = "name,username,extension,datetime\n\
    Ann Lee,ann,1,2026-11-22T11:00:00Z\nZoe Z,zoe,,\n";
const MANUAL: &str = "student,task,delta,comment,author\nann,camera,-1,copied,Tess\n";

struct GradedTwice {
    class: TestClass,
    exam: String,
}

impl GradedTwice {
    /// Grades a class with a policy, a roster and manual points. Deletes every list afterwards.
    fn new() -> Self {
        let class = TestClass::named("class")
            .with_reference("ann")
            .with_folder("bob");
        let exam = class.small_exam(&ITEMS);
        let graded = GradedTwice { class, exam };
        let lists = [
            ("policy", POLICY),
            ("roster", ROSTER),
            ("manual-points", MANUAL),
        ];
        graded.class.graded_with(&graded.exam, &lists, &[]);
        for (list, _) in lists {
            fs::remove_file(graded.class.path_beside(&format!("{list}.list"))).unwrap();
        }
        graded
    }

    /// Returns the standard output and the standard error of a run.
    fn run(&self, more: &[&str]) -> [String; 2] {
        let output = self.class.grade(&self.exam, more);
        let text = successful_stdout(&output);
        [text, String::from_utf8(output.stderr).unwrap()]
    }
}

#[test]
fn a_list_that_is_left_out_counts_as_before_until_it_is_dropped() {
    let graded = GradedTwice::new();
    let first = graded.class.read("grades.csv");
    assert!(first.contains("Zoe Z"), "{first}");
    let canvas = graded.class.write_beside(
        "canvas-export.csv",
        "Student,ID,SIS Login ID,Section,Path (7)\n\"Lee, Ann\",7001,ann,A,\n",
    );
    let [_, error] = graded.run(&["--canvas", &canvas]);
    assert_eq!(graded.class.read("grades.csv").replace(",7001", ""), first);
    for text in ["the policy", "the roster", "the table of manual points"] {
        let text = format!("using {text} from the last run");
        assert!(error.contains(&text), "{text}: {error}");
    }
    let preview = graded
        .class
        .previewed(&["--out", graded.class.out().to_str().unwrap()]);
    assert!(preview.contains("Zoe Z"), "{preview}");

    let dropped = ["manual-points", "roster", "canvas"];
    let dropped = dropped.map(|list| ["--drop-list", list]).concat();
    let [text, _] = graded.run(&dropped);
    let changed = "1 final grade changed (changed: the roster, the table of manual points, the \
                   Canvas gradebook)";
    assert!(text.contains(changed), "{text}");
    // A repeated run reports the same change and doesn't need `--drop-list`.
    let [again, error] = graded.run(&[]);
    assert!(again.contains(changed), "{again}");
    assert!(!error.contains("manual points"), "{error}");
    assert!(!graded.class.read("grades.csv").contains("Tess"));
    assert!(!graded.class.out().join("canvas.csv").exists());
}

#[test]
fn a_copy_that_was_changed_is_not_used() {
    let graded = GradedTwice::new();
    let lists = fs::read_dir(graded.class.out().join("lists")).unwrap();
    let paths = lists.map(|entry| entry.unwrap().path());
    let is_roster = |path: &std::path::PathBuf| path.to_str().unwrap().contains("/roster-");
    let roster = paths.into_iter().find(is_roster).unwrap();
    fs::write(&roster, "username\nann\n").unwrap();
    let error = graded.class.refused(&graded.exam, &[]);
    let advice = "pass it again with --roster, or stop using it with --drop-list roster";
    assert!(error.contains(advice), "{error}");
    graded.run(&["--drop-list", "roster"]);
}

/// Returns the list of final grades that changed, which is also in `class.html`.
fn grade_changes(class: &TestClass, text: &str) -> String {
    let lines = text.lines();
    let lines = lines.skip_while(|line| !line.contains("final grade"));
    let lines = lines.take_while(|line| !line.is_empty()).map(str::trim);
    let lines: Vec<&str> = lines.collect();
    let page = class.read("class.html").replace("&quot;", "\"");
    for line in &lines[1.min(lines.len())..] {
        assert!(page.contains(line), "{line}: {page}");
    }
    lines.join("\n")
}

#[test]
fn every_final_grade_that_changes_is_listed_with_its_cause_and_no_other() {
    let graded = GradedTwice::new();
    let changes = |more: &[&str]| {
        let [text, _] = graded.run(more);
        grade_changes(&graded.class, &text)
    };
    let write = |name: &str, text: &str| graded.class.write_beside(name, text);
    let all = [
        changes(&[
            "--manual-points",
            &write("m.csv", &MANUAL.replace("-1", "-2")),
        ]),
        changes(&["--roster", &write("r.csv", &ROSTER.replace(",1,", ",2,"))]),
        changes(&["--roster", &write("r.csv", &ROSTER.replace(",1,", ",3,"))]),
        changes(&["--policy", &write("p.toml", "[points]\nout_of = 10\n")]),
        changes(&["--policy", &write("p.toml", "[points]\nout_of = 20\n")]),
        changes(&["--regrade"]),
    ];
    insta::assert_snapshot!(all.join("\n").trim_end(), @r"
    1 final grade changed (changed: the table of manual points)
    ann (Ann Lee): 60 → 30: manual points -1 → -2
    1 final grade changed (changed: the roster)
    ann (Ann Lee): 30 → 33: days late 1 → 0
    no final grade changed (changed: the roster)
    1 final grade changed (changed: the policy)
    ann (Ann Lee): 33 of 100 → 3 of 10: `out_of` in the policy
    1 final grade changed (changed: the policy)
    ann (Ann Lee): 3 of 10 → 7 of 20: `out_of` in the policy
    ");
}

/// Adds an attempt to a Blackboard export, given the account, the day and an archive. If the
/// archive is empty, adds only the receipt.
fn with_attempt(class: TestClass, attempt: &(&str, u32, &[u8])) -> TestClass {
    let (login, day, archive) = attempt;
    let file = format!("gradebook_CG26_Path_{login}_attempt_2026-11-{day}-10-00-00");
    let receipt = format!(
        "\u{feff}Name: {login} ({login})\r\nAssignment: Path tracer\r\n\
         Date Submitted: Friday, 20 November 2026 10:00:00 o'clock CET\r\n\
         Current Mark: Needs Marking\r\n\r\nSubmission Field:\r\n\
         There is no student submission text data for this assignment.\r\n"
    );
    let class = class.with(&format!("{file}.txt"), receipt);
    if archive.is_empty() {
        class
    } else {
        class.with(&format!("{file}_hw.zip"), archive)
    }
}

/// Returns an archive with the reference's camera and the sphere from this folder.
fn archive_with(sphere: &str) -> Vec<u8> {
    let files = [
        ("camera.rs", source("reference/src/camera.rs")),
        ("sphere.rs", source(&format!("{sphere}/sphere.rs"))),
    ];
    zip(files)
}

/// In the first export, Eva's only attempt is empty and Bob's latest one is a damaged archive. In
/// the second export, everybody has a new attempt. In the third, Ann's latest one is damaged.
#[test]
fn a_grade_is_listed_if_an_earlier_or_later_attempt_has_none() {
    let [solution, partial] = ["reference/src", "grader/starter"].map(archive_with);
    let damaged = &solution[..solution.len() / 2];
    let first: [(&str, u32, &[u8]); 4] = [
        ("ann", 18, &solution),
        ("bob", 18, &partial),
        ("bob", 19, damaged),
        ("eva", 18, &[]),
    ];
    let second: [(&str, u32, &[u8]); 3] = [
        ("ann", 20, &partial),
        ("bob", 20, &solution),
        ("eva", 20, &solution),
    ];
    let third = ("ann", 21, damaged);
    let mut all = Vec::new();
    for rule in ["latest", "best"] {
        let mut class = first.iter().fold(TestClass::named("export"), with_attempt);
        let exam = class.small_exam(&ITEMS);
        let policy = format!("[attempts]\ncounts = '{rule}'\n[late]\ntimezone = 'UTC'\n");
        class.graded_with(&exam, &[("policy", &policy)], &[]);
        class = second.iter().fold(class, with_attempt);
        let grade = |class: &TestClass| grade_changes(class, &class.graded(&exam, &[]));
        all.extend([rule.to_owned(), grade(&class)]);
        if rule == "best" {
            break;
        }
        class = with_attempt(class, &third);
        all.push(grade(&class));
        for file in fs::read_dir(class.input()).unwrap() {
            let path = file.unwrap().path();
            if path.to_str().unwrap().contains("_ann_attempt_2026-11-21") {
                fs::remove_file(path).unwrap();
            }
        }
        all.push(grade(&class));
        let best = policy.replace("latest", "best");
        let text = class.graded_with(&exam, &[("policy", &best)], &[]);
        all.push(grade_changes(&class, &text));
    }
    insta::assert_snapshot!(all.join("\n"), @r"
    latest
    3 final grades changed
    ann_2026-11-20-10-00-00 (ann): 3 → 2: this attempt counts instead of ann_2026-11-18-10-00-00, graded 3 → 2
    bob_2026-11-20-10-00-00 (bob): no points (nothing to grade) → 3: this attempt counts instead of bob_2026-11-19-10-00-00
    eva_2026-11-20-10-00-00 (eva): no points (nothing to grade) → 3: this attempt counts instead of eva_2026-11-18-10-00-00
    1 final grade changed
    ann_2026-11-21-10-00-00 (ann): 2 → no points (nothing to grade): this attempt replaces ann_2026-11-20-10-00-00
    1 final grade changed
    ann_2026-11-20-10-00-00 (ann): no points (nothing to grade) → 2: this attempt counts instead of ann_2026-11-21-10-00-00
    1 final grade changed (changed: the policy)
    ann_2026-11-18-10-00-00 (ann): 2 → 3: this attempt counts instead of ann_2026-11-20-10-00-00, graded 2 → 3, `counts` in the policy
    best
    2 final grades changed
    bob_2026-11-20-10-00-00 (bob): 2 → 3: this attempt counts instead of bob_2026-11-18-10-00-00, graded 2 → 3
    eva_2026-11-20-10-00-00 (eva): no points (nothing to grade) → 3: this attempt counts instead of eva_2026-11-18-10-00-00
    ");
}

/// In Moodle, Ann's files are first a draft, and Bob replaces his archive by a damaged one. Then
/// the policy and the manual points change together.
#[test]
fn each_change_of_a_grade_names_the_causes_that_apply_to_this_person() {
    let folder = |name: &str, number: u32| format!("{name}_{number}_assignsubmission_file_/hw.zip");
    let [solution, partial] = ["reference/src", "grader/starter"].map(archive_with);
    let class = TestClass::named("CG-Path tracing-77")
        .with(&folder("Ann Lee", 301), &solution)
        .with(&folder("Bob Kim", 302), &partial)
        .with(&folder("Eva Roth", 303), &solution);
    let exam = class.small_exam(&ITEMS);
    let worksheet = |ann: &str, bob: &str| {
        let row = |number: u32, name: &str, status: &str, grade: &str, day: u32| {
            let time = format!("{day} November 2026, 10:00 AM");
            format!("Participant {number},{name},{status},{grade},3.00,Yes,\"{time}\"\n")
        };
        let header = "Identifier,Full name,Status,Grade,Maximum Grade,Grade can be changed,\
                      Last modified (submission)\n";
        let submitted = "Submitted for grading";
        [
            header.to_owned(),
            row(301, "Ann Lee", ann, "", 19),
            row(302, "Bob Kim", submitted, bob, 19),
            row(303, "Eva Roth", submitted, "", 21),
        ]
        .concat()
    };
    let policy = |percent: u32| {
        format!(
            "[late]\ndue = 2026-11-20T12:00:00Z\ntimezone = 'UTC'\npercent_per_day = {percent}\n"
        )
    };
    let draft = worksheet("Draft (not submitted)", "");
    let lists = [("policy", &*policy(0)), ("moodle", &*draft)];
    class.graded_with(&exam, &lists, &[]);
    let mut all = Vec::new();
    let class = class.with(&folder("Bob Kim", 302), &partial[..partial.len() / 2]);
    let lists = [("moodle", &*worksheet("Submitted for grading", "2.00"))];
    let text = class.graded_with(&exam, &lists, &[]);
    all.push(grade_changes(&class, &text));
    let kept = "Bob Kim: nothing to grade; left unchanged, so the gradebook still shows 2.00";
    assert_contains(&text, &[kept]);

    let manual = "student,task,delta,comment,author\nBob Kim,camera,1,on paper,Tess\n\
                  Ann Lee,camera,-1,copied,Tess\n";
    let lists = [("policy", &*policy(50)), ("manual-points", manual)];
    let text = class.graded_with(&exam, &lists, &[]);
    all.push(grade_changes(&class, &text));
    let class = class.with(&folder("Bob Kim", 302), &partial);
    all.push(grade_changes(
        &class,
        &class.graded(&exam, &["--drop-list", "manual-points"]),
    ));
    insta::assert_snapshot!(all.join("\n"), @r"
    2 final grades changed (changed: the Moodle worksheet)
    Ann_Lee_301 (Ann Lee): no points (draft) → 3: the Moodle worksheet
    Bob_Kim_302 (Bob Kim): 2 → no points (nothing to grade): previously graded 2
    3 final grades changed (changed: the policy, the table of manual points)
    Ann_Lee_301 (Ann Lee): 3 → 2: manual points +0 → -1
    Bob_Kim_302 (Bob Kim): no points (nothing to grade) → 1: manual points +0 → +1
    Eva_Roth_303 (Eva Roth): 3 → 2: `percent_per_day` in the policy
    2 final grades changed (changed: the table of manual points)
    Ann_Lee_301 (Ann Lee): 2 → 3: manual points -1 → +0
    Bob_Kim_302 (Bob Kim): 1 → 2: now graded 2, manual points +1 → +0
    ");
}

#[test]
fn points_by_hand_count_without_anything_that_can_be_graded() {
    let graded = GradedTwice::new();
    let grade = |delta: &str| {
        let text = format!("{MANUAL}bob,camera,{delta},drawn on paper,Tess\n");
        let path = graded.class.write_beside("manual.csv", &text);
        graded
            .class
            .grade(&graded.exam, &["--manual-points", &path, "--hand-back"])
    };
    let text = successful_stdout(&grade("1"));
    assert!(text.contains("left out: bob: points by hand: "), "{text}");
    let bob = |column| cell(&graded.class, "bob", "bob", column);
    assert_eq!(bob("status"), "points by hand");
    assert!(bob("counts").parse::<u32>().unwrap() > 0);
    assert!(graded.class.read("class.html").contains("drawn on paper"));
    let error = refusal(&grade("99"));
    assert_contains(&error, &["+99 points is out of range", "earned 0 of"]);
}

/// In a Canvas export, a student's files aren't in a folder of their own, and the export itself may
/// be an archive.
#[test]
fn the_commands_in_a_report_name_an_archive_of_the_files_that_were_graded() {
    let class = TestClass::named("export");
    let text = source("grader/starter/sphere.rs");
    let class = class.with("leeann_7001_90001_sphere.rs", &text);
    let exam = class.small_exam(&ITEMS);
    let out = class.path_beside("my results");
    let mut command = class.command_into(&out, &exam, &["--hand-back"]);
    successful_stdout(&command.output().unwrap());
    let entries = fs::read_dir(out.join("students")).unwrap();
    let student = entries.map(|entry| entry.unwrap().path()).next().unwrap();
    let archive = student.join("submission.zip");
    let report = fs::read_to_string(student.join("report.html")).unwrap();
    let command = format!("cargo grade '{}' --exam", archive.display());
    assert!(report.replace("&#39;", "'").contains(&command), "{report}");
    let packed = unzip(&fs::read(archive).unwrap());
    assert_eq!(packed, [("sphere.rs".to_owned(), text.into_bytes())]);
    // Students don't get to see these commands.
    for file in [student.join("feedback.html"), out.join("hand-back.zip")] {
        let bytes = fs::read(file).unwrap();
        assert!(!String::from_utf8_lossy(&bytes).contains("submission.zip"));
    }
}

#[test]
fn a_chosen_layout_and_title_count_as_before() {
    let version = |title: &str| format!("Ann Lee/{title}/Version 1");
    let class = TestClass::named("Eingereichte Dateien")
        .with_starter(&version("Essay"))
        .with_reference(&version("Path tracer"));
    let exam = class.small_exam(&ITEMS);
    class.graded(&exam, &["--layout", "teams", "--title", "Path tracer"]);
    let first = class.read("grades.csv");
    class.graded(&exam, &[]);
    assert_eq!(class.read("grades.csv"), first);
    class.graded(&exam, &["--title", "Essay"]);
    assert_eq!(cell(&class, "Ann_Lee_1", "Ann Lee", "points"), "0");
}
