//! `cargo author bundle` and `cargo author package`.

use std::path::Path;

use anyhow::bail;
use grader::files;

use super::{CommandResult, HANDED_OUT, report};
use crate::bundle::secrets::Secrets;
use crate::bundle::{self, Bundle, archive};
use crate::cli::{BundleArgs, PackageArgs};
use crate::package::{self, Course, Platform, trial};

/// Writes or checks the students' bundle.
pub(super) fn bundle(root: &Path, args: &BundleArgs) -> CommandResult {
    let mut bundle = Bundle::collect(root, HANDED_OUT, args.book.as_deref())?;
    // With the students' files: what their starter contains is no secret.
    let secrets = Secrets::gather(root, HANDED_OUT, &bundle)?;
    if args.update {
        bundle = bundle.without_students_files(HANDED_OUT);
    }
    write_bundle(root, &bundle, &secrets, args.out.as_deref(), args.check)
}

/// Writes the students' bundle. Fails if the bundle contains a secret.
fn write_bundle(
    root: &Path,
    bundle: &Bundle,
    secrets: &Secrets,
    out: Option<&Path>,
    check: bool,
) -> CommandResult {
    let leaks = secrets.search(bundle);
    let problems: Vec<String> = leaks.iter().map(ToString::to_string).collect();
    if check && leaks.is_empty() {
        bundle::check::check(root, HANDED_OUT, bundle)?;
    }
    let (count, size) = (bundle.files.len(), bundle.size() / 1000);
    let version = bundle.version();
    let version = version.map_or(String::new(), |version| format!("version {version}, "));
    let line = format!("{version}{count} files, {size} kB, searched for {secrets}");
    report(&problems, &line)?;
    if let Some(out) = out {
        archive::write(bundle, out)?;
    }
    Ok(())
}

/// Collects a platform's package, writes it, and runs it as the platform does if asked to. A template
/// repository is searched for secrets first.
pub(super) fn package(root: &Path, args: &PackageArgs) -> CommandResult {
    let (exam, policy) = (args.exam.as_deref(), args.policy.as_deref());
    let course = Course::new(HANDED_OUT, args.exam_seed, exam, policy)?;
    let (platform, out) = (args.platform, args.out.as_path());
    let package = &package::collect(root, HANDED_OUT, platform, course)?;
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
            println!("{} files: {}", package.files.len(), out.display());
        }
        Platform::Github => {
            let secrets = Secrets::gather(root, HANDED_OUT, package)?;
            write_bundle(root, package, &secrets, Some(out), false)?;
        }
    }
    if !args.check {
        return Ok(());
    }
    let line = match platform {
        Platform::Gradescope => "the package grades correctly when run as on Gradescope",
        Platform::Classroom50 => {
            "the package grades a checkout correctly when run as on classroom50"
        }
        Platform::Github => "the template's workflow grades a checkout correctly",
    };
    let problems = trial::check(HANDED_OUT, root, platform, package, out)?;
    report(&problems, line)
}
