//! How well hints are given: whether each known mistake is recognised, and whether a mistake that
//! is not known is taken for another.

use std::fmt;

use grader::ask::Fault;
use grader::exam::{Exam, Item};
use grader::recognise::Sightings;
use rayon::prelude::*;

use crate::proof::exhibits::{Exhibits, NotProven};
use crate::proof::sources::Sources;
use crate::proof::workbench::NotTried;

/// What was found out, of all mistakes.
#[derive(Debug, Default)]
pub struct Recognition {
    /// Recognised: it is the first hint, or one of several that nothing tells apart.
    pub right: Vec<String>,
    /// Taken for another, or for none: its hints.
    pub wrong: Vec<(String, Vec<String>)>,
    /// Nothing is told of it: only pictures show it, or it is mute, or like too many others.
    pub untold: Vec<String>,
    /// Left out of the catalogue, and taken for these.
    pub mistaken: Vec<(String, Vec<String>)>,
}

/// Asks every mistake, and what the exam would say of it: as it is, and had it not known of it.
pub fn recognise(exhibits: &Exhibits, exam: &Exam) -> Result<Recognition, NotProven> {
    let places: Vec<usize> = (0..exhibits.mistakes.len()).collect();
    let all: Result<Vec<_>, NotProven> = places
        .par_iter()
        .map(|&place| {
            let (mistake, sources) = &exhibits.mistakes[place];
            let sightings = sightings(exhibits, exam, &mistake.id, sources)?;
            let hints = first_hints(&sightings, exam, place, exam);
            let without = first_hints(&sightings, &without(exam, place as u32), place, exam);
            Ok((mistake.id.clone(), hints, without.unwrap_or_default()))
        })
        .collect();

    let mut found = Recognition::default();
    for (id, hints, without) in all? {
        match hints {
            None => found.untold.push(id.clone()),
            Some(hints) if hints.contains(&id) => found.right.push(id.clone()),
            Some(hints) => found.wrong.push((id.clone(), hints)),
        }
        if !without.is_empty() {
            found.mistaken.push((id, without));
        }
    }
    Ok(found)
}

fn sightings(
    exhibits: &Exhibits,
    exam: &Exam,
    id: &str,
    sources: &Sources,
) -> Result<Sightings, NotProven> {
    let solution = exhibits.workbench.build(sources, id)?;
    let mut sightings = Sightings::default();
    let task = id.split('.').next();
    for item in exam
        .items
        .iter()
        .filter(|item| Some(item.task.id()) == task)
    {
        let answers = solution.answers(item).map_err(NotTried::from)?;
        sightings.note(item, answers.as_deref().map_err(Fault::silence));
    }
    Ok(sightings)
}

/// The hints at the first item of which `known` tells that this mistake gets it wrong; none if
/// there is no such item.
fn first_hints(
    sightings: &Sightings,
    exam: &Exam,
    mistake: usize,
    known: &Exam,
) -> Option<Vec<String>> {
    let mistake = mistake as u32;
    let fails = |item: &Item| {
        item.tells
            .wrong
            .iter()
            .any(|told| told.by.contains(&mistake))
    };
    let place = known.items.iter().position(fails)?;
    let hints = sightings.explain(exam, &exam.items[place]);
    Some(hints.iter().map(|hint| hint.id.clone()).collect())
}

/// The exam, had nobody known of this mistake.
fn without(exam: &Exam, mistake: u32) -> Exam {
    let mut exam = exam.clone();
    for told in exam.items.iter_mut().flat_map(|item| &mut item.tells.wrong) {
        told.by.retain(|other| *other != mistake);
    }
    exam
}

impl Recognition {
    /// Of those of which something is told, how many are recognised.
    pub fn share(&self) -> f64 {
        let told = self.right.len() + self.wrong.len();
        self.right.len() as f64 / told.max(1) as f64
    }
}

impl fmt::Display for Recognition {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        for (id, hints) in &self.wrong {
            let hints = match hints.is_empty() {
                true => "none".to_owned(),
                false => hints.join(" or "),
            };
            writeln!(f, "{id} is taken for {hints}")?;
        }
        for (id, hints) in &self.mistaken {
            writeln!(f, "{id}, left out, is taken for {}", hints.join(" or "))?;
        }
        writeln!(f, "told by pictures alone: {}", self.untold.join(", "))?;
        let told = self.right.len() + self.wrong.len();
        write!(
            f,
            "hints: {} of {told} mistakes recognised ({:.0} %), {} of which nothing is told; left \
             out one at a time, {} of {} are taken for another",
            self.right.len(),
            100.0 * self.share(),
            self.untold.len(),
            self.mistaken.len(),
            told + self.untold.len(),
        )
    }
}
