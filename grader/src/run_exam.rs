//! Asking a whole exam, item by item. Whatever happens in one item, the next is asked.

use std::io;
use std::path::Path;
use std::time::{Duration, Instant};

use protocol::Answer;

use crate::build::{Build, SubstitutedProgram};
use crate::exam::{Exam, Item, Task};
use crate::judge::judge;
use crate::probe::{Budget, Crash, Fault, Launcher, Probe, TimeLimit, culprit};
use crate::recognise::Observations;
use crate::report_answers::ReportAnswers;
use crate::sanitize::sanitize;
use crate::score::{ItemScore, Score, Verdict};
use crate::verdict::{
    ItemOutcome, add_hints, blocked_score, blocking_item, item_score, substituted_score,
};

/// After so many items of a task have run out of time, its others are not asked.
const MAX_TIMEOUTS: usize = 2;
/// The most characters that are kept of what a submission prints.
const MAX_PRINTED_CHARS: usize = 1_000;

/// Asks every item of `exam` and notes its score, which is shown to `progress` after each, with
/// the answers that are worth a look; if that is an error, nothing more is asked.
pub fn run_exam<E: From<io::Error>>(
    exam: &Exam,
    build: &Build,
    budget: Budget,
    score: &mut Score,
    mut progress: impl FnMut(&mut Score, &ReportAnswers) -> Result<(), E>,
) -> Result<(), E> {
    let mut exhibits = ReportAnswers::default();
    for (number, task) in Task::ALL.into_iter().enumerate() {
        let items: Vec<&Item> = exam.items.iter().filter(|item| item.task == task).collect();
        // A process for each task: what one leaves behind can not help or harm another.
        let mut sessions = TaskSessions::new(build, budget);
        for item in items {
            let (line, answers) = sessions.grade_item(item, score)?;
            exhibits.record(item, &line, answers);
            score.record(line);
            score.update_totals();
            progress(score, &exhibits)?;
        }
        if let Some(scores) = score.tasks.iter_mut().find(|scores| scores.id == task) {
            let spent = sessions.spent();
            let began = Instant::now();
            scores.printed = sessions.finish(exam, &mut scores.items);
            let stages = &mut score.timings.stages;
            stages.start += spent.start;
            stages.asking[number] += spent.asking;
            stages.judging += spent.judging + began.elapsed();
        }
    }
    score.complete = true;
    progress(score, &exhibits)
}

/// One task, asked of the submission by itself, and where needed carried forward.
struct TaskSessions<'a> {
    build: &'a Build,
    own: Session,
    substituted: Option<Session>,
}

impl<'a> TaskSessions<'a> {
    fn new(build: &'a Build, budget: Budget) -> Self {
        TaskSessions {
            build,
            own: Session::new(build, build.probe.as_deref(), budget),
            substituted: None,
        }
    }

    /// What becomes of one item, after those that it needs, and the answers that say so.
    fn grade_item(&mut self, item: &Item, others: &Score) -> io::Result<(ItemScore, Vec<Answer>)> {
        if let Some(why) = self.build.not_compiled.get(item.task.file()) {
            return Ok((item_score(item, &ItemOutcome::NotCompiled(why)), Vec::new()));
        }
        let (outcome, answers) = self.own.ask(item)?;
        let line = item_score(item, &outcome);
        let Some(by) = blocking_item(item, others) else {
            return Ok((line, answers));
        };
        match self.build.substituted_program()? {
            SubstitutedProgram::NoReference => Ok((blocked_score(by, line), answers)),
            SubstitutedProgram::NotCompiled => Ok((line, answers)),
            SubstitutedProgram::Program(program) => {
                let budget = self.own.budget;
                let carried = self
                    .substituted
                    .get_or_insert_with(|| Session::new(self.build, Some(program), budget));
                let (outcome, answers) = carried.ask(item)?;
                let again = item_score(item, &outcome);
                Ok((substituted_score(by, &line, again), answers))
            }
        }
    }

    /// Where the time went, of both.
    fn spent(&self) -> TimeSpent {
        let carried = self.substituted.as_ref().map(|session| session.spent);
        let (own, carried) = (self.own.spent, carried.unwrap_or_default());
        TimeSpent {
            start: own.start + carried.start,
            asking: own.asking + carried.asking,
            judging: own.judging + carried.judging,
        }
    }

    /// Gives the hints that only show once the whole task was asked; returns what was printed.
    fn finish(mut self, exam: &Exam, lines: &mut [ItemScore]) -> Option<String> {
        for line in lines
            .iter_mut()
            .filter(|line| line.points < line.max_points)
        {
            let session = match (&self.substituted, line.carried_forward) {
                (Some(carried), true) => carried,
                (Some(_) | None, _) => &self.own,
            };
            let item = exam.items.iter().find(|item| item.id == line.id);
            let known = item.filter(|_| can_have_hint(&line.verdict));
            let known = known.map(|item| session.observations.explain(exam, item));
            add_hints(line, &known.unwrap_or_default());
        }
        self.own.printed()
    }
}

/// Whether there is an answer to be wondered about, or a reason why there is none.
fn can_have_hint(verdict: &Verdict) -> bool {
    match verdict {
        Verdict::Partial
        | Verdict::Wrong
        | Verdict::Panicked
        | Verdict::TimedOut
        | Verdict::OutOfMemory
        | Verdict::Crashed => true,
        Verdict::Pass
        | Verdict::Unimplemented
        | Verdict::Protocol
        | Verdict::NotCompiled
        | Verdict::Blocked { .. }
        | Verdict::Pending => false,
    }
}

fn was_killed(answered: &Result<Vec<Answer>, Fault>) -> bool {
    matches!(answered, Err(Fault::Crashed(Crash::Killed)))
}

/// One task's process, started when there is something to ask and again after a fault.
struct Session {
    launcher: Option<Launcher>,
    budget: Budget,
    probe: Option<Probe>,
    printed: String,
    out_of_time: usize,
    observations: Observations,
    spent: TimeSpent,
}

/// Where one session's time went.
#[derive(Clone, Copy, Debug, Default)]
struct TimeSpent {
    start: Duration,
    asking: Duration,
    judging: Duration,
}

impl Session {
    fn new(build: &Build, program: Option<&Path>, budget: Budget) -> Self {
        Session {
            launcher: program.map(|program| build.launcher(program)),
            budget,
            probe: None,
            printed: String::new(),
            out_of_time: 0,
            observations: Observations::default(),
            spent: TimeSpent::default(),
        }
    }

    /// What becomes of one item, and the answers, if there are any.
    fn ask(&mut self, item: &Item) -> io::Result<(ItemOutcome<'static>, Vec<Answer>)> {
        let Some(launcher) = &self.launcher else {
            return Ok((ItemOutcome::Pending, Vec::new()));
        };
        if self.out_of_time == MAX_TIMEOUTS {
            let fault = Fault::TimedOut(TimeLimit::Cpu(self.budget.cpu));
            return Ok((ItemOutcome::Skipped(fault), Vec::new()));
        }
        let began = Instant::now();
        let mut probe = match self.probe.take() {
            Some(probe) => probe,
            None => launcher.start(self.budget)?,
        };
        let started = Instant::now();
        let questions = item.questions.iter().map(|asked| &asked.question);
        let mut answered = probe.ask(questions.clone(), self.budget);
        if was_killed(&answered) {
            // Nothing that a submission does. What the system lacks, it may have by now.
            probe = launcher.start(self.budget)?;
            answered = probe.ask(questions, self.budget);
        }
        self.spent.start += started - began;
        self.spent.asking += started.elapsed();
        let began = Instant::now();
        match answered {
            Ok(answers) => {
                self.probe = Some(probe);
                self.observations.record(item, Ok(&answers));
                let judged = item.questions.iter().zip(&answers);
                let judged = judged.map(|(asked, answer)| judge(asked, answer));
                let outcome = ItemOutcome::Answered(judged.collect());
                self.spent.judging += began.elapsed();
                Ok((outcome, answers))
            }
            Err(fault @ Fault::Crashed(Crash::Killed)) => Err(io::Error::other(fault.to_string())),
            Err(fault) => {
                self.out_of_time += usize::from(matches!(fault, Fault::TimedOut(_)));
                let place = culprit(launcher, item)?;
                self.keep_output(probe);
                self.observations
                    .record(item, Err(fault.no_answer_reason()));
                Ok((
                    ItemOutcome::Fault {
                        fault,
                        culprit: place,
                    },
                    Vec::new(),
                ))
            }
        }
    }

    /// Ends a probe and keeps the beginning of what it has printed.
    fn keep_output(&mut self, probe: Probe) {
        let words = probe.finish();
        if self.printed.is_empty() {
            self.printed = words;
        }
    }

    fn printed(&mut self) -> Option<String> {
        if let Some(probe) = self.probe.take() {
            self.keep_output(probe);
        }
        let printed = self.printed.trim_end();
        (!printed.is_empty()).then(|| sanitize(printed, MAX_PRINTED_CHARS))
    }
}
