//! Asks a program the items of one task. The task is stopped if the program hangs or crashes too
//! often.

use std::io;
use std::ops::Add;
use std::path::Path;
use std::time::{Duration, Instant};

use judging::exam::Item;
use judging::judge::{Judgement, judge};
use judging::recognise::Observations;
use judging::sanitize::sanitize;
use protocol::Answer;

use crate::alone::{alone, beside_others};
use crate::build::{Build, Control};
use crate::item_outcome::{ItemOutcome, NotRun};
use crate::kept_state::is_right_alone;
use crate::probe::{Allowance, Crash, Culprit, Fault, ItemLimits, Launcher, Probe};

/// Number of time-outs after which a task is stopped.
pub const MAX_TIMEOUTS: usize = 1;
/// Number of other faults after which a task is stopped.
pub const MAX_CRASHES: usize = 2;
/// Maximum length of the stored output of a submission, in characters.
const MAX_PRINTED_CHARS: usize = 1_000;

/// A program that is asked the items of one task. Its process is started for the first item, and
/// again after a fault.
pub struct TaskSession<'a> {
    launcher: Option<Launcher>,
    control: &'a Control,
    probe: Option<Probe>,
    printed: String,
    timeouts: usize,
    crashes: usize,
    /// The fault that stopped the task.
    stopped_by: Option<Fault>,
    observations: Observations,
    spent: TimeSpent,
}

/// Time that a session spent, by activity.
#[derive(Clone, Copy, Debug, Default)]
pub struct TimeSpent {
    /// Starting the program.
    pub start: Duration,
    /// Asking questions.
    pub asking: Duration,
    /// Judging the answers.
    pub judging: Duration,
}

impl Add for TimeSpent {
    type Output = TimeSpent;

    fn add(self, other: TimeSpent) -> TimeSpent {
        TimeSpent {
            start: self.start + other.start,
            asking: self.asking + other.asking,
            judging: self.judging + other.judging,
        }
    }
}

impl<'a> TaskSession<'a> {
    /// Creates a session with one of the programs of a submission, or with none if nothing compiled.
    pub fn new(build: &'a Build, program: Option<&Path>) -> Self {
        TaskSession {
            launcher: program.map(|program| build.launcher(program)),
            control: build.control(),
            probe: None,
            printed: String::new(),
            timeouts: 0,
            crashes: 0,
            stopped_by: None,
            observations: Observations::default(),
            spent: TimeSpent::default(),
        }
    }

    /// Runs one item and returns its outcome and its answers, if there are any. The time that it
    /// takes is deducted from the allowance.
    pub fn ask(
        &mut self,
        item: &Item,
        allowance: &mut Allowance,
    ) -> io::Result<(ItemOutcome<'static>, Vec<Answer>)> {
        let Some(launcher) = self.launcher.clone() else {
            return Ok((ItemOutcome::Pending, Vec::new()));
        };
        if let Some(fault) = &self.stopped_by {
            let stopped = NotRun::TaskStopped(fault.clone());
            return Ok((ItemOutcome::NotRun(stopped), Vec::new()));
        }
        let Some(limits) = allowance.next_item() else {
            return Ok((ItemOutcome::NotRun(NotRun::BudgetUsedUp), Vec::new()));
        };
        let process_cpu = allowance.budget().total_cpu();
        let started_at = Instant::now();
        let probe = match self.probe.take() {
            Some(probe) => probe,
            None => launcher.start(process_cpu)?,
        };
        let ready_at = Instant::now();
        let restart = || launcher.start(process_cpu);
        let (mut probe, answered) = ask_fairly(probe, restart, item, limits, self.control)?;
        let used = probe.take_time_used();
        allowance.spend(used);
        self.spent.start += ready_at - started_at;
        self.spent.asking += ready_at.elapsed();
        let started_at = Instant::now();
        match answered {
            Ok(answers) => {
                self.probe = Some(probe);
                self.observations.record(item, Ok(&answers));
                let judgements = item.questions.iter().zip(&answers);
                let judgements = judgements.map(|(question, answer)| judge(question, answer));
                let judgements: Vec<Judgement> = judgements.collect();
                self.spent.judging += started_at.elapsed();
                let started_at = Instant::now();
                let right_alone = is_right_alone(&launcher, item, &judgements, allowance)?;
                self.spent.asking += started_at.elapsed();
                let outcome = ItemOutcome::Answered {
                    judgements,
                    right_alone,
                };
                if outcome.is_pass() {
                    allowance.passed(used.cpu);
                }
                Ok((outcome, answers))
            }
            Err(fault) => {
                let culprit = Culprit::find(&launcher, item)?;
                allowance.spend(culprit.used);
                self.keep_output(probe);
                self.observations
                    .record(item, Err(fault.no_answer_reason()));
                let outcome = ItemOutcome::Fault {
                    fault,
                    culprit: culprit.position,
                };
                Ok((outcome, Vec::new()))
            }
        }
    }

    /// Counts a fault towards stopping the task, if the outcome is one. Faults that another task
    /// may be the reason for are not counted.
    pub fn count_fault(&mut self, outcome: &ItemOutcome) {
        let ItemOutcome::Fault { fault, .. } = outcome else {
            return;
        };
        let (count, most) = match fault {
            Fault::TimedOut(_) => (&mut self.timeouts, MAX_TIMEOUTS),
            Fault::OutOfMemory | Fault::Crashed(_) | Fault::Protocol(_) => {
                (&mut self.crashes, MAX_CRASHES)
            }
        };
        *count += 1;
        if *count == most {
            self.stopped_by = Some(fault.clone());
        }
    }

    /// Returns whether the task was stopped before all its items were run.
    pub fn is_stopped(&self) -> bool {
        self.stopped_by.is_some()
    }

    /// Returns the answers so far, for recognising mistakes.
    pub fn observations(&self) -> &Observations {
        &self.observations
    }

    /// Returns the time spent.
    pub fn spent(&self) -> TimeSpent {
        self.spent
    }

    /// Ends a probe and keeps what it printed, unless earlier output has already been kept.
    fn keep_output(&mut self, probe: Probe) {
        let output = probe.finish();
        if self.printed.is_empty() {
            self.printed = output;
        }
    }

    /// Ends the program, and returns what it printed, if anything.
    pub fn printed(&mut self) -> Option<String> {
        if let Some(probe) = self.probe.take() {
            self.keep_output(probe);
        }
        let printed = self.printed.trim_end();
        (!printed.is_empty()).then(|| sanitize(printed, MAX_PRINTED_CHARS))
    }
}

/// Asks an item. If the system kills the program, it is asked again by itself; if it is killed once
/// more, but the control is not, the program is the reason.
fn ask_fairly(
    mut probe: Probe,
    restart: impl FnOnce() -> io::Result<Probe>,
    item: &Item,
    limits: ItemLimits,
    control: &Control,
) -> io::Result<(Probe, Result<Vec<Answer>, Fault>)> {
    let questions = item.questions.iter().map(|question| &question.question);
    {
        let _permit = beside_others();
        let answered = probe.ask(questions.clone(), limits);
        if !was_killed(&answered) {
            return Ok((probe, answered));
        }
    }
    {
        let _permit = alone();
        probe = restart()?;
        let answered = probe.ask(questions, limits);
        if !was_killed(&answered) {
            return Ok((probe, answered));
        }
        if control.runs()? {
            return Ok((probe, answered));
        }
    }
    Err(io::Error::other(
        "the system killed the program (signal 9) although it used little memory, and a small \
         program of the grader, too: give this machine more memory, or grade fewer submissions at \
         once",
    ))
}

fn was_killed(answered: &Result<Vec<Answer>, Fault>) -> bool {
    matches!(answered, Err(Fault::Crashed(Crash::Killed)))
}
