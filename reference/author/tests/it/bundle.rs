//! The students' bundle is complete, reproducible and free of secrets.
//!
//! `cargo author bundle --check` takes minutes. It also checks that the bundle builds and grades
//! with an empty home directory.

use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs;
use std::path::Path;

use author::authoring;
use author::bundle::archive::{unzip, zip};
use author::bundle::secrets::{Leak, Secrets};
use author::bundle::{Bundle, BundleOptions, archive};
use author::exams;
use author::light::LightFiles;
use grader::handed_out::{LIGHT, RAYS};
use tempfile::TempDir;

use crate::harness::{BUNDLE, author_fails, author_succeeds, root, text};

fn secrets() -> Secrets {
    Secrets::gather(&root(), &authoring::RAYS, LightFiles::Solved, &BUNDLE).unwrap()
}

/// Returns the arguments of `cargo author bundle --out OUT`, followed by the arguments `more`.
fn bundle_to<'a>(out: &'a Path, more: &[&'a OsStr]) -> Vec<&'a OsStr> {
    let arguments = ["bundle", "--out"].map(OsStr::new);
    [&arguments[..], &[out.as_os_str()], more].concat()
}

#[test]
fn archives_are_reproducible_and_unpack_to_the_same_files() {
    let folder = TempDir::new().unwrap();
    let archive = folder.path().join("pathtracing.zip");
    author_succeeds(&bundle_to(&archive, &[]));
    let bytes = fs::read(archive).unwrap();
    assert!(bytes == zip(&BUNDLE).unwrap());
    assert!(unzip(&bytes).unwrap() == *BUNDLE);
}

#[test]
fn finds_an_inserted_secret_of_each_kind() {
    let secret = |path: &'static str, part| (path, line_with(path, part));
    let (_, not_centred) = secret("reference/src/camera.rs", "film.as_vec2() - 0.5");
    let inserted = [
        secret("reference/src/camera.rs", "self.vertical_fov"),
        secret("reference/variants/bvh/build/median.rs", "total_cmp"),
        secret("reference/substitution/bvh/bvh.rs", "split_at_mut"),
        secret("reference/author/src/oracle/sphere.rs", "sqrt"),
        (
            "the mistake camera.not_centred",
            not_centred.replace(" - 0.5", ""),
        ),
    ];
    for (source, line) in inserted {
        let mut bundle = BUNDLE.clone();
        bundle.insert("scenes/notes.txt", format!("One\n\n\t{line}  \n"));
        let leaks = secrets().search(&bundle);
        let [Leak::Line { found, source: of }] = &leaks[..] else {
            panic!("{line}: {leaks:?}");
        };
        assert_eq!(found, "scenes/notes.txt:3");
        // Other files in the same folder may contain the same line.
        let folder = source.rsplit_once('/').map_or(source, |(folder, _)| folder);
        assert!(of.starts_with(folder), "{of}");
    }
}

/// Returns the first line of a file that contains `part`.
fn line_with(path: &str, part: &str) -> String {
    let text = text(path);
    let line = text.lines().find(|line| line.contains(part));
    line.unwrap_or_else(|| panic!("{path} has no {part}"))
        .to_owned()
}

/// Unpacks the bundle with these files of part two and returns the leaks found in it.
fn leaks_with(light: LightFiles, name: &str) -> (Bundle, Vec<Leak>) {
    let folder = TempDir::new().unwrap();
    let archive = folder.path().join("pathtracing.zip");
    author_succeeds(&bundle_to(&archive, &["--light".as_ref(), name.as_ref()]));
    let bundle = unzip(&fs::read(archive).unwrap()).unwrap();
    let secrets = Secrets::gather(&root(), &authoring::RAYS, light, &bundle).unwrap();
    let leaks = secrets.search(&bundle);
    (bundle, leaks)
}

#[test]
fn a_bundle_has_part_two_solved_or_as_stubs_and_no_other_solution() {
    let path = "student/light/src/material.rs";
    let reference = text("reference/light/src/material.rs");
    for (light, name) in [(LightFiles::Solved, "solved"), (LightFiles::Stubs, "stubs")] {
        let (mut bundle, leaks) = leaks_with(light, name);
        assert_eq!(leaks, [], "{name}");
        let is_solved = light == LightFiles::Solved;
        for file in LIGHT.file_names() {
            let text = bundle.text(&format!("student/light/src/{file}")).unwrap();
            assert_eq!(!text.contains("todo!("), is_solved, "{name}: {file}");
            assert_eq!(!text.contains("#[cfg(test)]"), is_solved, "{name}: {file}");
        }
        assert!(bundle.files.contains_key("student/light/src/main.rs"));
        // If the solution takes the place of the stubs, the search finds it.
        bundle.insert(path, &*reference);
        let secrets = Secrets::gather(&root(), &authoring::RAYS, light, &bundle).unwrap();
        assert_eq!(secrets.search(&bundle).is_empty(), is_solved, "{name}");
    }
}

#[test]
fn an_update_with_stubs_leaves_part_two_to_the_student() {
    let light = LightFiles::Stubs;
    for file in LIGHT.file_names() {
        let path = format!("student/light/src/{file}");
        for handed_out in [&RAYS, &LIGHT] {
            assert!(light.is_students_own(&path, handed_out));
            assert!(light.is_students_own("student/src/bvh.rs", handed_out));
        }
        assert!(!LightFiles::Solved.is_students_own(&path, &RAYS));
    }
    assert!(!light.is_students_own("student/light/src/world.rs", &LIGHT));
}

#[test]
fn finds_a_final_exam_under_any_file_name() {
    let mut exam = exams::load_practice(&root(), &authoring::RAYS).unwrap();
    exam.id = "final".to_owned();
    let mut bundle = BUNDLE.clone();
    let found = "grader/exams/practice.json".to_owned();
    bundle.insert(&found, serde_json::to_vec(&exam).unwrap());
    assert_eq!(secrets().search(&bundle), [Leak::Exam { found }]);
}

#[test]
fn the_starter_comes_from_the_reference_not_from_the_students_folder() {
    let files = BUNDLE.files.keys();
    let starter = files.filter(|path| path.starts_with("student/src/"));
    let with_main = RAYS.files.len() + RAYS.given.len() + 1;
    assert_eq!(starter.count(), with_main);
    for file in ["camera.rs", "bvh.rs"] {
        let starter = text(&format!("grader/starter/{file}"));
        assert_eq!(BUNDLE.text(&format!("student/src/{file}")), Some(&*starter));
    }
}

#[test]
fn a_built_book_is_added_beside_its_sources() {
    let book = TempDir::new().unwrap();
    let index = book.path().join("index.html");
    fs::write(index, "<title>Path tracing</title>\n").unwrap();
    let bundle = Bundle::collect(
        &root(),
        &RAYS,
        BundleOptions {
            book: Some(book.path()),
            ..BundleOptions::default()
        },
    )
    .unwrap();
    assert!(bundle.files.contains_key("handout/book/index.html"));
    assert_eq!(bundle.files.len(), BUNDLE.files.len() + 1);
}

#[test]
fn a_book_with_chapters_for_instructors_is_refused() {
    let book = TempDir::new().unwrap();
    for page in ["index.html", "sphere.html", "gradescope.html"] {
        fs::write(book.path().join(page), "<title>A page</title>\n").unwrap();
    }
    let out = book.path().join("pathtracing.zip");
    let with_book = ["--book".as_ref(), book.path().as_os_str()];
    let error = author_fails(&bundle_to(&out, &with_book));
    assert!(!out.exists(), "{error}");
    assert!(error.contains("instructors (gradescope.html)"), "{error}");
    assert!(error.contains("`cargo book --students`"), "{error}");
}

#[test]
fn its_lock_file_is_a_subset_of_the_workspaces() {
    let ours = text("Cargo.lock");
    let theirs = BUNDLE.text("Cargo.lock").unwrap();
    // Compare the name, version, source and checksum of each package, but not its dependencies,
    // since the bundle may have fewer.
    fn blocks(lock: &str) -> Vec<Vec<&str>> {
        let blocks = lock.split("[[package]]\n").skip(1);
        let foreign = blocks.filter(|block| block.contains("checksum"));
        foreign.map(|it| it.lines().take(4).collect()).collect()
    }
    let (ours, theirs) = (blocks(&ours), blocks(theirs));
    assert!(theirs.len() > 50, "{}", theirs.len());
    for package in theirs {
        assert!(ours.contains(&package), "{package:?}");
    }
}

/// Cargo warns about a profile's settings for a package that doesn't exist.
#[test]
fn its_profiles_name_only_packages_in_its_lock_file() {
    let parse = |path: &str| -> toml::Table { BUNDLE.text(path).unwrap().parse().unwrap() };
    let lock = parse("Cargo.lock");
    let locked = lock["package"].as_array().unwrap().iter();
    let locked: Vec<&str> = locked
        .map(|package| package["name"].as_str().unwrap())
        .collect();
    let manifest = parse("Cargo.toml");
    for (profile, settings) in manifest["profile"].as_table().unwrap() {
        let packages = settings.get("package").and_then(toml::Value::as_table);
        for name in packages.into_iter().flat_map(toml::Table::keys) {
            assert!(
                name == "*" || locked.contains(&name.as_str()),
                "{profile}: {name}"
            );
        }
    }
}

#[test]
fn refuses_to_write_into_a_folder_that_is_not_empty() {
    let folder = TempDir::new().unwrap();
    fs::create_dir(folder.path().join(".git")).unwrap();
    archive::write(&BUNDLE, folder.path()).expect("a new Git repository is accepted");
    assert!(folder.path().join(".github/workflows/grade.yml").is_file());

    let error = author_fails(&bundle_to(folder.path(), &[]));
    let why = "is not empty: choose a new folder";
    assert!(error.contains(why), "{error}");
}

/// Returns the paths and texts of the bundle's Markdown files.
fn documents() -> impl Iterator<Item = (&'static str, &'static str)> {
    let files = BUNDLE.text_files();
    files.filter(|(path, _)| path.ends_with(".md"))
}

#[test]
fn every_link_in_its_documents_leads_to_a_bundled_file() {
    let mut count = 0;
    for (path, page) in documents() {
        let links = page.split("](").skip(1);
        let links = links.filter_map(|rest| rest.split(')').next());
        for link in links.filter(|link| !link.starts_with("http") && !link.starts_with('#')) {
            let target = link.split('#').next().unwrap_or(link);
            let target = resolved(path, target);
            let there =
                |known: &String| *known == target || known.starts_with(&format!("{target}/"));
            assert!(BUNDLE.files.keys().any(there), "{path} links to {link}");
            count += 1;
        }
    }
    assert!(count > 30, "{count}");
}

/// Returns the target of a link on a page, relative to the bundle's root.
fn resolved(page: &str, link: &str) -> String {
    let mut parts: Vec<&str> = page.split('/').collect();
    parts.pop();
    for part in link.split('/') {
        match part {
            ".." => drop(parts.pop()),
            "." | "" => {}
            part => parts.push(part),
        }
    }
    parts.join("/")
}

#[test]
fn its_documents_name_no_staff_command() {
    for (path, text) in documents() {
        for command in ["author", "book", "class", "render-reference"] {
            assert!(!text.contains(&format!("cargo {command}")), "{path}");
        }
    }
}

#[test]
fn its_documents_name_the_rust_version_of_the_manifest() {
    let manifest = text("Cargo.toml");
    let version = manifest.split("rust-version = \"").nth(1).unwrap();
    let version = version.split('"').next().unwrap();
    for path in ["README.md", "handout/src/start.md"] {
        let text = BUNDLE.text(path).unwrap();
        assert!(text.contains(version), "{path}: {version}");
    }
}

#[test]
fn the_first_stub_is_where_the_first_page_says() {
    let page = BUNDLE.text("handout/src/start.md").unwrap();
    let place = page.split("(student/src/camera.rs:").nth(1).unwrap();
    let (line, column) = place.split(')').next().unwrap().split_once(':').unwrap();
    let [line, column] = [line, column].map(|number| number.parse::<usize>().unwrap() - 1);
    let camera = BUNDLE.text("student/src/camera.rs").unwrap();
    let stub = &camera.lines().nth(line).unwrap()[column..];
    assert!(stub.starts_with("todo!(\"task 1, camera:"), "{stub}");
}

#[test]
fn every_package_has_the_bundles_version_and_so_has_the_lock_file() {
    let version = BUNDLE.version().expect("a bundle has a version");
    assert_eq!(version.len(), 12);
    let lock = BUNDLE.text("Cargo.lock").unwrap();
    for name in ["grader", "framework", "protocol", "student"] {
        let package = format!("name = \"{name}\"\nversion = \"1.0.0+{version}\"\n");
        assert!(lock.contains(&package), "{package}");
    }
}

#[test]
fn an_update_has_everything_but_the_students_files_and_the_same_version() {
    let folder = TempDir::new().unwrap();
    let archive = folder.path().join("update.zip");
    author_succeeds(&bundle_to(
        &archive,
        &["--light", "solved", "--update"].map(OsStr::new),
    ));
    let update = unzip(&fs::read(archive).unwrap()).unwrap();
    let missing = BUNDLE.files.keys();
    let missing = missing.filter(|path| !update.files.contains_key(*path));
    let missing: BTreeSet<&str> = missing.map(String::as_str).collect();
    let own: Vec<String> = RAYS
        .file_names()
        .map(|file| format!("student/src/{file}"))
        .collect();
    assert_eq!(missing, own.iter().map(String::as_str).collect());
    assert_eq!(update.version(), BUNDLE.version());
}
