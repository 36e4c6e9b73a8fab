//! Writes the given code of each variant `STEM/NAME.rs` to `STEM/NAME.rs` in the output folder, and
//! a module for each variant to `all.rs`.

use std::env;
use std::error::Error;
use std::fmt::Write;
use std::fs;

use projection::given_code;

/// The reference's files, relative to this package.
const REFERENCE: &str = "../src";

fn main() -> Result<(), Box<dyn Error>> {
    let (package, out) = (env::var("CARGO_MANIFEST_DIR")?, env::var("OUT_DIR")?);
    let mut modules = String::new();
    println!("cargo::rerun-if-changed={REFERENCE}");
    for stem in source_stems(REFERENCE)? {
        if !fs::exists(&stem)? {
            continue; // A file without variants, such as `lib.rs`.
        }
        println!("cargo::rerun-if-changed={stem}");
        let reference = fs::read_to_string(format!("{REFERENCE}/{stem}.rs"))?;
        fs::create_dir_all(format!("{out}/{stem}"))?;
        writeln!(modules, "pub mod {stem} {{")?;
        for name in source_stems(&stem)? {
            let path = format!("{stem}/{name}.rs");
            let given = given_code(&reference, &fs::read_to_string(&path)?)
                .map_err(|error| format!("reference/variants/{path}: {error}"))?;
            let files = [format!("{package}/{path}"), format!("{out}/{path}")];
            fs::write(&files[1], given)?;
            let includes = files.map(|file| format!("include!({file:?});"));
            writeln!(modules, "pub mod {name} {{ {} }}", includes.join(" "))?;
        }
        writeln!(modules, "}}")?;
    }
    fs::write(format!("{out}/all.rs"), modules)?;
    Ok(())
}

/// Returns the names of the Rust files in a folder, without their extension, sorted.
fn source_stems(folder: &str) -> Result<Vec<String>, std::io::Error> {
    let mut stems = Vec::new();
    for entry in fs::read_dir(folder)? {
        let name = entry?.file_name();
        let stem = name.to_str().and_then(|name| name.strip_suffix(".rs"));
        stems.extend(stem.map(str::to_owned));
    }
    stems.sort();
    Ok(stems)
}
