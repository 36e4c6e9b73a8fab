//! Has a program run the items of one task and stops the task if the program hangs or crashes too
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

use crate::build::Build;
use crate::machine::run_permit::decide;
use crate::probe::{Allowance, Crash, Culprit, Fault, ItemLimits, Launcher, Probe, TimeUsed};
use crate::run_exam::leaked_state::is_right_alone;
use crate::verdict::item_outcome::{ItemOutcome, NotRunReason};

/// Number of time-outs after which a task is stopped.
pub const MAX_TIMEOUTS: usize = 1;
/// Number of other faults after which a task is stopped.
pub const MAX_CRASHES: usize = 2;
/// Maximum length of the stored output of a submission, in characters.
const MAX_PRINTED_CHARS: usize = 1_000;

/// A program that runs the items of one task. Its process is started for the first item and
/// restarted after a fault.
pub struct TaskSession<'a> {
    build: &'a Build,
    launcher: Option<Launcher>,
    probe: Option<Probe>,
    printed: String,
    timeouts: usize,
    crashes: usize,
    /// The fault that stopped the task.
    stopped_by: Option<Fault>,
    observations: Observations,
    spent: TimeSpent,
}

/// Time spent in a session, by activity.
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

/// The answers to an item, or the fault, together with the process that ran the item.
struct ItemRun {
    probe: Probe,
    answered: Result<Vec<Answer>, Fault>,
    used: TimeUsed,
}

impl<'a> TaskSession<'a> {
    /// Creates a session for one of a submission's programs, or without a program if nothing
    /// compiled.
    pub fn new(build: &'a Build, program: Option<&Path>) -> Self {
        TaskSession {
            build,
            launcher: program.map(|program| build.launcher(program)),
            probe: None,
            printed: String::new(),
            timeouts: 0,
            crashes: 0,
            stopped_by: program
                .filter(|program| build.is_unstartable(program))
                .map(|_| Fault::Crashed(Crash::NotStarted)),
            observations: Observations::default(),
            spent: TimeSpent::default(),
        }
    }

    /// Runs one item. Returns its outcome and its answers, if any. The time this takes is deducted
    /// from the allowance. If the item depends on a failed item of another task, wrong answers say
    /// nothing about the mistakes in this task.
    pub fn ask(
        &mut self,
        item: &Item,
        depends_on_failed: bool,
        allowance: &mut Allowance,
    ) -> io::Result<(ItemOutcome<'static>, Vec<Answer>)> {
        let Some(launcher) = self.launcher.clone() else {
            return Ok((ItemOutcome::Pending, Vec::new()));
        };
        if let Some(fault) = &self.stopped_by {
            let stopped = NotRunReason::TaskStopped(fault.clone());
            return Ok((ItemOutcome::NotRun(stopped), Vec::new()));
        }
        let Some(limits) = allowance.next_item() else {
            return Ok((ItemOutcome::NotRun(NotRunReason::BudgetUsedUp), Vec::new()));
        };
        let asked = self.ask_fairly(&launcher, item, limits, allowance.budget().total_cpu())?;
        let ItemRun {
            probe,
            answered,
            used,
        } = asked;
        allowance.spend(used);
        let started_at = Instant::now();
        match answered {
            Ok(answers) => {
                self.probe = Some(probe);
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
                if outcome.is_pass() || !depends_on_failed {
                    self.observations.record(item, Ok(&answers));
                }
                Ok((outcome, answers))
            }
            Err(fault @ Fault::Crashed(Crash::NotStarted)) => {
                self.keep_output(probe);
                self.stopped_by = Some(fault.clone());
                let outcome = ItemOutcome::Fault {
                    fault,
                    culprit: None,
                };
                Ok((outcome, Vec::new()))
            }
            Err(fault) => {
                let culprit = Culprit::find(&launcher, item)?;
                allowance.spend(culprit.used);
                self.keep_output(probe);
                if !depends_on_failed {
                    self.observations
                        .record(item, Err(fault.no_answer_reason()));
                }
                let outcome = ItemOutcome::Fault {
                    fault,
                    culprit: culprit.position,
                };
                Ok((outcome, Vec::new()))
            }
        }
    }

    /// Runs an item. If the machine may have caused a fault, the item is rerun while nothing else
    /// runs. If the fault occurs again, but not in the control program, the submission is to blame.
    /// `cpu` is the CPU time limit of a process.
    fn ask_fairly(
        &mut self,
        launcher: &Launcher,
        item: &Item,
        limits: ItemLimits,
        cpu: Duration,
    ) -> io::Result<ItemRun> {
        let build = self.build;
        let mut running = self.probe.take();
        let spent = &mut self.spent;
        let mut used = TimeUsed::default();
        let attempt = || {
            let started_at = Instant::now();
            let mut probe = match running.take() {
                Some(probe) => probe,
                None => launcher.start(cpu)?,
            };
            spent.start += started_at.elapsed();
            let started_at = Instant::now();
            let questions = item.questions.iter().map(|question| &question.question);
            let answered = probe.ask(questions, limits);
            spent.asking += started_at.elapsed();
            used += probe.take_time_used();
            Ok((probe, answered))
        };
        let (probe, answered) = decide(
            attempt,
            |(_, answered)| answered.as_ref().is_err_and(Fault::is_doubtful),
            |(_, answered)| match answered {
                Err(Fault::Crashed(Crash::NotStarted)) => build.check_start(&launcher.program, cpu),
                Ok(_) | Err(_) => build.check_run(),
            },
        )?;
        Ok(ItemRun {
            probe,
            answered,
            used,
        })
    }

    /// If the outcome is a fault, counts it towards the number of faults after which the task is
    /// stopped. Faults that another task may have caused aren't counted.
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

    /// Returns the observations about the answers, which are used to recognise mistakes.
    pub fn into_observations(self) -> Observations {
        self.observations
    }

    /// Returns the time spent.
    pub fn spent(&self) -> TimeSpent {
        self.spent
    }

    /// Ends a probe and keeps its output, unless earlier output has already been kept.
    fn keep_output(&mut self, probe: Probe) {
        let output = probe.finish();
        if self.printed.is_empty() {
            self.printed = output;
        }
    }

    /// Ends the program. Returns its output, if any.
    pub fn printed(&mut self) -> Option<String> {
        if let Some(probe) = self.probe.take() {
            self.keep_output(probe);
        }
        let printed = self.printed.trim_end();
        (!printed.is_empty()).then(|| sanitize(printed, MAX_PRINTED_CHARS))
    }
}
