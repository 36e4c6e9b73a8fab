//! Finds the folder with the task files in a list of paths, without any I/O.

use std::collections::{BTreeMap, BTreeSet};

use crate::handed_out::HandedOut;

/// A folder of metadata that macOS adds to archives.
const MACOS_METADATA: &str = "__MACOSX";

/// An error returned if several top-level folders have task files, so that it is unclear which one
/// is meant. Holds these folders.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct AmbiguousSource(pub(super) Vec<String>);

/// Finds the folder with the task files, given the paths of all files. The first of the assignment's
/// folders that has task files is used. If none has, the candidates inside each top-level folder are
/// considered, since people and GitHub often put everything in one folder; only one top-level
/// folder may have task files. Returns `None` if no folder is found.
pub(super) fn find<'a>(
    paths: impl IntoIterator<Item = &'a str>,
    handed_out: &HandedOut,
) -> Result<Option<String>, AmbiguousSource> {
    let folder = |path: &'a str| {
        let (folder, name) = path.rsplit_once('/').unwrap_or(("", path));
        handed_out.task_file(name).map(|_| folder)
    };
    let folders: BTreeSet<&str> = paths.into_iter().filter_map(folder).collect();
    let candidates = handed_out.assignment.folders;
    if let Some(candidate) = candidates
        .iter()
        .find(|candidate| folders.contains(**candidate))
    {
        return Ok(Some((*candidate).to_owned()));
    }

    let mut tops: BTreeMap<&str, usize> = BTreeMap::new();
    for folder in folders {
        let (top, below) = folder.split_once('/').unwrap_or((folder, ""));
        let rank = candidates.iter().position(|candidate| *candidate == below);
        if let Some(rank) = rank.filter(|_| top != MACOS_METADATA && !top.starts_with('.')) {
            tops.entry(top)
                .and_modify(|best| *best = rank.min(*best))
                .or_insert(rank);
        }
    }
    if tops.len() > 1 {
        return Err(AmbiguousSource(
            tops.into_keys().map(str::to_owned).collect(),
        ));
    }
    let only = tops.into_iter().next();
    Ok(only.map(|(top, rank)| match candidates[rank] {
        "" => top.to_owned(),
        below => format!("{top}/{below}"),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handed_out::RAYS;

    fn find_in(paths: &[&str]) -> Result<Option<String>, AmbiguousSource> {
        find(paths.iter().copied(), &RAYS)
    }

    #[test]
    fn prefers_the_top_then_src_then_student_src() {
        let all = ["student/src/bvh.rs", "src/bvh.rs", "bvh.rs"];
        assert_eq!(find_in(&all), Ok(Some(String::new())));
        assert_eq!(find_in(&all[..2]), Ok(Some("src".to_owned())));
        assert_eq!(find_in(&all[..1]), Ok(Some("student/src".to_owned())));
    }

    #[test]
    fn looks_inside_a_single_top_folder() {
        let of_github = ["hw-main/README.md", "hw-main/student/src/camera.rs"];
        assert_eq!(
            find_in(&of_github),
            Ok(Some("hw-main/student/src".to_owned()))
        );
        let of_a_mac = ["alice/bvh.rs", "__MACOSX/alice/._bvh.rs", "__MACOSX/bvh.rs"];
        assert_eq!(find_in(&of_a_mac), Ok(Some("alice".to_owned())));
    }

    #[test]
    fn reports_two_candidate_folders() {
        let two = ["alice/bvh.rs", "bob/bvh.rs"];
        let names = ["alice", "bob"].map(str::to_owned).to_vec();
        assert_eq!(find_in(&two), Err(AmbiguousSource(names)));
    }

    #[test]
    fn ignores_other_names_and_other_folders() {
        let others = ["Camera.rs", "cam\u{435}ra.rs", "grader/a/starter/camera.rs"];
        assert_eq!(find_in(&others), Ok(None));
    }
}
