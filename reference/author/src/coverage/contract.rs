//! The contract of each task: the sentences of its method's documentation.

use grader::handed_out::find_method;
use judging::assignment::TaskInfo;

/// Returns the sentences that document a task's methods, given the text of its file. A sentence that
/// documents several methods is returned once.
pub(super) fn sentences(file: &str, task: &TaskInfo) -> Vec<String> {
    let documented = task.methods.iter().flat_map(|path| {
        let documentation = documentation(file, path);
        split(&paragraphs(&documentation))
    });
    let mut sentences: Vec<String> = Vec::new();
    for sentence in documented {
        if !sentences.contains(&sentence) {
            sentences.push(sentence);
        }
    }
    sentences
}

/// Returns the lines that document a method with this full name, without their slashes.
pub fn documentation<'a>(file: &'a str, path: &str) -> Vec<&'a str> {
    let Ok(method) = find_method(file, path) else {
        return Vec::new();
    };
    let lines = file[method.bytes].lines().map(str::trim);
    let lines = lines.skip_while(|line| !line.starts_with("///"));
    lines.map_while(|line| line.strip_prefix("///")).collect()
}

/// Joins the lines of each paragraph and list item.
fn paragraphs(documentation: &[&str]) -> Vec<String> {
    let mut paragraphs = vec![String::new()];
    for text in documentation.iter().map(|line| line.trim()) {
        let item = text.strip_prefix("- ");
        if text.is_empty() || item.is_some() {
            paragraphs.push(String::new());
        }
        if let Some(paragraph) = paragraphs.last_mut() {
            paragraph.push(' ');
            paragraph.push_str(item.unwrap_or(text));
        }
    }
    paragraphs
}

/// Splits paragraphs into sentences. A sentence ends with a full stop before a capital letter or a
/// name.
fn split(paragraphs: &[String]) -> Vec<String> {
    let mut sentences = Vec::new();
    for paragraph in paragraphs {
        let mut rest = paragraph.trim();
        while !rest.is_empty() {
            let mut ends = rest.match_indices(". ").map(|(at, _)| at + 1);
            let begins = |at: &usize| {
                rest[*at..]
                    .trim_start()
                    .starts_with(|c: char| !c.is_lowercase())
            };
            let end = ends.find(begins).unwrap_or(rest.len());
            sentences.push(rest[..end].trim().to_owned());
            rest = rest[end..].trim();
        }
    }
    sentences
}

#[cfg(test)]
mod tests {
    use judging::assignment::RAYS;

    use super::*;

    #[test]
    fn paragraphs_and_list_items_are_split_into_sentences() {
        let file = "impl Sphere {\n    /// Returns a. Or `None`\n    /// if 1.5 is b.\n    ///\n    /// - One.\n    ///   \
                    Two, i.e. three.\n    pub fn hit(&self) {}\n}\n";
        let sphere = RAYS
            .tasks
            .iter()
            .find(|task| task.id == "sphere")
            .expect("a task");
        let expected = [
            "Returns a.",
            "Or `None` if 1.5 is b.",
            "One.",
            "Two, i.e. three.",
        ];
        assert_eq!(sentences(file, sphere), expected);
    }
}
