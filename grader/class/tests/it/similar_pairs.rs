//! The results of similarity checkers, as Dolos and JPlag export them.

use std::fs;

use crate::harness::{TestClass, assert_contains, files_below, zip};
use crate::page::section;

/// Returns a class of three people. Two of them are in the same group. Also writes the input for a
/// checker to the folder `own` next to the class.
fn compared_class() -> TestClass {
    let class = TestClass::named("class");
    let class = ["ann", "bob", "carl"]
        .into_iter()
        .fold(class, |class, who| {
            let mine = format!("\nconst OF_{}: bool = 1 < 2;\nuse glam", who.to_uppercase());
            class
                .with_starter(who)
                .with_replaced(&format!("{who}/sphere.rs"), "\nuse glam", &mine)
                .with_replaced(&format!("{who}/camera.rs"), "\nuse glam", &mine)
        });
    let own = class.path_beside("own").display().to_string();
    class.previewed(&["--similarity-input", &own]);
    class
}

/// Returns the text with each `{id}` replaced by the submission's number in the key.
fn with_numbers(class: &TestClass, text: &str) -> String {
    let key = fs::read_to_string(class.path_beside("own-key.csv")).unwrap();
    let rows = key.lines().skip(1).map(|row| row.split(',').collect());
    rows.fold(text.to_owned(), |text, row: Vec<&str>| {
        text.replace(&format!("{{{}}}", row[1]), row[0])
    })
}

const DOLOS: &str = "id,leftFileId,leftFilePath,rightFileId,rightFilePath,similarity,\
    totalOverlap,longestFragment,leftCovered,rightCovered\n\
    0,1,/tmp/dolos-unzip-g9VHa5/sphere/{bob}.rs,0,/tmp/dolos-unzip-g9VHa5/sphere/{ann}.rs,\
    0.9166666666666666,30,10,13,17\n\
    1,2,/tmp/dolos-unzip-g9VHa5/sphere/{carl}.rs,3,/tmp/dolos-unzip-g9VHa5/camera/{carl}.rs,\
    1,182,91,91,91\n\
    2,2,/tmp/dolos-unzip-g9VHa5/sphere/{carl}.rs,0,/tmp/dolos-unzip-g9VHa5/sphere/{ann}.rs,\
    0.11650485436893204,12,6,6,6\n";
const JPLAG: &str = "submissionName1,submissionName2,averageSimilarity,maxSimilarity\r\n\
    {carl}.rs,{bob}.rs,0.5,0.75\r\n{carl}.rs,{ann}.rs,9.5E-4,0.1\r\n";

#[test]
fn the_page_shows_the_most_similar_pairs_side_by_side() {
    let class = compared_class();
    let dolos = class.write_beside("pairs.csv", &with_numbers(&class, DOLOS));
    // JPlag was given the folder of one task, so the names do not contain the task.
    fs::create_dir(class.path_beside("camera")).unwrap();
    let jplag = class.write_beside("camera/results.csv", &with_numbers(&class, JPLAG));
    let [own, blind] = ["own", "blind"].map(|name| class.path_beside(name).display().to_string());
    let exam = class.small_exam(&["camera.offset"]);
    let roster = "name,username,group\nAnn Lee,ann,One\nBob Kim,bob,One\nCarl C,carl,\n";
    let similar = ["--similar", &own, &dolos, "--similar", &own, &jplag];
    let more = [&similar[..], &["--anonymous", &blind, "--hand-back"]].concat();
    class.graded_with(&exam, &[("roster", roster)], &more);

    let page = class.read("class.html");
    assert_contains(&page, &["<a href=\"students/carl/report.html\">carl (Carl"]);
    insta::assert_snapshot!(section(&page.replace("</p>", "</p>\n"), "similar"));
    // Neither students nor those who grade the anonymous copy see the similar pairs.
    let files = files_below(&class.out())
        .into_iter()
        .chain(files_below(blind.as_ref()));
    for path in files.filter(|path| *path != class.out().join("class.html")) {
        let bytes = fs::read(&path).unwrap();
        let text = String::from_utf8_lossy(&bytes);
        assert!(!text.contains("imilarity"), "{}", path.display());
    }

    // Without the option, the next run does not show outdated results.
    class.graded_with(&exam, &[("roster", roster)], &[]);
    assert!(!class.read("class.html").contains("id=\"similar\""));
}

/// Since version 6, JPlag writes the comparisons to a separate file. A submission's id is its name,
/// with each slash replaced by an underscore.
#[test]
fn jplags_archive_shows_the_same_pairs_as_its_table() {
    let class = compared_class();
    fs::create_dir(class.path_beside("camera")).unwrap();
    let own = class.path_beside("own").display().to_string();
    let exam = class.small_exam(&["camera.offset"]);
    let shown = |results: &str| {
        class.graded(&exam, &["--similar", &own, results]);
        section(&class.read("class.html"), "similar")
    };
    let table = class.write_beside("camera/results.csv", &with_numbers(&class, JPLAG));
    let expected = shown(&table);
    let comparisons = |first: &str, second: &str| {
        let row = |who: &str, average: f64| {
            format!(
                "{{\"{first}\": \"camera_{{carl}}.rs\", \"{second}\": \"{{{who}}}.rs\", \
                 \"similarities\": {{\"AVG\": {average}, \"MAX\": 0.75}}}}"
            )
        };
        format!("[{}, {}]", row("bob", 0.5), row("ann", 9.5e-4))
    };
    let names = "{\"camera_{carl}.rs\": \"camera/{carl}.rs\", \"{bob}.rs\": \"{bob}.rs\"}";
    let (since_6, before) = (
        comparisons("firstSubmission", "secondSubmission"),
        comparisons("first_submission", "second_submission"),
    );
    let overview =
        format!("{{\"top_comparisons\": {before}, \"submission_id_to_display_name\": {names}}}");
    let archive = |name: &str, files: &[(&str, String)]| {
        let path = class.path_beside(name);
        let files = files.iter();
        let files = files.map(|(name, text)| (*name, with_numbers(&class, text)));
        fs::write(&path, zip(files)).unwrap();
        path.display().to_string()
    };
    let mappings = format!("{{\"submissionIds\": {names}}}");
    let version_6 = [
        ("topComparisons.json", since_6),
        ("submissionMappings.json", mappings),
    ];
    assert_eq!(shown(&archive("camera/result.jplag", &version_6)), expected);
    let version_5 = [("overview.json", overview)];
    assert_eq!(shown(&archive("camera/result.zip", &version_5)), expected);
    let other = archive("camera/other.zip", &[("README.txt", String::new())]);
    let error = class.refused(&exam, &["--similar", &own, &other]);
    assert_contains(&error, &["no comparisons in the format of JPlag 5 or 6"]);
}

#[test]
fn results_that_cannot_be_read_are_errors_before_anything_is_graded() {
    let class = compared_class();
    fs::create_dir(class.path_beside("sphere")).unwrap();
    let parent = format!("{}/", class.path_beside("").display());
    let parent = parent.replace("//", "/");
    let refused = |folder: &str, name: &str, text: &str| {
        let results = class.write_beside(name, &with_numbers(&class, text));
        let own = class.path_beside(folder).display().to_string();
        let error = class.refused("no exam is read", &["--similar", &own, &results]);
        error.replace(&parent, "")
    };
    let jplag = |rows: &str| {
        let (header, _) = JPLAG.split_once('\n').unwrap();
        format!("{header}\n{rows}\n")
    };
    let both = "{ann}.rs,{bob}.rs,1.0,1.0";
    let errors = [
        refused("own", "files.csv", "id,path,content,ast,extra\n"),
        refused("submissions", "results.csv", &jplag(both)),
        // The next three cases are JPlag's anonymous file, which has no names, a submission that
        // was not compared, and names that don't contain the task.
        refused("own", "results-anonymous.csv", &jplag("0,1,1.0,1.0")),
        refused(
            "own",
            "sphere/results.csv",
            &jplag(&format!("{both}\r\n{{ann}}.rs,0009.rs,1,1")),
        ),
        refused("own", "results.csv", &jplag(both)),
        refused(
            "own",
            "sphere/results.csv",
            &jplag(&both.replace("1.0", "87%")),
        ),
    ];
    assert!(!class.out().exists());
    insta::assert_snapshot!(errors.concat());
}
