//! Task files with some of their methods as they were handed out.

use judging::assignment::Task;

use super::method_span::{MethodSpanError, find_method, methods_named};
use super::tokens::tokens;
use super::{HandedOut, TaskFile, methods};

/// A task file in which a task's method is as it was handed out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FreshMethod {
    /// The file's text.
    pub text: String,
    /// The method's name, such as `Sphere::hit`.
    pub method: String,
    /// Whether the method was different before, in more than its format and comments.
    pub is_changed: bool,
}

/// The error if a task's method cannot be found in a file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cannot find {method} in {file}: {reason}")]
pub struct FreshMethodError {
    /// The method's name, such as `Sphere::hit`.
    pub method: String,
    /// The name of the file.
    pub file: &'static str,
    /// The reason.
    pub reason: MethodSpanError,
}

impl HandedOut {
    /// Returns the text of a task's file with the task's method replaced by the starter's. The rest
    /// of the text is unchanged.
    ///
    /// # Panics
    ///
    /// If the assignment has no such task, or the starter lacks its method; a test checks that.
    pub fn with_fresh_method(
        &self,
        task: Task,
        text: &str,
    ) -> Result<FreshMethod, FreshMethodError> {
        let info = self.assignment.info(task);
        let file = self.task_file(info.file).expect("tasks have a task file");
        let (implemented, handed_out) = starter_method(file, info.method);
        let method = format!("{implemented}::{}", info.method);
        let span =
            find_method(text, &implemented, info.method).map_err(|reason| FreshMethodError {
                method: method.clone(),
                file: file.name,
                reason,
            })?;
        let (before, after) = (&text[..span.bytes.start], &text[span.bytes.end..]);
        let is_changed = tokens(&text[span.bytes.clone()]) != tokens(handed_out);
        // An editor on Windows may have changed all line ends.
        let handed_out = if text.contains("\r\n") {
            handed_out.replace('\n', "\r\n")
        } else {
            handed_out.to_owned()
        };
        Ok(FreshMethod {
            text: format!("{before}{handed_out}{after}"),
            method,
            is_changed,
        })
    }
}

/// The declaration of a method, as it is and as it was handed out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChangedDeclaration {
    /// The declaration in the submission, on one line.
    pub now: String,
    /// The declaration in the starter, on one line.
    pub handed_out: String,
}

/// Returns the first declaration in a file that is not as it was handed out, in more than its format.
/// Methods that are not found are left to the compiler.
pub fn changed_declaration(file: &TaskFile, text: &str) -> Option<ChangedDeclaration> {
    methods(file.starter)
        .into_iter()
        .find_map(|(name, method)| {
            let handed_out = declaration(method);
            let found = methods_named(text, name).ok()?.into_iter();
            let found: Vec<String> = found.map(|span| declaration(&text[span.bytes])).collect();
            let is_there = found.iter().any(|now| tokens(now) == tokens(&handed_out));
            let now = found.into_iter().next().filter(|_| !is_there)?;
            Some(ChangedDeclaration { now, handed_out })
        })
}

/// Returns a method's text without its documentation, attributes and body, on one line.
fn declaration(method: &str) -> String {
    let lines = method.lines().map(str::trim);
    let code = lines.filter(|line| !line.starts_with("//") && !line.starts_with('#'));
    let code = code.collect::<Vec<_>>().join(" ");
    code.split('{').next().unwrap_or_default().trim().to_owned()
}

/// Returns the type that has the method in the starter, and the method's text.
fn starter_method(file: &TaskFile, method: &str) -> (String, &'static str) {
    let found = methods_named(file.starter, method).expect("the starter's braces match");
    let inherent = |implemented: &str| !implemented.split(' ').any(|word| word == "for");
    let mut found = found.into_iter().filter(|span| inherent(&span.implemented));
    let span = found.next().expect("the starter has each task's method");
    (span.implemented, &file.starter[span.bytes])
}

#[cfg(test)]
mod tests {
    use judging::assignment::TaskInfo;

    use crate::handed_out::RAYS;

    #[test]
    fn a_fresh_method_in_the_starter_changes_nothing() {
        for task in RAYS.assignment.tasks {
            let starter = RAYS.task_file(task.file).unwrap().starter;
            let fresh = RAYS.with_fresh_method(task.task(), starter).unwrap();
            assert_eq!((&*fresh.text, fresh.is_changed), (starter, false));
        }
    }

    #[test]
    fn only_the_tasks_own_method_is_replaced() {
        let task = |id| RAYS.assignment.find(id).map(TaskInfo::task).unwrap();
        let starter = RAYS.task_file("bvh.rs").unwrap().starter;
        let solved = starter
            .replace("let _ = max_leaf_size;", "let mine = max_leaf_size;")
            .replace(
                "// Add your own methods here.",
                "fn helper() -> char { '}' }",
            )
            .replace("traces.fold(None, Trace::nearer)", "traces.last()?")
            .replace('\n', "\r\n");
        let fresh = RAYS.with_fresh_method(task("build"), &solved).unwrap();
        assert_eq!(fresh.method, "Bvh::build");
        assert!(fresh.is_changed);
        let expected = solved.replace("let mine =", "let _ =");
        assert_eq!(fresh.text, expected);
        let both = RAYS
            .with_fresh_method(task("traverse"), &fresh.text)
            .unwrap();
        assert!(both.text.contains("Trace::nearer") && both.text.contains("fn helper"));

        let renamed = solved.replace("fn build(", "fn build2(");
        let error = RAYS.with_fresh_method(task("build"), &renamed).unwrap_err();
        assert_eq!(
            error.to_string(),
            "cannot find Bvh::build in bvh.rs: it was renamed or removed"
        );
    }
}
