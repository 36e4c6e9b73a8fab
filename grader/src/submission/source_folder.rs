//! Where the five files lie among others: pure.

use std::collections::{BTreeMap, BTreeSet};

use super::task_file_name;

/// In this order.
pub(super) const CANDIDATES: [&str; 3] = ["", "src", "student/src"];
/// What systems put beside people's own folders.
const MACOS_METADATA: &str = "__MACOSX";

/// Nobody can tell which of these folders is meant.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct AmbiguousSource(pub(super) Vec<String>);

/// The folder of the five files, of a listing's paths: one of the places, else the same in the
/// only top folder that has any, as archives of people and of GitHub have it. None if none has.
pub(super) fn find<'a>(
    paths: impl IntoIterator<Item = &'a str>,
) -> Result<Option<String>, AmbiguousSource> {
    let folder = |path: &'a str| {
        let (folder, name) = path.rsplit_once('/').unwrap_or(("", path));
        task_file_name(name).map(|_| folder)
    };
    let folders: BTreeSet<&str> = paths.into_iter().filter_map(folder).collect();
    if let Some(place) = CANDIDATES.iter().find(|place| folders.contains(**place)) {
        return Ok(Some((*place).to_owned()));
    }

    let mut tops: BTreeMap<&str, usize> = BTreeMap::new();
    for folder in folders {
        let (top, below) = folder.split_once('/').unwrap_or((folder, ""));
        let place = CANDIDATES.iter().position(|place| *place == below);
        if let Some(place) = place.filter(|_| top != MACOS_METADATA && !top.starts_with('.')) {
            tops.entry(top)
                .and_modify(|best| *best = place.min(*best))
                .or_insert(place);
        }
    }
    if tops.len() > 1 {
        return Err(AmbiguousSource(
            tops.into_keys().map(str::to_owned).collect(),
        ));
    }
    let only = tops.into_iter().next();
    Ok(only.map(|(top, place)| match CANDIDATES[place] {
        "" => top.to_owned(),
        below => format!("{top}/{below}"),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(paths: &[&str]) -> Result<Option<String>, AmbiguousSource> {
        find(paths.iter().copied())
    }

    #[test]
    fn prefers_the_top_then_src_then_student_src() {
        let all = ["student/src/bvh.rs", "src/bvh.rs", "bvh.rs"];
        assert_eq!(found(&all), Ok(Some(String::new())));
        assert_eq!(found(&all[..2]), Ok(Some("src".to_owned())));
        assert_eq!(found(&all[..1]), Ok(Some("student/src".to_owned())));
    }

    #[test]
    fn looks_inside_a_single_top_folder() {
        let of_github = ["hw-main/README.md", "hw-main/student/src/camera.rs"];
        assert_eq!(
            found(&of_github),
            Ok(Some("hw-main/student/src".to_owned()))
        );
        let of_a_mac = ["alice/bvh.rs", "__MACOSX/alice/._bvh.rs", "__MACOSX/bvh.rs"];
        assert_eq!(found(&of_a_mac), Ok(Some("alice".to_owned())));
    }

    #[test]
    fn reports_two_candidate_folders() {
        let two = ["alice/bvh.rs", "bob/bvh.rs"];
        let names = ["alice", "bob"].map(str::to_owned).to_vec();
        assert_eq!(found(&two), Err(AmbiguousSource(names)));
    }

    #[test]
    fn ignores_other_names_and_other_folders() {
        let others = ["Camera.rs", "cam\u{435}ra.rs", "grader/a/starter/camera.rs"];
        assert_eq!(found(&others), Ok(None));
    }
}
