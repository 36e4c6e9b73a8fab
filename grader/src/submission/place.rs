//! Where the five files lie among others: pure.

use std::collections::{BTreeMap, BTreeSet};

use super::one_of_five;

/// In this order.
pub(super) const PLACES: [&str; 3] = ["", "src", "student/src"];
/// What systems put beside people's own folders.
const NOBODYS: &str = "__MACOSX";

/// Nobody can tell which of these folders is meant.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Several(pub(super) Vec<String>);

/// The folder of the five files, of a listing's paths: one of the places, else the same in the
/// only top folder that has any, as archives of people and of GitHub have it. None if none has.
pub(super) fn source<'a>(
    paths: impl IntoIterator<Item = &'a str>,
) -> Result<Option<String>, Several> {
    let folder = |path: &'a str| {
        let (folder, name) = path.rsplit_once('/').unwrap_or(("", path));
        one_of_five(name).map(|_| folder)
    };
    let folders: BTreeSet<&str> = paths.into_iter().filter_map(folder).collect();
    if let Some(place) = PLACES.iter().find(|place| folders.contains(**place)) {
        return Ok(Some((*place).to_owned()));
    }

    let mut tops: BTreeMap<&str, usize> = BTreeMap::new();
    for folder in folders {
        let (top, below) = folder.split_once('/').unwrap_or((folder, ""));
        let place = PLACES.iter().position(|place| *place == below);
        if let Some(place) = place.filter(|_| top != NOBODYS && !top.starts_with('.')) {
            tops.entry(top)
                .and_modify(|best| *best = place.min(*best))
                .or_insert(place);
        }
    }
    if tops.len() > 1 {
        return Err(Several(tops.into_keys().map(str::to_owned).collect()));
    }
    let only = tops.into_iter().next();
    Ok(only.map(|(top, place)| match PLACES[place] {
        "" => top.to_owned(),
        below => format!("{top}/{below}"),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(paths: &[&str]) -> Result<Option<String>, Several> {
        source(paths.iter().copied())
    }

    #[test]
    fn the_top_comes_before_src_and_src_before_the_students_folder() {
        let all = ["student/src/bvh.rs", "src/bvh.rs", "bvh.rs"];
        assert_eq!(found(&all), Ok(Some(String::new())));
        assert_eq!(found(&all[..2]), Ok(Some("src".to_owned())));
        assert_eq!(found(&all[..1]), Ok(Some("student/src".to_owned())));
    }

    #[test]
    fn one_folder_around_everything_is_looked_through() {
        let of_github = ["hw-main/README.md", "hw-main/student/src/camera.rs"];
        assert_eq!(
            found(&of_github),
            Ok(Some("hw-main/student/src".to_owned()))
        );
        let of_a_mac = ["alice/bvh.rs", "__MACOSX/alice/._bvh.rs", "__MACOSX/bvh.rs"];
        assert_eq!(found(&of_a_mac), Ok(Some("alice".to_owned())));
    }

    #[test]
    fn of_two_folders_none_is_guessed() {
        let two = ["alice/bvh.rs", "bob/bvh.rs"];
        let names = ["alice", "bob"].map(str::to_owned).to_vec();
        assert_eq!(found(&two), Err(Several(names)));
    }

    #[test]
    fn files_of_other_names_and_in_other_places_do_not_count() {
        let others = ["Camera.rs", "cam\u{435}ra.rs", "grader/a/starter/camera.rs"];
        assert_eq!(found(&others), Ok(None));
    }
}
