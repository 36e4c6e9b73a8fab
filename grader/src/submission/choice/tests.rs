//! Tests for the choice of the folder, with handmade and random listings.

use proptest::prelude::*;

use super::*;
use crate::handed_out::RAYS;
use crate::submission::skipped::is_skipped;

/// Returns a folder with these task files, each specified by its number and its text. Empty text
/// stands for the starter's text.
fn candidate(folder: &str, files: &[(usize, &str)]) -> Candidate {
    let mut candidate = Candidate {
        folder: folder.to_owned(),
        ..Candidate::default()
    };
    for (index, text) in files {
        let file = RAYS.files[*index];
        let text = if text.is_empty() { file.starter } else { text };
        let bytes = Ok(text.as_bytes().to_vec());
        candidate.task_files.insert(file.name, bytes);
    }
    candidate
}

fn all(text: &str) -> Vec<(usize, &str)> {
    (0..RAYS.files.len()).map(|index| (index, text)).collect()
}

/// Chooses among these folders.
fn chosen(candidates: Vec<Candidate>) -> Result<Option<Choice>, SubmissionError> {
    choose("hw".as_ref(), candidates, Vec::new(), &RAYS)
}

/// Returns the chosen folder and the notes, or the folders to choose from.
fn choice(candidates: Vec<Candidate>) -> Result<(String, Vec<String>), Vec<String>> {
    match chosen(candidates) {
        Ok(choice) => Ok(choice
            .map(|c| (c.chosen.folder, c.notes))
            .unwrap_or_default()),
        Err(SubmissionError::Ambiguous { copies, .. }) => Err(copies),
        Err(other) => panic!("{other:?}"),
    }
}

#[test]
fn the_folder_with_most_that_is_written_is_chosen_and_the_assignments_is_preferred() {
    let file = RAYS.files[4].name;
    let note = format!("{file} differs from student/src/{file} and is ignored");
    for (candidates, folder, notes) in [
        (
            vec![
                candidate("", &[(4, "old")]),
                candidate("student/src", &all("new")),
            ],
            "student/src",
            vec![note],
        ),
        // Unmodified files are treated as absent.
        (
            vec![
                candidate("", &all("")),
                candidate("my/deep/solution", &[(0, "new"), (1, ""), (2, "new")]),
            ],
            "my/deep/solution",
            Vec::new(),
        ),
        // Equal copies leave nothing to choose.
        (
            vec![
                candidate("backup", &all("new")),
                candidate("a/student/src", &all("new")),
                candidate("student/src", &all("new")),
            ],
            "student/src",
            Vec::new(),
        ),
    ] {
        assert_eq!(choice(candidates), Ok((folder.to_owned(), notes)));
    }
}

#[test]
fn two_folders_that_both_have_something_are_ambiguous() {
    for [one, other] in [
        [("src", all("new")), ("old", all("old"))],
        // One of the smaller folder's files is also in the larger folder.
        [
            ("src", vec![(0, "a"), (1, "b"), (2, "c")]),
            ("", vec![(0, "x"), (3, "d")]),
        ],
    ] {
        let folders = vec![one.0.to_owned(), other.0.to_owned()];
        let candidates = [one, other].map(|(folder, files)| candidate(folder, &files));
        assert_eq!(choice(candidates.into()), Err(folders));
    }
}

#[test]
fn files_in_several_folders_are_combined_if_there_is_one_version_of_each() {
    let candidates = vec![
        candidate("task1", &[(0, "a"), (1, ""), (2, "")]),
        candidate("task2", &[(0, ""), (1, "b"), (2, "c")]),
        candidate("task3", &[(2, "c"), (3, "")]),
    ];
    let choice = chosen(candidates).unwrap().unwrap();
    let paths = choice.chosen.task_files.iter().map(|(name, text)| {
        let text = String::from_utf8_lossy(text.as_ref().unwrap()).into_owned();
        (choice.chosen.path_of(name), text)
    });
    let [a, b, c, d] = [0, 1, 2, 3].map(|index| RAYS.files[index]);
    let mut expected = vec![
        (format!("task1/{}", a.name), "a".to_owned()),
        (format!("task2/{}", b.name), "b".to_owned()),
        (format!("task2/{}", c.name), "c".to_owned()),
        (format!("task3/{}", d.name), d.starter.to_owned()),
    ];
    let mut paths: Vec<_> = paths.collect();
    paths.sort();
    expected.sort();
    assert_eq!(paths, expected);
    assert_eq!((choice.notes, choice.is_complete), (Vec::new(), false));
}

prop_compose! {
    fn any_candidates()(folders in prop::collection::btree_map(
        "(|src|student/src|[a-c](/[a-c]){0,2})",
        prop::collection::btree_map(0usize..5, "(|x|y)", 1..=5),
        0..5,
    )) -> Vec<(String, Vec<(usize, String)>)> {
        folders.into_iter().map(|(folder, files)| (folder, files.into_iter().collect())).collect()
    }
}

fn built(folders: &[(String, Vec<(usize, String)>)]) -> Vec<Candidate> {
    let one = |(folder, files): &(String, Vec<(usize, String)>)| {
        let files: Vec<_> = files.iter().map(|(i, text)| (*i, text.as_str())).collect();
        candidate(folder, &files)
    };
    folders.iter().map(one).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_order_of_the_listing_does_not_matter(folders in any_candidates(), from in 0usize..5) {
        let mut turned = folders.clone();
        turned.rotate_left(from.min(folders.len()));
        prop_assert_eq!(choice(built(&folders)), choice(built(&turned)));
    }

    #[test]
    fn no_written_file_is_lost_silently(folders in any_candidates()) {
        let Ok(Some(choice)) = chosen(built(&folders)) else { return Ok(()) };
        for other in built(&folders) {
            for (name, text) in other.written(&RAYS) {
                let is_used = choice.chosen.task_files.get(name) == Some(text);
                let path = format!("{} differs", other.path_of(name));
                let is_noted = choice.notes.iter().any(|note| note.starts_with(&path));
                prop_assert!(is_used || is_noted, "{}", path);
            }
        }
    }
}

#[test]
fn folders_of_tools_and_of_the_project_are_skipped() {
    for name in [".git", "target", "__MACOSX", "grader"] {
        assert!(is_skipped(name, &RAYS), "{name}");
    }
    for name in ["src", "student", "old", "targets"] {
        assert!(!is_skipped(name, &RAYS), "{name}");
    }
}

#[test]
fn the_assignments_folders_come_before_those_below_another_and_these_before_the_rest() {
    let folders = ",src,student/src,a,a/src,a/student/src,a/b";
    let ranks = folders.split(',').map(|folder| rank(folder, &RAYS));
    assert!(ranks.eq(0..7));
}

#[test]
fn a_choice_is_complete_if_every_file_was_written() {
    let is_complete = |files: &[(usize, &str)]| {
        let choice = chosen(vec![candidate("src", files)]).unwrap();
        choice.unwrap().is_complete
    };
    assert!(is_complete(&all("new")));
    assert!(!is_complete(&all("new")[1..]));
    let mut files = all("new");
    files[0].1 = "";
    assert!(!is_complete(&files), "one file is the starter's");
    assert!(chosen(Vec::new()).unwrap().is_none(), "there are no files");
}

#[test]
fn many_stray_copies_are_noted_up_to_a_limit() {
    let stray = (0..MAX_NOTES + 1).map(|index| candidate(&format!("old{index}"), &[(0, "old")]));
    let found = choice(stray.chain([candidate("src", &all("new"))]).collect());
    let (folder, notes) = found.unwrap();
    assert_eq!((folder.as_str(), notes.len()), ("src", MAX_NOTES + 1));
}
