//! Wrong methods, from the `methods` folder of an assignment's mistakes. Like unknown mistakes,
//! they have no hints of their own. Each is a method, together with its helpers, that a student
//! might write instead of the reference's.

use anyhow::{Result, anyhow};
use judging::assignment::Task;
use projection::Replacement;
use serde::Deserialize;

use crate::solutions::Solutions;
use crate::solutions::catalogue::read_folder;
use crate::solutions::solution::{Expected, Solution};

/// The methods in one file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    /// The variant whose items the methods replace. Without a variant, the methods complete the
    /// reference's given code.
    #[serde(default)]
    variant: Option<String>,
    method: Vec<Method>,
}

/// A wrong method.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Method {
    /// The task's id, a dot, and a name, such as `sphere.shape_as_byte`.
    id: String,
    /// A description of what the method does wrong.
    title: String,
    /// Additional tasks that may lose points.
    #[serde(default)]
    other_tasks: Vec<Task>,
    /// The known mistakes whose hints are true for this method.
    #[serde(default)]
    true_hints: Vec<String>,
    /// The method with its imports and helpers. Each item it defines replaces the item of the same
    /// name in the given code or the variant.
    code: String,
}

/// Reads the wrong methods. Each is inserted into its file to form a wrong solution.
pub fn wrong_methods(solutions: &Solutions) -> Result<Vec<Solution>> {
    let files: Vec<File> = read_folder(
        solutions.workbench.root(),
        solutions.workbench.handed_out(),
        "methods",
    )?;
    let mut all = Vec::new();
    for file in files {
        for method in file.method {
            all.push(method.solution(solutions, file.variant.as_deref())?);
        }
    }
    Ok(all)
}

impl Method {
    /// Returns the reference, or the variant, with this method.
    fn solution(self, solutions: &Solutions, variant: Option<&str>) -> Result<Solution> {
        let task = solutions.check_unknown(&self.id, &self.true_hints, "methods")?;
        let base = match variant {
            None => solutions.recorder.reference(),
            Some(id) => {
                let variants = &solutions.variants;
                let variant = variants.iter().find(|variant| variant.id == id);
                let variant =
                    variant.ok_or_else(|| anyhow!("{}: there is no variant {id}", self.id))?;
                &variant.sources
            }
        };
        let name = base.handed_out().assignment.info(task).file;
        let keeps_state = self.code.contains("static ");
        let replacement = Replacement {
            stem: name.trim_end_matches(".rs").to_owned(),
            files: vec![(name.into(), self.code)],
        };
        let text = replacement.complete(base.text(name).unwrap_or_default());
        let text = text.map_err(|error| anyhow!("{} in mistakes/methods: {error}", self.id))?;
        Ok(Solution {
            sources: base.clone().with_file(name, text),
            expected: Expected {
                tasks: [&[task], &self.other_tasks[..]].concat(),
                true_hints: self.true_hints,
                keeps_state,
                ..Expected::default()
            },
            id: self.id,
            title: self.title,
        })
    }
}
