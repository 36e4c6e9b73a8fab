//! Writes two files for each variant to the output folder: one with its given code, and
//! `STEM/NAME.rs`, which includes the given code and the variant's own files. Also writes `all.rs`,
//! which has a module for each variant.

use std::collections::BTreeMap;
use std::env;
use std::error::Error;
use std::fmt::Write;
use std::fs;
use std::path::Path;

use projection::replacements;
use serde::Deserialize;

/// The reference's files, relative to this package.
const REFERENCE: &str = "../src";
/// The list of variants.
const LIST: &str = "variants.toml";

#[derive(Deserialize)]
struct List {
    variant: Vec<Variant>,
}

#[derive(Deserialize)]
struct Variant {
    id: String,
    #[serde(default)]
    parts: Vec<String>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let (package, out) = (env::var("CARGO_MANIFEST_DIR")?, env::var("OUT_DIR")?);
    println!("cargo::rerun-if-changed={REFERENCE}");
    println!("cargo::rerun-if-changed={LIST}");
    let list: List = toml::from_str(&fs::read_to_string(LIST)?)?;
    let mut modules: BTreeMap<String, String> = BTreeMap::new();
    for Variant { id, parts } in list.variant {
        let replacements = replacements(Path::new(""), &id, &parts)?;
        for replacement in &replacements {
            println!("cargo::rerun-if-changed={}", replacement.stem);
        }
        let [replacement] = &replacements[..] else {
            continue; // A variant of several task files is compiled only as a submission.
        };
        let stem = &replacement.stem;
        let reference = fs::read_to_string(format!("{REFERENCE}/{stem}.rs"))?;
        let given = replacement.given_code(&reference);
        let given = given.map_err(|error| format!("the variant {id}: {error}"))?;

        let module = format!("{out}/{}", id.replace('.', "/"));
        let mut includes = String::new();
        for (path, _) in &replacement.files {
            writeln!(includes, "include!({:?});", Path::new(&package).join(path))?;
        }
        writeln!(includes, "include!({:?});", format!("{module}.given.rs"))?;
        fs::create_dir_all(format!("{out}/{stem}"))?;
        fs::write(format!("{module}.given.rs"), given)?;
        fs::write(format!("{module}.rs"), includes)?;
        let name = id.trim_start_matches(&format!("{stem}."));
        let modules = modules.entry(stem.clone()).or_default();
        writeln!(
            modules,
            "pub mod {name} {{ include!({:?}); }}",
            format!("{module}.rs")
        )?;
    }
    let modules = modules.into_iter();
    let all = modules.map(|(stem, modules)| format!("pub mod {stem} {{\n{modules}}}\n"));
    fs::write(format!("{out}/all.rs"), all.collect::<String>())?;
    Ok(())
}
