//! Runs a single question again, and shows the whole answer and what the code prints.

use std::fmt::Write;

use judging::describe;
use judging::exam::{Exam, ExamQuestion};
use judging::sanitize::sanitize;
use protocol::{Answer, ElementOutcome, Question};

use crate::build::Builder;
use crate::error::Error;
use crate::grade::collect;
use crate::options::GradeOptions;
use crate::probe::{Fault, subset};
use crate::question_ref::QuestionRef;
use crate::select_isolation::with_requested_level;
use crate::verdict::file_message;
use crate::workspace::Workspace;

/// Maximum length of the printed text that is shown, in characters.
const MAX_PRINTED_CHARS: usize = 20_000;

/// Runs the question and returns the text for the terminal.
pub fn replay(options: &GradeOptions, reference: &QuestionRef) -> Result<String, Error> {
    let workspace = Workspace::find()?;
    let exam = options.exam.load(options.handed_out)?.exam;
    let (question, wanted) = find_question(&exam, reference)?;
    let submission = collect(options, &workspace)?;
    let build = with_requested_level(Builder::prepare(&workspace)?, options.isolation)?
        .build(&submission)?;

    let mut text = String::new();
    for (file, why) in &build.not_compiled {
        writeln!(text, "{}\n", file_message(file, why)).expect("writing to a string cannot fail");
    }
    let Some(program) = &build.probe else {
        return Ok(text);
    };
    let budget = options.budget;
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
        text,
        "asked    {asked}\ngot      {got}\nwanted   {wanted}\nprinted  {printed}\n"
    )
    .expect("writing to a string cannot fail");
    Ok(text)
}

/// Returns a question that contains only the referenced element, and the expected answer as text.
fn find_question(exam: &Exam, reference: &QuestionRef) -> Result<(Question, String), Error> {
    let item = exam.items.iter().find(|item| item.id == reference.item);
    let item = item.ok_or_else(|| {
        let ids = exam.items.iter().map(|item| item.id.as_str());
        let task = reference.item.split('.').next().unwrap_or_default();
        let ids: Vec<&str> = ids.filter(|id| id.starts_with(task)).collect();
        Error::Replay(format!(
            "the exam has no item `{}`; the items of this task are: {}",
            reference.item,
            ids.join(", ")
        ))
    })?;
    match item.element(reference.number) {
        Some((question, element)) => {
            let question = &item.questions[question];
            let alone = subset(&question.question, element..element + 1);
            Ok((alone, expected_text(question, element)))
        }
        None => Err(Error::Replay(format!(
            "{} has {} questions, so there is no number {}",
            reference.item,
            item.count(),
            reference.number
        ))),
    }
}

/// Returns the expected answer as text, with alternatives on separate lines. A path-traced picture
/// is not printed.
fn expected_text(question: &ExamQuestion, element: usize) -> String {
    match question.question {
        Question::Radiance { .. } => "the reference's picture".to_owned(),
        Question::Camera { .. }
        | Question::Shapes { .. }
        | Question::BBox { .. }
        | Question::Build { .. }
        | Question::Traverse { .. }
        | Question::BuildAndTraverse { .. }
        | Question::Done => describe::answer::wanted(question, element).join(", or\n         "),
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
