//! Where the time of one run went, for `--timings`.

use std::fmt::Write;
use std::time::Duration;

use crate::exam::Task;

/// How long each step of grading one submission took, by the clock on the wall.
#[derive(Clone, Copy, Debug, Default)]
pub struct StageTimes {
    /// Reading the exam, and finding what submissions are built with.
    pub prepare: Duration,
    /// From five files to a program: compiling and linking, several times where a file does not
    /// compile.
    pub build: Duration,
    /// Starting the program, anew for each task.
    pub start: Duration,
    /// Each task: from its first question to its last answer, but for starting.
    pub asking: [Duration; Task::ALL.len()],
    /// Comparing answers with keys, and with what known mistakes answer.
    pub judging: Duration,
    /// Writing the score and the page.
    pub report: Duration,
}

impl StageTimes {
    /// A line for each stage, in milliseconds.
    pub fn table(&self) -> String {
        let mut lines = vec![
            ("preparing: exam, dependencies".to_owned(), self.prepare),
            ("compiling and linking".to_owned(), self.build),
            ("starting the program".to_owned(), self.start),
        ];
        let tasks = Task::ALL.into_iter().zip(self.asking);
        lines.extend(tasks.map(|(task, took)| (format!("asking: {task}"), took)));
        lines.push(("judging".to_owned(), self.judging));
        lines.push(("score and page".to_owned(), self.report));
        let all = lines.iter().map(|(_, took)| *took).sum();
        lines.push(("together".to_owned(), all));

        let mut table = String::from("  where the time went                 ms\n");
        for (name, took) in lines {
            let millis = took.as_secs_f64() * 1e3;
            writeln!(table, "  {name:<30}{millis:>8.1}").expect("text takes text");
        }
        table
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn table_has_a_line_per_stage_and_a_total() {
        let stages = StageTimes {
            build: Duration::from_millis(400),
            asking: [Duration::from_micros(1500); 6],
            ..StageTimes::default()
        };
        let table = stages.table();
        assert_eq!(table.lines().count(), 1 + 3 + 6 + 2 + 1);
        assert!(
            table.contains("asking: bbox                       1.5\n"),
            "{table}"
        );
        assert!(
            table.ends_with("together                         409.0\n"),
            "{table}"
        );
    }
}
