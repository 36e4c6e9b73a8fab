//! Compares the methods in a submission with the methods in the starter.

use judging::assignment::Task;

use super::method_span::{find_method, methods};
use super::tokens::tokens;
use super::{HandedOut, TaskFile, starter_methods};

/// A method's position in a submission's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MethodPosition {
    /// The method, such as `Sphere::hit`.
    pub path: &'static str,
    /// The number of the line with its name, counted from 1.
    pub line: u32,
    /// The number of its last line.
    pub last_line: u32,
    /// Whether it differs from the starter's version in more than formatting and comments.
    pub is_changed: bool,
}

/// A task's methods in a submission's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TaskMethods {
    /// The methods' names, such as `Sphere::hit`, separated by commas.
    pub names: String,
    /// The methods and their positions in the file.
    pub methods: Vec<MethodPosition>,
    /// The number of the line with the name of the first method that hasn't been changed, counted
    /// from 1. If all methods have been changed, it is the line of the first method.
    pub line: u32,
    /// Whether any of the methods differs from the starter's in more than formatting and comments.
    pub is_changed: bool,
    /// The file's text with the methods replaced by the starter's versions.
    pub fresh_text: String,
}

impl HandedOut {
    /// Finds a task's methods in the text of the task's file.
    ///
    /// # Errors
    ///
    /// A message that says why a method was not found.
    ///
    /// # Panics
    ///
    /// If the task isn't part of the assignment.
    pub fn task_methods(&self, task: Task, text: &str) -> Result<TaskMethods, String> {
        let info = self.assignment.info(task);
        let file = self
            .task_file(info.file)
            .expect("every task has a task file");
        let mut fresh_text = text.to_owned();
        let mut methods = Vec::new();
        for path in info.methods {
            let handed_out = find_method(file.starter, path);
            let handed_out = handed_out.map_err(|why| cannot_find(path, file, why))?;
            let handed_out = &file.starter[handed_out.bytes];
            let span = find_method(text, path).map_err(|why| cannot_find(path, file, why))?;
            let line_at = |byte| {
                let before = text[..byte].matches('\n').count();
                u32::try_from(1 + before).unwrap_or(u32::MAX)
            };
            let method = MethodPosition {
                path,
                line: line_at(span.name_start),
                last_line: line_at(span.bytes.end),
                is_changed: tokens(&text[span.bytes]) != tokens(handed_out),
            };
            if method.is_changed {
                fresh_text = replaced(&fresh_text, path, handed_out)
                    .map_err(|why| cannot_find(path, file, why))?;
            }
            methods.push(method);
        }
        let unchanged = methods.iter().find(|method| !method.is_changed);
        let first = unchanged.or(methods.first());
        Ok(TaskMethods {
            names: info.methods.join(", "),
            line: first.map_or(1, |method| method.line),
            is_changed: methods.iter().any(|method| method.is_changed),
            methods,
            fresh_text,
        })
    }
}

fn cannot_find(path: &str, file: &TaskFile, why: &str) -> String {
    format!("cannot find {path} in {}: {why}", file.name)
}

/// Returns the text with a method replaced.
fn replaced(text: &str, path: &str, method: &str) -> Result<String, &'static str> {
    let bytes = find_method(text, path)?.bytes;
    let (before, after) = (&text[..bytes.start], &text[bytes.end..]);
    // An editor on Windows may have changed all line endings.
    let method = if text.contains("\r\n") {
        method.replace('\n', "\r\n")
    } else {
        method.to_owned()
    };
    Ok(format!("{before}{method}{after}"))
}

/// A method's current and original declarations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChangedDeclaration {
    /// The declaration in the submission, on one line.
    pub now: String,
    /// The declaration in the starter, on one line.
    pub handed_out: String,
}

/// Returns the first declaration in a file that differs from the starter's in more than formatting.
/// Methods that aren't found are left for the compiler to report.
pub fn changed_declaration(file: &TaskFile, text: &str) -> Option<ChangedDeclaration> {
    let own = methods(text).ok()?;
    starter_methods(file).into_iter().find_map(|given| {
        let handed_out = declaration(&file.starter[given.bytes]);
        let found = own.iter().filter(|method| method.name == given.name);
        let mut found = found.map(|method| declaration(&text[method.bytes.clone()]));
        let now = found.next()?;
        let mut all = [now.clone()].into_iter().chain(found);
        let is_there = all.any(|now| tokens(&now) == tokens(&handed_out));
        (!is_there).then_some(ChangedDeclaration { now, handed_out })
    })
}

/// Returns a method's text without its documentation, attributes and body, on one line.
fn declaration(method: &str) -> String {
    let lines = method.lines().map(str::trim);
    let code = lines.filter(|line| !line.starts_with("//") && !line.starts_with('#'));
    let code = code.collect::<Vec<_>>().join(" ");
    code.split('{').next().unwrap_or_default().trim().to_owned()
}

#[cfg(test)]
mod tests {
    use judging::assignment::TaskInfo;

    use crate::handed_out::RAYS;

    #[test]
    fn a_fresh_method_in_the_starter_changes_nothing() {
        for task in RAYS.assignment.tasks {
            let starter = RAYS.task_file(task.file).unwrap().starter;
            let method = RAYS.task_methods(task.task(), starter).unwrap();
            assert_eq!((&*method.fresh_text, method.is_changed), (starter, false));
            let (_, name) = task.methods[0].split_once("::").unwrap();
            let before = starter.split(&format!("pub fn {name}(")).next();
            assert_eq!(method.line as usize, before.unwrap().lines().count());
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
        let fresh = RAYS.task_methods(task("build"), &solved).unwrap();
        assert_eq!(fresh.names, "Bvh::build");
        assert!(fresh.is_changed);
        let expected = solved.replace("let mine =", "let _ =");
        assert_eq!(fresh.fresh_text, expected);
        let both = RAYS
            .task_methods(task("traverse"), &fresh.fresh_text)
            .unwrap();
        assert!(both.fresh_text.contains("Trace::nearer") && both.fresh_text.contains("fn helper"));

        let renamed = solved.replace("fn build(", "fn build2(");
        let error = RAYS.task_methods(task("build"), &renamed).unwrap_err();
        let expected = "cannot find Bvh::build in bvh.rs: it was renamed or removed";
        assert_eq!(error, expected);
    }
}
