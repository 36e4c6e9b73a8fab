//! `cargo author bundle` and `cargo author package`.

use std::path::Path;

use anyhow::bail;
use grader::files;

use super::{CommandResult, report};
use crate::authoring::Authoring;
use crate::bundle::secrets::Secrets;
use crate::bundle::{self, Bundle, BundleOptions, archive};
use crate::cli::{BundleArgs, PackageArgs};
use crate::light::LightFiles;
use crate::package::{self, CourseFiles, Platform, trial};

/// Writes or checks the students' bundle.
pub(super) fn bundle(root: &Path, authoring: &Authoring, args: &BundleArgs) -> CommandResult {
    let handed_out = authoring.handed_out;
    let (book, light) = (args.book.as_deref(), args.light);
    let mut bundle = Bundle::collect(root, handed_out, BundleOptions { book, light })?;
    // Use the full bundle here, because lines of the starter aren't secret.
    let secrets = Secrets::gather(root, authoring, light, &bundle)?;
    if args.update {
        bundle = bundle.without_students_files(handed_out, light);
    }
    report_leaks(&bundle, &secrets)?;
    if args.check {
        bundle::check::check(root, handed_out, light, &bundle)?;
    }
    say_what_is_published(light);
    if let Some(out) = &args.out {
        archive::write(&bundle, out)?;
        if args.book.is_none() {
            println!(
                "the built handout is not included: `cargo book --students` builds it, and \
                 `--book target/students-handout` adds it"
            );
        }
    }
    Ok(())
}

/// Points out that students can read part two's solution, if the bundle contains it.
fn say_what_is_published(light: LightFiles) {
    if light == LightFiles::Solved {
        println!(
            "students can read the solution to part two, which draws the pictures: use `--light \
             stubs` if they should write both parts"
        );
    }
}

/// Prints a summary of a bundle's contents. Fails if the bundle contains a secret.
fn report_leaks(bundle: &Bundle, secrets: &Secrets) -> CommandResult {
    let leaks = secrets.search(bundle);
    let problems: Vec<String> = leaks.iter().map(ToString::to_string).collect();
    let (count, size) = (bundle.files.len(), bundle.size() / 1000);
    let version = bundle.version();
    let version = version.map_or(String::new(), |version| format!("version {version}, "));
    let line = format!("{version}{count} files, {size} kB, searched for {secrets}");
    report(&problems, &line)
}

/// Collects a platform's package, writes it and, if requested, runs it the way the platform does. A
/// template repository is searched for secrets first.
pub(super) fn package(
    root: &Path,
    authoring: &'static Authoring,
    args: &PackageArgs,
) -> CommandResult {
    let (exam, policy) = (args.exam.as_deref(), args.policy.as_deref());
    let course = CourseFiles::new(authoring, args.exam_seed, exam, policy, args.light)?;
    let (platform, out) = (args.platform, args.out.as_path());
    let package = &package::collect(root, authoring.handed_out, platform, course)?;
    match platform {
        Platform::Gradescope => {
            let is_zip = out.extension().is_some_and(|extension| extension == "zip");
            if !is_zip {
                bail!("Gradescope needs a zip file: choose a name for --out that ends with .zip");
            }
            files::write_with_parents(out, archive::zip_with_prefix(package, "")?)?;
            let (count, size) = (package.files.len(), package.size() / 1_000_000);
            println!("{count} files, {size} MB unpacked: {}", out.display());
        }
        Platform::Classroom50 => {
            archive::write_folder(package, out)?;
            say_what_is_published(args.light);
            println!("{} files: {}", package.files.len(), out.display());
        }
        Platform::Github => {
            let secrets = Secrets::gather(root, authoring, args.light, package)?;
            report_leaks(package, &secrets)?;
            say_what_is_published(args.light);
            archive::write(package, out)?;
        }
    }
    if !args.check {
        return Ok(());
    }
    let line = match platform {
        Platform::Gradescope => "the package grades correctly when run the way Gradescope runs it",
        Platform::Classroom50 => {
            "the package grades a checkout correctly when run the way classroom50 runs it"
        }
        Platform::Github => "the template's workflow grades a checkout correctly",
    };
    let problems = trial::check(authoring, root, platform, package, out)?;
    report(&problems, line)
}
