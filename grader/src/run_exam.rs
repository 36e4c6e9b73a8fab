//! Runs an exam item by item. A failure in one item does not affect the next.

use std::io;
use std::path::Path;
use std::time::{Duration, Instant};

use judging::exam::{Exam, Item};
use judging::judge::judge;
use judging::recognise::Observations;
use judging::sanitize::sanitize;
use protocol::Answer;

use crate::build::{Build, SubstitutedProgram};
use crate::probe::{Budget, Crash, Fault, Launcher, Probe, TimeLimit, culprit};
use crate::report_answers::ReportAnswers;
use crate::score::{ItemScore, Score, Verdict, VerdictKind};
use crate::verdict::{
    ItemOutcome, add_hints, blocked_score, blocking_item, item_score, substituted_score,
};

/// Maximum number of time-outs in a task. Once it is reached, the task's remaining items are
/// skipped.
const MAX_TIMEOUTS: usize = 2;
/// Maximum length of the stored output of a submission, in characters.
const MAX_PRINTED_CHARS: usize = 1_000;

/// Grades every item of `exam` and records its score. After each item, `progress` is called with
/// the score and the answers to draw. If `progress` returns an error, grading stops.
pub fn run_exam<E: From<io::Error>>(
    exam: &Exam,
    build: &Build,
    budget: Budget,
    score: &mut Score,
    mut progress: impl FnMut(&mut Score, &ReportAnswers) -> Result<(), E>,
) -> Result<(), E> {
    let mut report_answers = ReportAnswers::default();
    for task in build.handed_out.assignment.tasks() {
        let items: Vec<&Item> = exam.items.iter().filter(|item| item.task == task).collect();
        // One process per task, so that a task cannot affect the next one.
        let mut sessions = TaskSessions::new(build, budget);
        for item in items {
            let (line, answers) = sessions.grade_item(item, score)?;
            report_answers.record(item, &line, answers);
            score.record(line);
            score.update_totals();
            progress(score, &report_answers)?;
        }
        let spent = sessions.spent();
        score.timings.stages.asking.push((task, spent.asking));
        if let Some(scores) = score.tasks.iter_mut().find(|scores| scores.id == task) {
            let started_at = Instant::now();
            scores.printed = sessions.finish(exam, &mut scores.items);
            let stages = &mut score.timings.stages;
            stages.start += spent.start;
            stages.judging += spent.judging + started_at.elapsed();
        }
    }
    score.complete = true;
    progress(score, &report_answers)
}

/// The processes of one task: the submission's own program and, if needed, the one with substituted
/// parts.
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

    /// Grades one item and returns its score and answers. The items that it depends on must already
    /// be graded.
    fn grade_item(&mut self, item: &Item, others: &Score) -> io::Result<(ItemScore, Vec<Answer>)> {
        let handed_out = self.build.handed_out;
        let file = handed_out.assignment.info(item.task).file;
        if let Some(why) = self.build.not_compiled.get(file) {
            let outcome = ItemOutcome::NotCompiled(why);
            return Ok((item_score(item, &outcome, handed_out), Vec::new()));
        }
        let (outcome, answers) = self.own.ask(item)?;
        let line = item_score(item, &outcome, handed_out);
        let Some(by) = blocking_item(item, others) else {
            return Ok((line, answers));
        };
        match self.build.substituted_program(file)? {
            SubstitutedProgram::NoReference => Ok((blocked_score(by, line), answers)),
            SubstitutedProgram::NotCompiled => Ok((line, answers)),
            SubstitutedProgram::Program(program) => {
                let budget = self.own.budget;
                let substituted = self
                    .substituted
                    .get_or_insert_with(|| Session::new(self.build, Some(program), budget));
                let (outcome, answers) = substituted.ask(item)?;
                let substituted_item = item_score(item, &outcome, handed_out);
                Ok((substituted_score(by, &line, substituted_item), answers))
            }
        }
    }

    /// Returns the time spent by both processes.
    fn spent(&self) -> TimeSpent {
        let substituted = self.substituted.as_ref().map(|session| session.spent);
        let (own, substituted) = (self.own.spent, substituted.unwrap_or_default());
        TimeSpent {
            start: own.start + substituted.start,
            asking: own.asking + substituted.asking,
            judging: own.judging + substituted.judging,
        }
    }

    /// Adds hints, which need the answers to the whole task, and returns what the submission
    /// printed.
    fn finish(mut self, exam: &Exam, lines: &mut [ItemScore]) -> Option<String> {
        for line in lines
            .iter_mut()
            .filter(|line| line.points < line.max_points)
        {
            let session = match (&self.substituted, line.carried_forward) {
                (Some(substituted), true) => substituted,
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

/// Returns whether a hint is possible: there is a wrong answer, or a known reason why there is no
/// answer.
fn can_have_hint(verdict: &Verdict) -> bool {
    match verdict.kind() {
        VerdictKind::Failed => true,
        // Invalid answers say nothing about the mistake.
        VerdictKind::NoAnswer => *verdict != Verdict::Protocol,
        VerdictKind::Passed
        | VerdictKind::Unwritten
        | VerdictKind::NotCompiled
        | VerdictKind::Blocked
        | VerdictKind::Pending => false,
    }
}

fn was_killed(answered: &Result<Vec<Answer>, Fault>) -> bool {
    matches!(answered, Err(Fault::Crashed(Crash::Killed)))
}

/// A process for one task. It is started for the first item, and again after a fault.
struct Session {
    launcher: Option<Launcher>,
    budget: Budget,
    probe: Option<Probe>,
    printed: String,
    out_of_time: usize,
    observations: Observations,
    spent: TimeSpent,
}

/// Time that a session spent, by activity.
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

    /// Runs one item and returns its outcome and its answers, if there are any.
    fn ask(&mut self, item: &Item) -> io::Result<(ItemOutcome<'static>, Vec<Answer>)> {
        let Some(launcher) = &self.launcher else {
            return Ok((ItemOutcome::Pending, Vec::new()));
        };
        if self.out_of_time == MAX_TIMEOUTS {
            let fault = Fault::TimedOut(TimeLimit::Cpu(self.budget.cpu));
            return Ok((ItemOutcome::Skipped(fault), Vec::new()));
        }
        let started_at = Instant::now();
        let mut probe = match self.probe.take() {
            Some(probe) => probe,
            None => launcher.start(self.budget)?,
        };
        let ready_at = Instant::now();
        let questions = item.questions.iter().map(|question| &question.question);
        let mut answered = probe.ask(questions.clone(), self.budget);
        if was_killed(&answered) {
            // The system killed the probe, which is not the submission's fault. Try once more,
            // since there may be enough memory by now.
            probe = launcher.start(self.budget)?;
            answered = probe.ask(questions, self.budget);
        }
        self.spent.start += ready_at - started_at;
        self.spent.asking += ready_at.elapsed();
        let started_at = Instant::now();
        match answered {
            Ok(answers) => {
                self.probe = Some(probe);
                self.observations.record(item, Ok(&answers));
                let judgements = item.questions.iter().zip(&answers);
                let judgements = judgements.map(|(question, answer)| judge(question, answer));
                let outcome = ItemOutcome::Answered(judgements.collect());
                self.spent.judging += started_at.elapsed();
                Ok((outcome, answers))
            }
            Err(fault @ Fault::Crashed(Crash::Killed)) => Err(io::Error::other(fault.to_string())),
            Err(fault) => {
                self.out_of_time += usize::from(matches!(fault, Fault::TimedOut(_)));
                let element = culprit(launcher, item)?;
                self.keep_output(probe);
                self.observations
                    .record(item, Err(fault.no_answer_reason()));
                Ok((
                    ItemOutcome::Fault {
                        fault,
                        culprit: element,
                    },
                    Vec::new(),
                ))
            }
        }
    }

    /// Ends a probe and keeps what it printed, unless earlier output has already been kept.
    fn keep_output(&mut self, probe: Probe) {
        let output = probe.finish();
        if self.printed.is_empty() {
            self.printed = output;
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
