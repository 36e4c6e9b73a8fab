//! Anonymous grading: a copy of the class with pseudonyms instead of names. Only the key file says
//! who each pseudonym stands for.

use std::collections::BTreeMap;
use std::fs;

use crate::harness::{
    TestClass, assert_contains, cell, class_command, files_below, refusal, successful_stdout, table,
};

const ROSTER: &str = "name,username,email,group,datetime\n\
    Annabel Leeward,leeward,leeward@x.edu,,2026-11-20T12:34:56Z\n\
    Bobby Kimono,kimono,kimono@x.edu,Owls,2026-11-22T12:34:56Z\n\
    Carla Owlet,owlet,owlet@x.edu,Owls,\n\
    Zoe Absentia,absentia,,,\n";
const POLICY: &str = "[late]\ndue = 2026-11-21T12:00:00Z\npercent_per_day = 10\n";
/// Everything that must not be in the copy: names, accounts, addresses, groups and times.
const SECRETS: [&str; 9] = [
    "Leeward", "leeward", "Kimono", "kimono", "wlet", "Owls", "x.edu", "bsentia", "12:34",
];

fn graded() -> (TestClass, String) {
    let class = TestClass::named("class")
        .with_reference("leeward")
        .with(
            "leeward/Annabel_Leeward_hw/old/sphere_final.rs",
            "fn hit() {}",
        )
        .with("leeward/leeward_notes.rs", "text")
        .with_offset_mistake("kimono")
        .with("peeta/bvh_of_peeta.txt", "nothing to grade");
    let exam = class.small_exam(&["camera.offset", "sphere.radius"]);
    let blind = class.path_beside("blind").display().to_string();
    let lists = [("roster", ROSTER), ("policy", POLICY)];
    class.graded_with(&exam, &lists, &["--anonymous", &blind]);
    (class, exam)
}

fn key(class: &TestClass) -> BTreeMap<String, String> {
    serde_json::from_str(&class.read("anonymous-key.json")).unwrap()
}

#[test]
fn nothing_in_the_copy_names_anybody_and_pseudonyms_stay() {
    let (class, exam) = graded();
    let blind = class.path_beside("blind");
    for path in files_below(&blind) {
        let relative = path.strip_prefix(&blind).unwrap().display().to_string();
        let text = String::from_utf8_lossy(&fs::read(&path).unwrap()).into_owned();
        for secret in SECRETS.iter().chain(&["peeta"]) {
            assert!(!relative.contains(secret), "{relative}");
            assert!(
                !text.contains(secret),
                "{secret:?} is in {relative}: {text}"
            );
        }
    }
    let key = key(&class);
    let ids: Vec<&str> = key.keys().map(String::as_str).collect();
    assert_eq!(ids, ["kimono", "leeward"]);
    let page = class.read("students/leeward/feedback.html");
    assert_contains(&page, &["old/sphere_final.rs", "leeward_notes.rs"]);
    // Graders can read the pages and run a question again.
    let bob = &key["kimono"];
    let page = fs::read_to_string(blind.join(format!("students/{bob}/report.html"))).unwrap();
    assert_contains(
        &page,
        &[&format!("<h1><span class=\"untrusted\">{bob}</span></h1>")],
    );
    let replayed = class.replay(&blind, &[bob, "camera.offset", "--exam", &exam]);
    let replayed = successful_stdout(&replayed);
    assert_contains(&replayed, &["verdict  wrong: direction"]);
    let mut grades = fs::read_to_string(blind.join("grades.csv")).unwrap();
    for (id, pseudonym) in &key {
        grades = grades.replace(pseudonym, &format!("PSEUDONYM-OF-{id}"));
    }
    let mut lines: Vec<&str> = grades.lines().skip(1).collect();
    lines.sort_unstable();
    insta::assert_snapshot!(lines.join("\n"));

    let pages = |class: &TestClass| class.read("grades.csv");
    let before = (fs::read(blind.join("grades.csv")).unwrap(), pages(&class));
    let again = class.path_beside("again");
    class.graded(&exam, &["--anonymous", again.to_str().unwrap()]);
    let after = (fs::read(again.join("grades.csv")).unwrap(), pages(&class));
    assert_eq!(after, before);
    // A different class with the same names gets different pseudonyms.
    let (other, _) = graded();
    assert!(self::key(&other)["kimono"] != *bob);
}

#[test]
fn points_by_hand_can_name_a_pseudonym() {
    let (class, exam) = graded();
    let key = key(&class);
    let rows = format!(
        "student,task,delta,comment,author\n{},camera,1,nearly,Tess\n",
        key["kimono"]
    );
    class.graded_with(&exam, &[("manual-points", &rows)], &[]);
    for name in ["Bobby Kimono", "Carla Owlet"] {
        assert_eq!(
            cell(&class, "kimono", name, "manual"),
            "1",
            "the whole group"
        );
    }
    assert_eq!(table(&class.read("grades.csv")).len(), 5);
    // As in the graders' table.
    let one = rows.replace(&key["kimono"], &format!("\"{}, member 2\"", key["kimono"]));
    class.graded_with(&exam, &[("manual-points", &one)], &[]);
    let manual = |name: &str| cell(&class, "kimono", name, "manual");
    assert_eq!(["Bobby Kimono", "Carla Owlet"].map(manual), ["", "1"]);
    let refused = |folder: &str| {
        let folder = class.path_beside(folder).display().to_string();
        let error = class.refused(&exam, &["--anonymous", &folder]);
        let (_, error) = error.rsplit_once("error: ").unwrap();
        let error = error.replace(&folder, "FOLDER");
        error.replace(&class.out().display().to_string(), "OUT")
    };
    insta::assert_snapshot!([refused("out/blind"), refused("class"), refused("blind")].concat(), @r"
    FOLDER and OUT must not contain each other, or names would leak: choose a different folder for --anonymous
    FOLDER is not empty: choose a new folder for --anonymous
    FOLDER is not empty: choose a new folder for --anonymous
    ");
}

/// The merged class has a key, but the shards don't. The merged class's policy is checked without
/// the exam.
#[test]
fn a_merged_class_has_pseudonyms_and_a_policy_that_fits_the_exam() {
    let class = TestClass::named("class")
        .with_starter("leeward")
        .with_starter("kimono");
    let exam = class.small_exam(&["camera.offset", "sphere.radius"]);
    class.graded(&exam, &["--shard", "1/1"]);
    let merged = class.path_beside("merged");
    let merge = |blind: &str, policy: &str| {
        let policy = class.write_beside("policy.toml", policy);
        let mut command = class_command();
        command
            .arg("merge")
            .arg(class.out())
            .arg("--out")
            .arg(&merged);
        command.arg("--anonymous").arg(class.path_beside(blind));
        command.args(["--policy", &policy]).output().unwrap()
    };
    let rows = |folder: &str| {
        let grades = class.path_beside(folder).join("grades.csv");
        let rows = table(&fs::read_to_string(grades).unwrap()).into_iter();
        rows.map(|row| (row["submission"].clone(), row["counts"].clone()))
            .collect::<Vec<_>>()
    };
    successful_stdout(&merge("blind", ""));
    let first = rows("blind");
    assert!(
        first
            .iter()
            .all(|(who, points)| who.starts_with("anon-") && points == "0")
    );
    successful_stdout(&merge(
        "again",
        "[points]\nvoid = ['camera.offset']\nvoid_points = 'give'",
    ));
    let given = first.into_iter().map(|(who, _)| (who, "2".to_owned()));
    assert_eq!(rows("again"), given.collect::<Vec<_>>());
    let error = refusal(&merge("third", "[points]\nvoid = ['camera.ofset']"));
    let unknown = "line 2: the exam has no item `camera.ofset` (did you mean camera.offset?)";
    assert_contains(&error, &[unknown]);
}

/// Ann's second attempt counts, and Bob's attempts have no times. The test student isn't graded by
/// anybody.
#[test]
fn only_attempts_that_may_count_are_in_the_copy() {
    let class = TestClass::named("class")
        .with_offset_mistake("ann1")
        .with_reference("ann2")
        .with_starter("bob1")
        .with_reference("bob2")
        .with_reference("Test Student");
    let exam = class.small_exam(&["camera.offset"]);
    let roster = "name,username,sid,datetime\n\
        Ann Lee,ann1,a,2026-11-20T10:00:00Z\nAnn Lee,ann2,b,2026-11-21T10:00:00Z\n\
        Bob Kim,bob1,c,\nBob Kim,bob2,d,\n";
    let emails = "First Name,Last Name,SID,Email,Total Score,Max Points\n\
        Ann,Lee,a,ann@x.edu,,\nAnn,Lee,b,ann@x.edu,,\n\
        Bob,Kim,c,bob@x.edu,,\nBob,Kim,d,bob@x.edu,,\n";
    let blind = class.path_beside("blind").display().to_string();
    let lists = [
        ("roster", roster),
        ("gradescope", emails),
        ("policy", "[attempts]\ncounts = 'latest'\n"),
    ];
    class.graded_with(&exam, &lists, &["--anonymous", &blind]);
    let key = key(&class);
    let ids: Vec<&str> = key.keys().map(String::as_str).collect();
    assert_eq!(ids, ["ann2", "bob1", "bob2"]);
    let students = class.path_beside("blind/students");
    assert_eq!(fs::read_dir(students).unwrap().count(), 3);
    let grades = fs::read_to_string(class.path_beside("blind/grades.csv")).unwrap();
    let rows = table(&grades);
    let row = |id: &str| {
        rows.iter()
            .find(|row| row["submission"] == key[id])
            .unwrap()
    };
    assert_eq!(row("ann2")["counts"], "2");
    assert_eq!(row("bob1")["status"], "several attempts");
    let why = "the same person also submitted another attempt";
    assert_contains(&row("bob1")["why"], &[why]);

    // Points for a pseudonym stay with this attempt, even if a different attempt counts later.
    let manual = format!(
        "student,task,delta,comment,author\n{},camera,-1,copied,Tess\n",
        key["ann2"]
    );
    let own = || ["ann1", "ann2"].map(|id| cell(&class, id, "Ann Lee", "counts"));
    class.graded_with(&exam, &[("manual-points", &manual)], &[]);
    assert_eq!(own(), ["", "1"]);
    let later = roster.replace("2026-11-20T10", "2026-11-22T10");
    let later = class.write_beside("later.csv", &later);
    let output = class.grade(&exam, &["--roster", &later]);
    successful_stdout(&output);
    let error = String::from_utf8(output.stderr).unwrap();
    assert_contains(&error, &["row 2: another attempt counts instead"]);
    assert_eq!(own(), ["0", ""]);
    fs::remove_dir_all(class.input().join("ann2")).unwrap();
    let error = class.refused(&exam, &[]);
    let why = "the submission with this pseudonym is not in the input";
    assert_contains(&error, &[why]);
}
