//! Writes known mistakes and variants as submissions: either a class of any size, to measure how
//! fast a class is graded, or the solutions with given ids, to grade them one by one.
//!
//! ```text
//! cargo run --release -p author --example submissions -- target/class 200
//! time cargo class target/class --out target/graded
//!
//! cargo run --release -p author --example submissions -- target/class bvh.wide sphere.near_only
//! cargo grade target/class/bvh.wide
//! ```

use std::env;
use std::error::Error;
use std::path::PathBuf;

use author::solutions::catalogue::mistakes;
use author::solutions::sources::Sources;
use author::solutions::variants::variants;
use grader::handed_out::RAYS;
use grader::workspace::Workspace;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = env::args().skip(1);
    let folder = PathBuf::from(arguments.next().ok_or(USAGE)?);
    let arguments: Vec<String> = arguments.collect();
    let solutions = solutions()?;
    match &*arguments {
        [] => return Err(USAGE.into()),
        [count] if count.parse::<usize>().is_ok() => {
            for index in 0..count.parse()? {
                // The stride ensures that even a small class contains mistakes in all tasks.
                let (id, sources) = &solutions[(7 * index) % solutions.len()];
                sources.write(&folder.join(format!("{index:04}-{id}")))?;
            }
        }
        ids => {
            for id in ids {
                let solution = solutions.iter().find(|(known, _)| known == id);
                let (_, sources) = solution
                    .ok_or_else(|| format!("there is no mistake or variant with the id {id}"))?;
                sources.write(&folder.join(id))?;
            }
        }
    }
    Ok(())
}

const USAGE: &str = "expected a folder and a number of submissions, such as `target/class 200`, or a \
                     folder and ids of mistakes or variants";

/// Returns all mistakes and variants with their ids.
fn solutions() -> Result<Vec<(String, Sources)>, Box<dyn Error>> {
    let workspace = Workspace::find()?;
    let root = workspace.root();
    let reference = Sources::reference(root, &RAYS)?;
    let mut solutions = Vec::new();
    for mistake in mistakes(root, &RAYS)? {
        let sources = mistake.apply(&reference)?;
        solutions.push((mistake.id, sources));
    }
    for variant in variants(root, &RAYS)? {
        let solution = variant.solution(&reference, root)?;
        solutions.push((variant.id, solution.sources));
    }
    Ok(solutions)
}
