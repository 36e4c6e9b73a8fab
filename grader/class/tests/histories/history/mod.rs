//! A random history of a course, and the checks after each step.

mod merging;

use std::collections::BTreeMap;
use std::fs;

use class::grade::Completion;
use class::shard::Shard;
use fastrand::Rng;
use tempfile::TempDir;

use crate::comparison::{EXPORT, FreshRuns};
use crate::faulty_disk::{DiskFault, Operations};
use crate::model::Model;
use crate::observed::{ScoreId, all_files, observe};
use crate::recorded_grader::{EXAMS, ProcessFault};
use crate::world::{Ended, MANUAL_POINTS, PARTS, POLICIES, STUDENTS, Target, World};

/// The maximum number of steps.
const MAX_STEPS: usize = 14;

/// A history in progress.
struct History {
    rng: Rng,
    world: World,
    models: BTreeMap<Target, Model>,
    fresh: FreshRuns,
    next_version: u32,
    /// For each target, the operation counts of the last run without a fault.
    operations: BTreeMap<Target, Operations>,
    log: Vec<String>,
}

/// Runs the history with this seed. The error says what went wrong and after which steps.
pub fn run(seed: u64) -> Result<(), String> {
    let folder = TempDir::new().map_err(|error| error.to_string())?;
    let mut history = History {
        rng: Rng::with_seed(seed),
        world: World::new(folder.path()),
        models: BTreeMap::new(),
        fresh: FreshRuns::default(),
        next_version: 1,
        operations: BTreeMap::new(),
        log: Vec::new(),
    };
    let run = history.run();
    run.map_err(|what| format!("{what}\nafter:\n  {}", history.log.join("\n  ")))
}

impl History {
    fn run(&mut self) -> Result<(), String> {
        for _ in 0..3 {
            self.submit();
        }
        for _ in 0..self.rng.usize(3..=MAX_STEPS) {
            self.step()?;
        }
        self.end()
    }

    fn step(&mut self) -> Result<(), String> {
        match self.rng.u32(0..20) {
            0..=7 => self.grade(Target::Whole),
            8..=9 => {
                let part = self.rng.usize(1..=PARTS);
                self.grade(Target::Part(part))
            }
            10..=11 => self.grade_parts_and_merge(),
            12 => self.merge(),
            13..=15 => {
                self.submit();
                Ok(())
            }
            kind => {
                let text = self.change(kind);
                self.log.push(text);
                Ok(())
            }
        }
    }

    /// Changes the course. Returns a description of the change.
    fn change(&mut self, kind: u32) -> String {
        let world = &mut self.world;
        match kind {
            16 => {
                let student = *self.rng.choice(&STUDENTS).unwrap();
                world.withdraw(student);
                format!("{student} leaves")
            }
            17 => {
                world.exam = self.rng.usize(0..EXAMS);
                format!("the exam is number {}", world.exam)
            }
            18 if self.rng.bool() => {
                world.manual = self.rng.usize(0..MANUAL_POINTS.len());
                format!("the points by hand are number {}", world.manual)
            }
            18 => {
                world.policy = self.rng.usize(0..POLICIES.len());
                format!("the policy is number {}", world.policy)
            }
            _ => {
                let days = self.rng.i64(-9_000..9_000);
                world.jump_clock(days);
                format!("the clock jumps by {days} days")
            }
        }
    }

    /// Grades all shards, as if on several machines, while the class may change. Then merges the
    /// shards.
    fn grade_parts_and_merge(&mut self) -> Result<(), String> {
        for part in 1..=PARTS {
            if self.rng.u32(0..4) == 0 {
                self.submit();
            }
            let process = self.process_fault();
            self.grade_with(Target::Part(part), false, true, DiskFault::None, process)?;
        }
        self.merge()
    }

    fn submit(&mut self) {
        let student = *self.rng.choice(&STUDENTS).unwrap();
        let version = (self.rng.u32(0..3) > 0).then_some(self.next_version);
        self.next_version += 1;
        self.log.push(format!("{student} submits {version:?}"));
        self.world.submit(student, version);
    }

    fn disk_fault(&mut self, target: Target) -> DiskFault {
        let most = self.operations.get(&target);
        let (changes, reads) = most.map_or((30, 30), |most| (most.changes, most.reads));
        let change = self.rng.u64(1..=changes.max(1));
        let read = self.rng.u64(1..=reads.max(1));
        match self.rng.u32(0..12) {
            0..=3 => DiskFault::KilledAt(change),
            4 => DiskFault::FullFrom(change),
            5 => DiskFault::WriteErrorAt(change),
            6 => DiskFault::ReadErrorAt(read),
            _ => DiskFault::None,
        }
    }

    fn process_fault(&mut self) -> ProcessFault {
        let count = self.rng.u32(1..8);
        match self.rng.u32(0..12) {
            0 => ProcessFault::CannotStart(count),
            1 => ProcessFault::Panics(count),
            _ => ProcessFault::None,
        }
    }

    /// Grades a target while faults may occur.
    fn grade(&mut self, target: Target) -> Result<(), String> {
        let (disk, process) = (self.disk_fault(target), self.process_fault());
        let is_exported = self.rng.bool();
        let is_regrade = target == Target::Whole && self.rng.u32(0..3) == 0;
        self.grade_with(target, is_regrade, is_exported, disk, process)
    }

    fn grade_with(
        &mut self,
        target: Target,
        is_regrade: bool,
        is_exported: bool,
        disk: DiskFault,
        process: ProcessFault,
    ) -> Result<(), String> {
        let mut more = self.manual_option();
        if is_regrade {
            more.push("--regrade");
        }
        if is_exported {
            more.extend(EXPORT);
        }
        let exam = self.models.entry(target).or_default().observed.exam();
        let has_other_exam = exam.is_some_and(|exam| exam != self.world.exam);
        if matches!(target, Target::Part(_)) && has_other_exam {
            // A shard cannot be regraded in place.
            self.world.remove(target);
            self.models.insert(target, Model::default());
            self.log.push(format!("{target:?} is removed"));
        }
        let observed = &self.models[&target].observed;
        let is_possible = match target {
            Target::Whole if is_regrade => observed.run.is_some(),
            Target::Whole => observed.run.is_none() || !has_other_exam,
            Target::Part(_) | Target::Merged | Target::Fresh => true,
        };
        let is_possible = is_possible && self.world.is_class();
        // Manual points are only possible if the student who gets them is in the class.
        let has_manual =
            !self.manual_option().is_empty() || observed.list("manual-points").is_some();
        let has_student = self.world.submissions.contains_key(STUDENTS[0]);
        let is_possible = is_possible && (has_student || !has_manual);
        let ended = self.world.grade(target, &more, disk, process);
        self.log.push(format!(
            "grade {target:?} {more:?} with {disk:?} and {process:?}: {}",
            text(&ended)
        ));
        let had_process_fault = process != ProcessFault::None;
        self.check(target, &ended, is_possible, is_exported, had_process_fault)?;
        if disk == DiskFault::None && process == ProcessFault::None {
            self.operations.insert(target, ended.operations);
        }
        Ok(())
    }

    /// Returns the option for manual points, if they are used.
    fn manual_option(&self) -> Vec<&'static str> {
        match MANUAL_POINTS[self.world.manual] {
            "" => Vec::new(),
            option => vec![option],
        }
    }

    /// Returns the scores that a run must give to its entries.
    fn expected(&self, target: Target) -> BTreeMap<&'static str, Option<ScoreId>> {
        let exam = self.world.exam;
        let submissions = self.world.submissions.iter();
        let all = submissions.map(|(student, version)| {
            let score = version.map(|version| ScoreId { version, exam });
            (*student, score)
        });
        let all: Vec<_> = all.collect();
        let shard = match target {
            Target::Part(part) => format!("{part}/{PARTS}").parse().unwrap(),
            Target::Whole | Target::Merged | Target::Fresh => Shard::ALL,
        };
        shard.select(all).into_iter().collect()
    }

    fn check(
        &mut self,
        target: Target,
        ended: &Ended,
        is_possible: bool,
        is_exported: bool,
        had_process_fault: bool,
    ) -> Result<(), String> {
        let expected = self.expected(target);
        let folder = self.world.folder(target);
        let model = self.models.entry(target).or_default();
        let observed = observe(&folder, &mut model.keys)?;
        let lists = model.observed.run.as_ref().map(|run| run["lists"].clone());
        for kind in ["manual-points", "canvas"] {
            let had_it = lists.as_ref().is_some_and(|lists| lists[kind].is_object());
            if had_it && observed.list(kind).is_none() {
                return Err(format!("{target:?} has forgotten the list {kind}"));
            }
        }
        model.update(observed.clone())?;
        let is_complete = matches!(ended.result, Ok(Completion::Complete));
        let had_fault = ended.had_disk_fault || had_process_fault;
        if !had_fault && is_complete != is_possible {
            return Err(format!(
                "{target:?}, possible: {is_possible}: {}",
                text(ended)
            ));
        }
        if !is_complete {
            return Ok(());
        }
        model.check_success(&expected)?;
        if observed.round() > 1 {
            let file = fs::read_to_string(folder.join("drift.json")).unwrap_or_default();
            model.check_score_changes(&file, &expected)?;
        }
        self.check_leftovers(target)?;
        if target == Target::Whole {
            self.fresh
                .compare(&self.world, target, &[&observed], is_exported)?;
        }
        Ok(())
    }

    fn check_leftovers(&self, target: Target) -> Result<(), String> {
        let left = self.world.temporary_files(target);
        if left.is_empty() {
            Ok(())
        } else {
            Err(format!("{target:?} still has {left:?}"))
        }
    }

    /// Runs everything once more without faults and compares the results with those of runs into
    /// new folders.
    fn end(&mut self) -> Result<(), String> {
        let none = (DiskFault::None, ProcessFault::None);
        // Shards with different lists cannot be merged.
        self.world.manual = 1;
        if !self.world.submissions.contains_key(STUDENTS[0]) {
            self.world.submit(STUDENTS[0], Some(self.next_version));
        }
        let model = self.models.entry(Target::Whole).or_default();
        let exam = model.observed.exam();
        let is_regrade = exam.is_some_and(|exam| exam != self.world.exam);
        self.grade_with(Target::Whole, is_regrade, true, none.0, none.1)?;
        let folder = self.world.folder(Target::Whole);
        let files = all_files(&folder);
        self.grade_with(Target::Whole, false, true, none.0, none.1)?;
        if files != all_files(&folder) {
            return Err("a run without changes changed a file".to_owned());
        }
        for part in 1..=PARTS {
            self.grade_with(Target::Part(part), false, true, none.0, none.1)?;
        }
        if !self.can_merge() || !self.parts_are_current() {
            return Err("the parts cannot be merged".to_owned());
        }
        self.merge_with(DiskFault::None)
    }
}

fn text(ended: &Ended) -> String {
    match &ended.result {
        Ok(completion) => format!("{completion:?}"),
        Err(error) => format!("error: {error}"),
    }
}
