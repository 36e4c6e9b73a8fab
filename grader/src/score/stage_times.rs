//! Time spent in each stage of a run, for `--timings`.

use std::fmt::Write;
use std::time::Duration;

use judging::assignment::Task;

/// Wall time of each stage of grading one submission.
#[derive(Clone, Debug, Default)]
pub struct StageTimes {
    /// Reading the exam and finding the compiler and the dependencies.
    pub prepare: Duration,
    /// Compiling and linking the submission, repeatedly if a file doesn't compile.
    pub build: Duration,
    /// Starting the probe, once per task.
    pub start: Duration,
    /// Waiting for the answers in each task, excluding the start of the probe.
    pub asking: Vec<(Task, Duration)>,
    /// Comparing answers with keys and with the signatures of known mistakes.
    pub judging: Duration,
    /// Writing the score and the HTML report.
    pub report: Duration,
}

impl StageTimes {
    /// Formats a table with one line per stage, in milliseconds.
    pub fn table(&self) -> String {
        let mut lines = vec![
            ("reading exam and dependencies".to_owned(), self.prepare),
            ("compiling and linking".to_owned(), self.build),
            ("starting the program".to_owned(), self.start),
        ];
        let tasks = self.asking.iter();
        lines.extend(tasks.map(|(task, took)| (format!("answering: {task}"), *took)));
        lines.push(("judging".to_owned(), self.judging));
        lines.push(("writing reports".to_owned(), self.report));
        let all = lines.iter().map(|(_, took)| *took).sum();
        lines.push(("total".to_owned(), all));

        let mut table = String::from("  where the time went                 ms\n");
        for (name, took) in lines {
            let millis = took.as_secs_f64() * 1e3;
            writeln!(table, "  {name:<30}{millis:>8.1}").expect("writing to a string cannot fail");
        }
        table
    }
}

#[cfg(test)]
mod tests {
    use judging::assignment::RAYS;

    use super::*;

    #[test]
    fn table_has_a_line_per_stage_and_a_total() {
        let asking = RAYS.tasks().map(|task| (task, Duration::from_micros(1500)));
        let stages = StageTimes {
            build: Duration::from_millis(400),
            asking: asking.collect(),
            ..StageTimes::default()
        };
        let table = stages.table();
        assert_eq!(table.lines().count(), 1 + 3 + RAYS.tasks.len() + 2 + 1);
        let bbox = "answering: bbox                    1.5\n";
        assert!(table.contains(bbox), "{table}");
        let total = 400.0 + 1.5 * RAYS.tasks.len() as f64;
        let total = format!("total                            {total:.1}\n");
        assert!(table.ends_with(&total), "{table}");
    }
}
