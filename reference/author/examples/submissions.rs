//! Writes a class of any size, made of the known mistakes and variants, to measure how fast a class
//! is graded.
//!
//! ```text
//! cargo run --release -p author --example submissions -- target/class 200
//! time cargo class target/class --out target/graded
//! ```

use std::env;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

use author::solutions::catalogue::mistakes;
use author::solutions::sources::Sources;
use author::solutions::variants::variants;
use grader::handed_out::RAYS;
use grader::workspace::Workspace;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args().skip(1);
    let (Some(folder), Some(count)) = (arguments.next(), arguments.next()) else {
        return Err(
            "expected a folder and a number of submissions, such as `target/class 200`".into(),
        );
    };
    let (folder, count) = (PathBuf::from(folder), count.parse()?);
    let workspace = Workspace::find()?;
    let root = workspace.root();

    let reference = Sources::reference(root, &RAYS)?;
    let mut solutions = Vec::new();
    for mistake in mistakes(root, &RAYS)? {
        solutions.push((mistake.id.clone(), mistake.apply(&reference)?));
    }
    for variant in variants(root)? {
        solutions.push((variant.id.clone(), variant.apply(&reference, root)?));
    }
    for index in 0..count {
        // The stride ensures that even a small class contains mistakes in all tasks.
        let (id, sources) = &solutions[(7 * index) % solutions.len()];
        write(&folder.join(format!("{index:04}-{id}")), sources)?;
    }
    Ok(())
}

fn write(folder: &Path, sources: &Sources) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(folder)?;
    for file in RAYS.files {
        fs::write(
            folder.join(file.name),
            sources.text(file.name).unwrap_or_default(),
        )?;
    }
    Ok(())
}
