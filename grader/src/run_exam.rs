//! Runs an exam item by item. A failure in one item does not affect the next.

use std::collections::BTreeSet;
use std::io;
use std::time::Instant;

use judging::assignment::{Task, TaskInfo};
use judging::exam::{Exam, Item};
use judging::recognise::Observations;
use protocol::Answer;

use crate::build::{Build, SubstitutedProgram};
use crate::handed_out::HandedOut;
use crate::item_outcome::{ItemOutcome, NotRun};
use crate::probe::{Allowance, Budget};
use crate::report_answers::ReportAnswers;
use crate::score::{ItemScore, Score, Verdict, VerdictKind};
use crate::task_session::{TaskSession, TimeSpent};
use crate::verdict::{
    add_clue, add_hints, blocked_score, blocking_item, item_score, substituted_score,
};

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
    let mut allowance = Allowance::new(budget);
    let mut stopped = BTreeSet::new();
    for task in build.handed_out.assignment.tasks() {
        let items: Vec<&Item> = exam.items.iter().filter(|item| item.task == task).collect();
        // One process per task, so that a task cannot affect the next one.
        let mut sessions = TaskSessions::new(build);
        for item in items {
            let (line, answers) = sessions.grade_item(item, score, &stopped, &mut allowance)?;
            report_answers.record(item, &line, answers);
            score.record(line);
            score.update_totals();
            progress(score, &report_answers)?;
        }
        if sessions.own.is_stopped() {
            stopped.insert(task);
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
    own: TaskSession<'a>,
    /// Whether the submission's own program had a fault in an item that depends on a failed one.
    has_blocked_fault: bool,
    substituted: Option<TaskSession<'a>>,
}

impl<'a> TaskSessions<'a> {
    fn new(build: &'a Build) -> Self {
        TaskSessions {
            build,
            own: TaskSession::new(build, build.probe.as_deref()),
            has_blocked_fault: false,
            substituted: None,
        }
    }

    /// Grades one item and returns its score and answers. The items that it depends on must already
    /// be graded. `stopped` are the tasks that did not come to their end.
    fn grade_item(
        &mut self,
        item: &Item,
        others: &Score,
        stopped: &BTreeSet<Task>,
        allowance: &mut Allowance,
    ) -> io::Result<(ItemScore, Vec<Answer>)> {
        let handed_out = self.build.handed_out;
        let file = handed_out.assignment.info(item.task).file;
        if let Some(why) = self.build.not_compiled.get(file) {
            let outcome = ItemOutcome::NotCompiled(why);
            return Ok((item_score(item, &outcome, handed_out), Vec::new()));
        }
        let blocking = blocking_item(item, others);
        // What made that task stop, or another item that depends on it, would make this item stop,
        // too.
        let is_hopeless = blocking
            .is_some_and(|blocking| stopped.contains(&blocking.task) || self.has_blocked_fault);
        let (outcome, answers) = if is_hopeless {
            (ItemOutcome::NotRun(NotRun::NeedsStoppedTask), Vec::new())
        } else {
            self.own.ask(item, allowance)?
        };
        match blocking {
            Some(_) => self.has_blocked_fault |= matches!(outcome, ItemOutcome::Fault { .. }),
            None => self.own.count_fault(&outcome),
        }
        let line = item_score(item, &outcome, handed_out);
        let Some(by) = blocking.map(|blocking| blocking.id) else {
            return Ok((line, answers));
        };
        match self.build.substituted_program(file)? {
            SubstitutedProgram::NoReference => Ok((blocked_score(by, line), answers)),
            SubstitutedProgram::NotCompiled if is_hopeless => {
                Ok((blocked_score(by, line), answers))
            }
            SubstitutedProgram::NotCompiled => Ok((line, answers)),
            SubstitutedProgram::Program(program) => {
                let substituted = self
                    .substituted
                    .get_or_insert_with(|| TaskSession::new(self.build, Some(program)));
                let (outcome, answers) = substituted.ask(item, allowance)?;
                substituted.count_fault(&outcome);
                let substituted_item = item_score(item, &outcome, handed_out);
                Ok((substituted_score(by, &line, substituted_item), answers))
            }
        }
    }

    /// Returns the time spent by both processes.
    fn spent(&self) -> TimeSpent {
        let substituted = self.substituted.as_ref().map(TaskSession::spent);
        self.own.spent() + substituted.unwrap_or_default()
    }

    /// Adds hints, which need the answers to the whole task, and returns what the submission
    /// printed.
    fn finish(mut self, exam: &Exam, lines: &mut [ItemScore]) -> Option<String> {
        let substituted = self.substituted.as_ref().map(TaskSession::observations);
        let own = self.own.observations();
        explain_items(exam, lines, own, substituted, self.build.handed_out);
        self.own.printed()
    }
}

/// Adds the hints for the mistakes that explain a task's answers: those of the submission's own
/// program, and those of the program with substituted parts. Where no mistake does, and not one ray hits
/// anything, adds the clue for that.
fn explain_items(
    exam: &Exam,
    lines: &mut [ItemScore],
    own: &Observations,
    substituted: Option<&Observations>,
    handed_out: &HandedOut,
) {
    for line in lines.iter_mut().filter(|line| can_have_hint(&line.verdict)) {
        let observations = match substituted {
            Some(substituted) if line.carried_forward => substituted,
            Some(_) | None => own,
        };
        if let Some(item) = exam.items.iter().find(|item| item.id == line.id) {
            add_hints(line, &observations.explain(exam, item));
            let info = handed_out.assignment.info(item.task);
            let of_task = exam.items.iter().filter(|other| other.task == item.task);
            if has_whole_task(exam, info) && observations.misses_everything(of_task) {
                add_clue(line, info.clues.if_nothing_is_hit);
            }
        }
    }
}

/// Returns whether an exam has all items of a task. After a save, the items that failed before are graded
/// first, and rays of the others may hit something.
fn has_whole_task(exam: &Exam, info: &TaskInfo) -> bool {
    let items = exam.items.iter().filter(|item| item.task == info.task());
    items.map(|item| item.points).sum::<u32>() == info.points
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

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use judging::exam::Key;
    use judging::observe::observe;
    use judging::signatures::{KnownMistake, MistakeAnswers};
    use protocol::{ElementOutcome, Interval, Panic};

    use super::*;
    use crate::build::NotCompiled;
    use crate::handed_out::RAYS;
    use crate::score::Hint;
    use crate::small_exam::{boxes, exam, item, pending};

    #[test]
    fn every_item_of_a_submission_that_does_not_compile_is_recorded() {
        let folder = tempfile::tempdir().unwrap();
        let why = NotCompiled::MissingDeclaration("x");
        let files = RAYS.file_names().map(|file| (file, why.clone()));
        let build = Build::without_programs(folder.path(), files.collect());
        let exam = exam(&["sphere.uv", "bbox.flat", "sphere.normal"]);
        let mut score = pending(&exam);
        let mut progress = Vec::new();
        run_exam(&exam, &build, Budget::default(), &mut score, |score, _| {
            let items = score.items();
            let items = items.filter(|item| item.verdict == Verdict::Pending);
            progress.push((items.count(), score.complete));
            io::Result::Ok(())
        })
        .unwrap();
        assert_eq!(progress, [(2, false), (1, false), (0, false), (0, true)]);
        assert!(
            score
                .items()
                .all(|item| item.verdict == Verdict::NotCompiled)
        );
        assert!(score.tasks.iter().all(|task| task.printed.is_none()));
        let asked: Vec<Task> = score
            .timings
            .stages
            .asking
            .iter()
            .map(|(t, _)| *t)
            .collect();
        assert_eq!(asked, RAYS.assignment.tasks().collect::<Vec<_>>());
    }

    #[test]
    fn grading_stops_if_the_progress_cannot_be_written() {
        let folder = tempfile::tempdir().unwrap();
        let build = Build::without_programs(folder.path(), BTreeMap::new());
        let exam = exam(&["sphere.uv", "sphere.normal"]);
        let mut score = pending(&exam);
        let mut calls = 0;
        let stopped = run_exam(&exam, &build, Budget::default(), &mut score, |_, _| {
            calls += 1;
            Err(io::Error::other("the disk is full"))
        });
        assert!(stopped.is_err());
        assert_eq!((calls, score.complete), (1, false));
    }

    #[test]
    fn an_item_is_not_run_if_what_it_depends_on_would_stop_it() {
        let folder = tempfile::tempdir().unwrap();
        let build = Build::without_programs(folder.path(), BTreeMap::new());
        let others = pending(&exam(&["bbox.flat"]));
        let bbox = RAYS.assignment.task_of("bbox.flat").unwrap();
        let mut dependent = item("traverse.root", vec![boxes(1)]);
        dependent.needs = vec!["bbox.flat".to_owned()];
        let verdict = |item: &Item, stopped: &[Task], has_blocked_fault: bool| {
            let mut sessions = TaskSessions::new(&build);
            sessions.has_blocked_fault = has_blocked_fault;
            let stopped = stopped.iter().copied().collect();
            let mut allowance = Allowance::new(Budget::default());
            let graded = sessions.grade_item(item, &others, &stopped, &mut allowance);
            graded.unwrap().0.verdict
        };
        let blocked = Verdict::Blocked {
            by: "bbox.flat".to_owned(),
        };
        assert_eq!(verdict(&dependent, &[bbox], false), blocked);
        assert_eq!(verdict(&dependent, &[], true), blocked);
        // Otherwise, it is asked, here of a submission without a program.
        assert_eq!(verdict(&dependent, &[], false), Verdict::Pending);
        let independent = item("traverse.flat", vec![boxes(1)]);
        assert_eq!(verdict(&independent, &[bbox], true), Verdict::Pending);
    }

    #[test]
    fn hints_come_from_the_answers_that_count() {
        let mut exam = exam(&["bbox.flat", "bbox.behind", "bbox.clipped"]);
        exam.mistakes.push(KnownMistake {
            id: "bbox.swap".to_owned(),
            nudge: String::new(),
            hint: "swapped".to_owned(),
            section: None,
        });
        let spans = |span| [Answer::Spans(vec![ElementOutcome::Value(span); 3])];
        let (right, wrong) = (spans(None), spans(Some(Interval { min: 1.0, max: 2.0 })));
        // The mistake does not affect the third item.
        for item in &mut exam.items[..2] {
            item.questions = vec![boxes(3)];
            item.signatures.elements = (0..3).collect();
            item.signatures.correct_answers = observe(item, &right);
            item.signatures.mistake_answers.push(MistakeAnswers {
                mistakes: vec![0],
                answers: (0..).zip(observe(item, &wrong)).collect(),
            });
        }
        let observations = |answers: &[Answer]| {
            let mut observations = Observations::default();
            for item in &exam.items {
                observations.record(item, Ok(answers));
            }
            observations
        };
        let (right, wrong) = (observations(&right), observations(&wrong));
        // The first item is graded with substituted parts, and the second is not.
        let hinted = |verdict: Verdict, own: &Observations, substituted: Option<&Observations>| {
            let mut lines: Vec<ItemScore> = pending(&exam).items().cloned().collect();
            lines[0].carried_forward = true;
            for line in &mut lines {
                line.verdict = verdict.clone();
            }
            explain_items(&exam, &mut lines, own, substituted, &RAYS);
            assert!(lines[2].hints.is_empty());
            [0, 1].map(|line| lines[line].hints.len())
        };
        assert_eq!(hinted(Verdict::Wrong, &wrong, None), [1, 1]);
        assert_eq!(hinted(Verdict::Wrong, &right, Some(&wrong)), [1, 0]);
        assert_eq!(hinted(Verdict::Wrong, &wrong, Some(&right)), [0, 1]);
        assert_eq!(hinted(Verdict::Pass, &wrong, Some(&wrong)), [0, 0]);
    }

    #[test]
    fn a_clue_says_that_not_one_ray_hits_unless_a_hint_says_more() {
        let mut whole = exam(&["bbox.flat", "bbox.behind", "bbox.clipped", "bbox.slabs"]);
        for (item, points) in whole.items.iter_mut().zip([4, 2, 2, 2]) {
            item.points = points;
            item.questions = vec![boxes(3)];
            item.questions[0].key = Key::Spans {
                spans: vec![Some(Interval::AHEAD); 3],
            };
        }
        let miss = ElementOutcome::Value(None);
        let hit = ElementOutcome::Value(Some(Interval::AHEAD));
        let panicked = ElementOutcome::Panicked(Panic {
            message: "x".to_owned(),
            location: String::new(),
        });
        // Returns the clue in a line, if some items are answered with two misses and `last`.
        let clue_in = |line: &ItemScore, exam: &Exam, answered: usize, last: &ElementOutcome<_>| {
            let mut observations = Observations::default();
            for item in &whole.items[..answered] {
                let spans = vec![miss.clone(), miss.clone(), last.clone()];
                observations.record(item, Ok(&[Answer::Spans(spans)]));
            }
            let mut lines = [line.clone()];
            explain_items(exam, &mut lines, &observations, None, &RAYS);
            lines[0].clue.clone()
        };
        let wrong = ItemScore {
            verdict: Verdict::Wrong,
            ..pending(&whole).items().next().unwrap().clone()
        };
        let bbox = RAYS.assignment.find("bbox").unwrap();
        let clue = bbox.clues.if_nothing_is_hit.map(str::to_owned);
        assert!(clue.is_some());
        assert_eq!(clue_in(&wrong, &whole, 4, &miss), clue);
        assert_eq!(clue_in(&wrong, &whole, 4, &hit), None);
        assert_eq!(clue_in(&wrong, &whole, 4, &panicked), None);
        // What is not answered, or not asked, may be a hit.
        assert_eq!(clue_in(&wrong, &whole, 3, &miss), None);
        let mut some = whole.clone();
        some.items.pop();
        assert_eq!(clue_in(&wrong, &some, 3, &miss), None);

        let timed_out = ItemScore {
            verdict: Verdict::TimedOut,
            ..wrong.clone()
        };
        assert_eq!(clue_in(&timed_out, &whole, 4, &miss), None);
        let with_clue = ItemScore {
            clue: Some("kept".to_owned()),
            ..wrong.clone()
        };
        assert_eq!(clue_in(&with_clue, &whole, 4, &miss), with_clue.clue);
        // A hint of a known mistake says more than the clue.
        let mut hinted = wrong;
        hinted.hints = vec![Hint {
            nudge: String::new(),
            hint: String::new(),
        }];
        add_clue(&mut hinted, clue.as_deref());
        assert_eq!(hinted.clue, None);
    }

    #[test]
    fn hints_are_for_wrong_answers_and_for_a_known_reason_why_there_is_none() {
        for verdict in [
            Verdict::Partial,
            Verdict::Wrong,
            Verdict::Panicked,
            Verdict::TimedOut,
            Verdict::OutOfMemory,
            Verdict::Crashed,
        ] {
            assert!(can_have_hint(&verdict), "{verdict:?}");
        }
        for verdict in [
            Verdict::Pass,
            Verdict::Unimplemented,
            Verdict::Protocol,
            Verdict::NotCompiled,
            Verdict::Blocked {
                by: "bbox.flat".to_owned(),
            },
            Verdict::Pending,
        ] {
            assert!(!can_have_hint(&verdict), "{verdict:?}");
        }
    }
}
