//! Measures how clearly the exam catches each mistake, based on the number and the share of wrong
//! answers to an item. A mistake that only a single ray reveals is caught by luck.

use std::collections::BTreeMap;
use std::fmt;

use grader::handed_out::HandedOut;
use judging::exam::{Item, Key};
use judging::judge::{Credit, judge, measure};
use protocol::Answer;

use crate::generated_file::GeneratedFile;
use crate::solutions::solution::Solution;
use crate::solutions::workbench::{Answers, BuiltSolution};

/// The minimum number of wrong answers in a table, unless their share is large enough.
const TABLE_ANSWERS: usize = 3;
/// The minimum share of wrong answers in a table.
const TABLE_SHARE: f64 = 0.2;
/// The minimum number of wrong positions in a picture, as a multiple of the tolerated number.
const PICTURE_MULTIPLE: f64 = 3.0;
/// The minimum number of wrong answers to questions with a single answer, unless all of them are
/// wrong.
const QUESTIONS: usize = 2;

/// How an item catches a mistake.
#[derive(Clone, Debug, PartialEq)]
pub struct Detection {
    /// The id of the item.
    pub item: String,
    /// The number of wrong answers in tables, and the total number of answers.
    pub answers: (usize, usize),
    /// The number of wrong answers to questions with a single answer (a tree, or the spread of
    /// directions), and the number of such questions.
    pub questions: (usize, usize),
    /// The number of wrong positions in a picture, as a multiple of the tolerated number.
    pub picture: f64,
    /// Whether the submission gave no answers to the item.
    pub is_unanswered: bool,
}

impl Detection {
    /// Returns how an item catches a mistake that gives these answers, or `None` if the item
    /// doesn't catch it.
    pub fn of_item(item: &Item, answers: &Answers) -> Option<Detection> {
        let mut caught = Detection {
            item: item.id.clone(),
            answers: (0, 0),
            questions: (0, 0),
            picture: 0.0,
            is_unanswered: answers.is_err(),
        };
        let mut is_caught = caught.is_unanswered;
        for (question, answer) in item.questions.iter().zip(answers.iter().flatten()) {
            let judgement = judge(question, answer);
            let is_wrong = judgement.credit < Credit::FULL;
            is_caught |= is_wrong;
            match question.key {
                Key::FirstHits { .. } | Key::Radiance { .. } => {
                    caught.picture = caught.picture.max(picture_multiple(question, answer));
                }
                Key::Tree { .. } | Key::SpreadEvenly { .. } => {
                    caught.questions.0 += usize::from(is_wrong);
                    caught.questions.1 += 1;
                }
                Key::Table { .. } => {
                    let count = judgement.failure.and_then(|failure| failure.count);
                    caught.answers.0 += count.map_or(0, |(wrong, _)| wrong);
                    caught.answers.1 += question.question.count();
                }
            }
        }
        is_caught.then_some(caught)
    }

    /// Returns how clear the detection is, as a multiple of the required minimum.
    pub fn clarity(&self) -> f64 {
        if self.is_unanswered {
            return f64::INFINITY;
        }
        let (wrong, of) = self.answers;
        let share = wrong as f64 / of.max(1) as f64;
        let table = (wrong as f64 / TABLE_ANSWERS as f64).max(share / TABLE_SHARE);
        let questions = match self.questions {
            (0, _) => 0.0,
            (wrong, of) => (wrong as f64 / QUESTIONS as f64).max(wrong as f64 / of as f64),
        };
        table.max(questions).max(self.picture / PICTURE_MULTIPLE)
    }
}

fn picture_multiple(question: &judging::exam::ExamQuestion, answer: &Answer) -> f64 {
    let measured = measure(question, answer).into_iter();
    let counts = measured.filter_map(|measured| measured.count);
    counts.map(|count| count.value).fold(0.0, f64::max)
}

impl fmt::Display for Detection {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        if self.is_unanswered {
            return write!(f, "no answer");
        }
        let mut parts = Vec::new();
        if let (wrong @ 1.., of) = self.answers {
            parts.push(format!("{wrong} of {of} answers"));
        }
        if let (wrong @ 1.., of) = self.questions {
            parts.push(format!("{wrong} of {of} questions"));
        }
        if self.picture > 0.0 {
            parts.push(format!(
                "{:.0} times the tolerated number of wrong positions",
                self.picture
            ));
        }
        write!(f, "{}", parts.join(", "))
    }
}

/// The clearest detection of each mistake, in the exam that catches it least clearly.
#[derive(Clone, Debug, Default)]
pub struct Detections {
    /// For each mistake, by id: the number of exams, and its clearest detection in the exam that
    /// catches it least clearly. The detection is `None` if an exam doesn't catch the mistake at
    /// all.
    thinnest: BTreeMap<String, (u64, Option<Detection>)>,
}

impl Detections {
    /// Adds the detections of these mistakes in some exams.
    pub fn add_all(
        &mut self,
        mistakes: &[&(&Solution, BuiltSolution)],
        of_exams: &[Vec<Vec<Detection>>],
    ) {
        for of_exam in of_exams {
            for ((mistake, _), detections) in mistakes.iter().zip(of_exam) {
                self.add(&mistake.id, detections);
            }
        }
    }

    /// Adds the detections of a mistake in one exam.
    fn add(&mut self, mistake: &str, detections: &[Detection]) {
        let detections = detections.iter();
        let clearest = detections.max_by(|a, b| a.clarity().total_cmp(&b.clarity()));
        let known = self.thinnest.entry(mistake.to_owned());
        let (exams, thinnest) = known.or_insert_with(|| (0, clearest.cloned()));
        *exams += 1;
        if clarity(clearest) < clarity(thinnest.as_ref()) {
            *thinnest = clearest.cloned();
        }
    }

    /// Returns the mistakes and their detections, sorted from the least to the most clearly
    /// detected mistake.
    pub fn by_clarity(&self) -> Vec<(&str, u64, Option<&Detection>)> {
        let all = self.thinnest.iter();
        let all = all.map(|(id, (exams, caught))| (id.as_str(), *exams, caught.as_ref()));
        let mut all: Vec<_> = all.collect();
        all.sort_by(|a, b| clarity(a.2).total_cmp(&clarity(b.2)));
        all
    }

    /// Returns the mistakes that at least one exam doesn't catch clearly enough, one line each.
    pub fn problems(&self) -> Vec<String> {
        let all = self.by_clarity().into_iter();
        let thin = all.filter(|(.., caught)| caught.is_none_or(|caught| caught.clarity() < 1.0));
        thin.map(|(id, _, caught)| match caught {
            None => format!("{id} passes an exam"),
            Some(caught) => format!(
                "{id} is caught only by {caught} in {}: add questions that expose it",
                caught.item
            ),
        })
        .collect()
    }

    /// Returns the table of all detections.
    pub fn generated_file(&self, handed_out: &HandedOut) -> GeneratedFile {
        let mut text = format!(
            "# How clearly each mistake is caught\n\n\
             Written by `cargo author mistakes`. For each mistake, the table shows how it is caught in the \
             exam that catches it least clearly, by the item that catches it best there. A mistake must get \
             at least {TABLE_ANSWERS} answers or {:.0}% of an item's tables wrong, {PICTURE_MULTIPLE} \
             times the tolerated number of wrong positions in a picture, or {QUESTIONS} or all of an \
             item's questions about trees or the spread of directions.\n\n\
             | mistake | exams | item | caught by | times the required |\n|---|--:|---|---|--:|\n",
            100.0 * TABLE_SHARE
        );
        for (id, exams, caught) in self.by_clarity() {
            text += &match caught {
                None => format!("| `{id}` | {exams} | | nothing | 0 |\n"),
                Some(caught) => {
                    let (item, multiple) = (&caught.item, multiple(caught.clarity()));
                    format!("| `{id}` | {exams} | `{item}` | {caught} | {multiple} |\n")
                }
            };
        }
        let path = format!("{}/mistakes/detections.md", handed_out.solutions());
        GeneratedFile::new(path, text)
    }
}

/// Returns how clear a detection is. A mistake that isn't caught gets a lower value than any
/// detection.
fn clarity(caught: Option<&Detection>) -> f64 {
    caught.map_or(-1.0, Detection::clarity)
}

fn multiple(clarity: f64) -> String {
    match clarity {
        f64::INFINITY => "∞".to_owned(),
        clarity => format!("{clarity:.1}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn caught(
        item: &str,
        answers: (usize, usize),
        questions: (usize, usize),
        picture: f64,
    ) -> Detection {
        Detection {
            item: item.to_owned(),
            answers,
            questions,
            picture,
            is_unanswered: false,
        }
    }

    #[test]
    fn three_answers_or_a_fifth_two_questions_or_all_and_three_times_the_tolerance_are_clear() {
        for (answers, questions, picture, is_clear) in [
            ((3, 100), (0, 0), 0.0, true),
            ((1, 5), (0, 0), 0.0, true),
            ((0, 0), (2, 9), 0.0, true),
            ((0, 0), (1, 1), 0.0, true),
            ((0, 0), (0, 0), 3.0, true),
            ((2, 11), (0, 0), 0.0, false),
            ((0, 0), (1, 3), 0.0, false),
            ((0, 0), (0, 0), 2.9, false),
        ] {
            let clarity = caught("", answers, questions, picture).clarity();
            assert_eq!(
                clarity >= 1.0,
                is_clear,
                "{answers:?} {questions:?} {picture}"
            );
        }
    }

    #[test]
    fn the_clearest_item_of_the_least_clear_exam_counts() {
        let mut detections = Detections::default();
        let thin = caught("bbox.thin", (1, 24), (0, 0), 0.0);
        let clear = caught("bbox.clear", (12, 24), (0, 0), 0.0);
        detections.add("bbox.a", &[thin.clone(), clear.clone()]);
        assert_eq!(detections.problems(), [""; 0]);
        detections.add("bbox.a", &[thin]);
        detections.add("bbox.b", &[]);
        assert_eq!(
            detections.problems(),
            [
                "bbox.b passes an exam",
                "bbox.a is caught only by 1 of 24 answers in bbox.thin: add questions that expose \
                 it",
            ]
        );
    }
}
