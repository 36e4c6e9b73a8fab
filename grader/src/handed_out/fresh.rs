//! Compares the methods in a submission with the methods in the starter.

use judging::assignment::Task;

use super::method_span::{MethodSpan, find_method, methods};
use super::tokens::tokens;
use super::{HandedOut, TaskFile, starter_methods};

/// A task's method in a submission's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TaskMethod {
    /// The method's name, such as `Sphere::hit`.
    pub name: String,
    /// The number of the line with the method's name, counted from 1.
    pub line: u32,
    /// Whether the method differs from the starter's in more than formatting and comments.
    pub is_changed: bool,
    /// The file's text with the method replaced by the starter's version.
    pub fresh_text: String,
}

impl HandedOut {
    /// Finds a task's method in the text of the task's file.
    ///
    /// # Errors
    ///
    /// A message that says why the method was not found. A function outside an `impl` is never
    /// found, even if it is the task's method.
    ///
    /// # Panics
    ///
    /// If the task isn't part of the assignment.
    pub fn task_method(&self, task: Task, text: &str) -> Result<TaskMethod, String> {
        let info = self.assignment.info(task);
        let file = self
            .task_file(info.file)
            .expect("every task has a task file");
        let is_tasks = |span: &MethodSpan| {
            let is_inherent = !span.implemented.split(' ').any(|word| word == "for");
            span.name == info.method && is_inherent
        };
        let starter = starter_methods(file).into_iter().find(is_tasks);
        let starter =
            starter.ok_or_else(|| format!("{} has no method `{}`", file.name, info.method))?;
        let handed_out = &file.starter[starter.bytes];
        let name = format!("{}::{}", starter.implemented, info.method);
        let span = find_method(text, &starter.implemented, info.method)
            .map_err(|why| format!("cannot find {name} in {}: {why}", file.name))?;
        let (before, after) = (&text[..span.bytes.start], &text[span.bytes.end..]);
        let line = 1 + text[..span.name_start].matches('\n').count();
        let is_changed = tokens(&text[span.bytes.clone()]) != tokens(handed_out);
        // An editor on Windows may have changed all line endings.
        let handed_out = if text.contains("\r\n") {
            handed_out.replace('\n', "\r\n")
        } else {
            handed_out.to_owned()
        };
        Ok(TaskMethod {
            name,
            line: u32::try_from(line).unwrap_or(u32::MAX),
            is_changed,
            fresh_text: format!("{before}{handed_out}{after}"),
        })
    }
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
            let method = RAYS.task_method(task.task(), starter).unwrap();
            assert_eq!((&*method.fresh_text, method.is_changed), (starter, false));
            let before = starter.split(&format!("pub fn {}(", task.method)).next();
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
        let fresh = RAYS.task_method(task("build"), &solved).unwrap();
        assert_eq!(fresh.name, "Bvh::build");
        assert!(fresh.is_changed);
        let expected = solved.replace("let mine =", "let _ =");
        assert_eq!(fresh.fresh_text, expected);
        let both = RAYS
            .task_method(task("traverse"), &fresh.fresh_text)
            .unwrap();
        assert!(both.fresh_text.contains("Trace::nearer") && both.fresh_text.contains("fn helper"));

        let renamed = solved.replace("fn build(", "fn build2(");
        let error = RAYS.task_method(task("build"), &renamed).unwrap_err();
        let expected = "cannot find Bvh::build in bvh.rs: it was renamed or removed";
        assert_eq!(error, expected);
    }
}
