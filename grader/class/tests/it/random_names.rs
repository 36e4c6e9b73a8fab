//! Random names of files and folders, read in every layout.

use clap::ValueEnum;
use class::entry::Source;
use class::file_tree::list_folder;
use class::layout::{Layout, LayoutChoice, recognise};
use grader::handed_out::RAYS;
use proptest::prelude::*;

use crate::harness::TestClass;

/// Generates parts of names, as platforms and students write them.
fn name_part() -> impl Strategy<Value = String> {
    let usual = [
        "ann",
        "Lee, Ann(ann)",
        "Participant",
        "anon",
        "LATE",
        "_",
        "_7001_9001_",
        "_303",
        " - ",
        "(1)",
        "é",
        "\u{202e}",
        "104840-170649 - ",
        "Nov 20, 2026 1134 PM",
        "_attempt_2026-11-20-10-00-00",
        "_assignsubmission_file_",
        "_assignsubmission_onlinetext_",
        "_Submission attachment(s)_",
        "_submissionText.html",
        ".txt",
        "camera.rs",
        "hw-1.zip",
        "Version 2",
        "grades.csv",
    ];
    let usual = proptest::sample::select(usual.to_vec()).prop_map(str::to_owned);
    prop_oneof![9 => usual, 1 => "[^/\0.]{1,8}"]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// The names in an export can be anything: students choose their file names, and some platforms
    /// let them choose their display names.
    #[test]
    fn whatever_names_an_export_has_each_is_graded_or_listed(
        names in proptest::collection::btree_map(
            proptest::collection::vec(name_part(), 1..6).prop_map(|parts| parts.concat()),
            any::<bool>(),
            1..6,
        ),
    ) {
        let mut class = TestClass::named("class");
        for (name, is_folder) in &names {
            let inner = if *is_folder { "/camera.rs" } else { "" };
            class = class.with(&format!("{name}{inner}"), "Name: Zoë (zoe)\n");
        }
        let root = list_folder(&class.input()).unwrap();
        for layout in Layout::value_variants() {
            let choice = LayoutChoice { layout: Some(*layout), title: None };
            let is_of_clones = [Layout::GitHub, Layout::GitLab].contains(layout);
            let found = match recognise(&choice, &root, None, &RAYS, &[]) {
                // Clones are refused if most of their names, but not all of them, begin alike.
                Err(_) if is_of_clones => continue,
                found => found.unwrap(),
            };
            let is_known = |name: &str| {
                let path = class.input().join(name);
                found.unmatched.iter().any(|other| other.name.starts_with(name))
                    || found.entries.iter().any(|entry| match &entry.source {
                        Source::Path(own) => own.starts_with(&path),
                        Source::Files(files) => files.iter().any(|(_, own)| *own == path),
                        // The message asks a person to look at all files of the submission.
                        Source::Missing(_) => true,
                    })
            };
            // An archive from Canvas can be replaced by a newer archive, and Blackboard's receipts
            // aren't submissions.
            let is_other = *layout == Layout::Canvas || *layout == Layout::Blackboard;
            for node in root.children().iter().filter(|node| node.name != "grades.csv") {
                prop_assert!(is_other || is_known(&node.name), "{layout:?}: {}", node.name);
            }
        }
    }
}
