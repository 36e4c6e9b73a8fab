//! Asking one question again, alone, and showing all of its answer: for a `println!` or a look.

use std::fmt::Write;

use protocol::{Answer, ElementOutcome, Question};

use crate::build::Builder;
use crate::cli::Arguments;
use crate::describe;
use crate::error::Error;
use crate::exam::{Exam, ExamQuestion};
use crate::exam_file;
use crate::grade::{budget, collect};
use crate::probe::{Fault, subset};
use crate::question_ref::QuestionRef;
use crate::sanitize::sanitize;
use crate::select_isolation::with_requested_level;
use crate::verdict::file_message;
use crate::workspace::Workspace;

/// The most characters that are shown of what was printed.
const MAX_PRINTED_CHARS: usize = 20_000;

/// Asks it; returns what a terminal shows.
pub fn replay(arguments: &Arguments, place: &QuestionRef) -> Result<String, Error> {
    let workspace = Workspace::find()?;
    let exam = exam_file::load(arguments.exam.as_deref())?.exam;
    let (question, wanted) = find_question(&exam, place)?;
    let submission = collect(arguments, &workspace)?;
    let build =
        with_requested_level(Builder::prepare(&workspace)?, arguments)?.build(&submission)?;

    let mut shown = String::new();
    for (file, why) in &build.not_compiled {
        writeln!(shown, "{}\n", file_message(file, why)).expect("text takes text");
    }
    let Some(program) = &build.probe else {
        return Ok(shown);
    };
    let budget = budget(arguments);
    let mut probe = build.launcher(program).start(budget)?;
    let answered = probe.ask([&question], budget);
    let got = answer_text(answered);
    let printed = sanitize(probe.finish().trim_end(), MAX_PRINTED_CHARS);
    let printed = match printed.as_str() {
        "" => "(nothing)".to_owned(),
        _ => format!("\n{printed}"),
    };
    let asked = describe::element(&question, 0);
    write!(
        shown,
        "asked    {asked}\ngot      {got}\nwanted   {wanted}\nprinted  {printed}\n"
    )
    .expect("text takes text");
    Ok(shown)
}

/// The question with this one element, and its key in words.
fn find_question(exam: &Exam, place: &QuestionRef) -> Result<(Question, String), Error> {
    let item = exam.items.iter().find(|item| item.id == place.item);
    let item = item.ok_or_else(|| {
        let alike = exam.items.iter().map(|item| item.id.as_str());
        let task = place.item.split('.').next().unwrap_or_default();
        let alike: Vec<&str> = alike.filter(|id| id.starts_with(task)).collect();
        Error::Replay(format!(
            "the exam has no item `{}`; there are: {}",
            place.item,
            alike.join(", ")
        ))
    })?;
    match item.element(place.number) {
        Some((question, element)) => {
            let asked = &item.questions[question];
            let alone = subset(&asked.question, element..element + 1);
            Ok((alone, expected_text(asked, element)))
        }
        None => Err(Error::Replay(format!(
            "{} asks {} questions: there is no number {}",
            place.item,
            item.count(),
            place.number
        ))),
    }
}

/// What is right, each on a line of its own where several are. A whole picture is no line.
fn expected_text(asked: &ExamQuestion, element: usize) -> String {
    match asked.question {
        Question::Radiance { .. } => "the reference's picture".to_owned(),
        Question::Camera { .. }
        | Question::Shapes { .. }
        | Question::BBox { .. }
        | Question::Build { .. }
        | Question::Traverse { .. }
        | Question::BuildAndTraverse { .. }
        | Question::Done => describe::answer::wanted(asked, element).join(", or\n         "),
    }
}

fn answer_text(answered: Result<Vec<Answer>, Fault>) -> String {
    let answer = match answered {
        Ok(answers) => answers.into_iter().next(),
        Err(fault) => return fault.to_string(),
    };
    match answer {
        Some(Answer::Picture(ElementOutcome::Value(pixels))) => format!("{} pixels", pixels.len()),
        Some(answer) => describe::answer::got(&answer, 0),
        None => "no answer".to_owned(),
    }
}
