//! Whole exams.

use grader::exam::{Exam, Item};

use crate::generated::Generated;
use crate::items::{bbox, build, camera, sphere, traverse, triangle};
use crate::seed::Seed;

/// The version of the exam file's format.
const SCHEMA: u32 = 1;

/// What the practice exam follows from. It is handed out with its keys, so this is no secret.
const PRACTICE: Seed = Seed(2025);

/// The files with exams in this repository.
pub fn generated() -> Result<Vec<Generated>, serde_json::Error> {
    let practice = text(&exam("practice", PRACTICE))?;
    Ok(vec![Generated::new("grader/exams/practice.json", practice)])
}

/// An exam of other questions about the same ideas.
pub fn final_exam(seed: u64) -> Exam {
    exam("final", Seed(seed))
}

/// An exam: each item after those that it needs.
pub fn exam(id: &str, seed: Seed) -> Exam {
    let tasks: [fn(Seed) -> Vec<Item>; 6] = [
        camera::items,
        triangle::items,
        sphere::items,
        bbox::items,
        build::items,
        traverse::items,
    ];
    Exam {
        schema: SCHEMA,
        id: id.to_owned(),
        items: tasks.into_iter().flat_map(|items| items(seed)).collect(),
    }
}

/// The exam as a file: an item a line, so that a difference shows which items it is in.
pub fn text(exam: &Exam) -> Result<String, serde_json::Error> {
    let items: Vec<String> = exam
        .items
        .iter()
        .map(serde_json::to_string)
        .collect::<Result<_, _>>()?;
    let id = serde_json::to_string(&exam.id)?;
    let (schema, items) = (exam.schema, items.join(",\n"));
    Ok(format!(
        "{{\"schema\":{schema},\"id\":{id},\"items\":[\n{items}\n]}}\n"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_is_the_exam() {
        let exam = Exam {
            schema: SCHEMA,
            id: "a \"test\"".to_owned(),
            items: bbox::items(Seed(1)),
        };
        let text = text(&exam).unwrap();
        assert_eq!(serde_json::from_str::<Exam>(&text).unwrap(), exam);
        assert_eq!(text.lines().count(), exam.items.len() + 2);
    }
}
