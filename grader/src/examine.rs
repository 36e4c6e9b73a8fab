//! Asking a whole exam, item by item. Whatever happens in one item, the next is asked.

use std::io;

use crate::ask::{Budget, Budgeted, Fault, Launcher, Probe};
use crate::build::Build;
use crate::exam::{Exam, Item, Task};
use crate::judge::judge;
use crate::score::Score;
use crate::tame::tame;
use crate::verdict::{Outcome, block, item_score};

/// After so many items of a task have run out of time, its others are not asked.
const PATIENCE: usize = 2;
/// The most characters that are kept of what a submission prints.
const LONGEST_PRINT: usize = 1_000;

/// Asks every item of `exam` and notes its score, which is shown to `progress` after each.
pub fn examine<E: From<io::Error>>(
    exam: &Exam,
    build: &Build,
    budget: Budget,
    score: &mut Score,
    mut progress: impl FnMut(&Score) -> Result<(), E>,
) -> Result<(), E> {
    for task in Task::ALL {
        let items: Vec<&Item> = exam.items.iter().filter(|item| item.task == task).collect();
        // A process for each task: what one leaves behind can not help or harm another.
        let mut session = Session::new(build, budget);
        for item in items {
            let outcome = match build.not_compiled.get(task.file()) {
                Some(why) => Outcome::NotCompiled(why),
                None => session.ask(item)?,
            };
            let mut line = item_score(item, &outcome);
            block(item, score, &mut line);
            score.record(line);
            score.total();
            progress(score)?;
        }
        if let Some(scores) = score.tasks.iter_mut().find(|scores| scores.id == task) {
            scores.printed = session.printed();
        }
    }
    score.complete = true;
    progress(score)
}

/// One task's process, started when there is something to ask and again after a fault.
struct Session {
    launcher: Option<Launcher>,
    budget: Budget,
    probe: Option<Probe>,
    printed: String,
    out_of_time: usize,
}

impl Session {
    fn new(build: &Build, budget: Budget) -> Self {
        Session {
            launcher: build.probe.clone().map(|program| Launcher { program }),
            budget,
            probe: None,
            printed: String::new(),
            out_of_time: 0,
        }
    }

    fn ask(&mut self, item: &Item) -> io::Result<Outcome<'static>> {
        let Some(launcher) = &self.launcher else {
            return Ok(Outcome::Pending);
        };
        if self.out_of_time == PATIENCE {
            return Ok(Outcome::GivenUp(Fault::TimedOut(Budgeted::Cpu(
                self.budget.cpu,
            ))));
        }
        let mut probe = match self.probe.take() {
            Some(probe) => probe,
            None => launcher.start(self.budget)?,
        };
        let questions = item.questions.iter().map(|asked| &asked.question);
        match probe.ask(questions, self.budget) {
            Ok(answers) => {
                self.probe = Some(probe);
                let judged = item.questions.iter().zip(&answers);
                Ok(Outcome::Answered(
                    judged.map(|(asked, answer)| judge(asked, answer)).collect(),
                ))
            }
            Err(fault) => {
                self.out_of_time += usize::from(matches!(fault, Fault::TimedOut(_)));
                self.hear(probe);
                Ok(Outcome::Fault(fault))
            }
        }
    }

    /// Ends a probe and keeps the beginning of what it has printed.
    fn hear(&mut self, probe: Probe) {
        let words = probe.finish();
        if self.printed.is_empty() {
            self.printed = words;
        }
    }

    fn printed(mut self) -> Option<String> {
        if let Some(probe) = self.probe.take() {
            self.hear(probe);
        }
        let printed = self.printed.trim_end();
        (!printed.is_empty()).then(|| tame(printed, LONGEST_PRINT))
    }
}
