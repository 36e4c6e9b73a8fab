//! Runs a single question again and shows the complete answer, whether it is right, and the code's
//! output.

use std::collections::BTreeSet;

use judging::assignment::{Task, TaskInfo};
use judging::describe;
use judging::exam::{Exam, ExamQuestion, Item, question_subset};
use judging::judge::{element_error, judge};
use judging::sanitize::sanitize;
use protocol::{Answer, ElementOutcome, Question, Shape};

use crate::build::Builder;
use crate::build::select_isolation::with_requested_level;
use crate::error::Error;
use crate::grade::PreparedSubmission;
use crate::grade::options::GradeOptions;
use crate::handed_out::HandedOut;
use crate::inputs::question_ref::QuestionRef;
use crate::probe::{Budget, Crash, Culprit, Fault, Launcher, smallest_overflow};
use crate::verdict::clue;
use crate::verdict::messages::file_message;

/// The maximum number of characters of the code's output to show.
const MAX_PRINTED_CHARS: usize = 20_000;

/// Runs the question and returns the text for the terminal.
pub fn replay(options: &GradeOptions, reference: &QuestionRef) -> Result<String, Error> {
    let exam = options.exam.load(options.handed_out)?.exam;
    let item = reference.find_item(&exam).map_err(Error::User)?;
    let given = reference
        .number
        .map(|number| find_element(item, number))
        .transpose()?;
    let prepared = PreparedSubmission::new(options)?;
    let paths = prepared.source_paths();
    let tasks = tasks_asked(&exam, item, options.handed_out);
    let unwritten = tasks.iter().filter_map(|info| {
        let methods = prepared.submission.task_methods(info);
        let method = methods.filter(|method| !method.is_changed)?;
        Some((
            info,
            format!("{} ({}:{})", method.names, info.file, method.line),
        ))
    });
    let unwritten: Vec<_> = unwritten.collect();
    let own = unwritten.iter().find(|(info, _)| info.task() == item.task);
    if let Some((_, method)) = own {
        // Any answers come from the code that was handed out.
        let text = format!(
            "{} can only be run once {method} is written: the method is unchanged from the version \
             that was handed out\n",
            reference.item
        );
        return Ok(paths.in_text(&text).into_owned());
    }
    let builder = Builder::prepare(&prepared.workspace)?;
    let builder = with_requested_level(builder, options.isolation)?;
    let build = builder.build(&prepared.submission)?;

    let mut text = String::new();
    for (_, method) in &unwritten {
        text += &format!(
            "note: {} also calls {method}, which is not written yet\n\n",
            item.id
        );
    }
    for (file, why) in &build.not_compiled {
        text += &format!("{}\n\n", file_message(file, why));
    }
    let needed: Vec<&str> = tasks.iter().map(|info| info.file).collect();
    let mut missing = build.not_compiled.keys();
    // If a file doesn't compile, the program contains the starter's file instead.
    let is_missing = missing.any(|file| needed.contains(file));
    let Some(program) = build.probe.as_ref().filter(|_| !is_missing) else {
        let question = &reference.item;
        text += &format!("{question} cannot be run until this file compiles\n");
        return Ok(paths.in_text(&text).into_owned());
    };
    let launcher = build.launcher(program);
    let exam_run = ExamRun::new(&launcher, item, options.budget)?;
    match given.or_else(|| exam_run.first_wrong(item)) {
        Some(position) => {
            let replayed = ReplayedQuestion::run(&launcher, item, position, options.budget)?;
            text.push_str(&replayed.report(item, &exam_run));
        }
        None => text.push_str(&format!(
            "every answer to {} is correct ({} of {})\n",
            item.id,
            item.count(),
            item.count()
        )),
    }
    Ok(paths.in_text(&text).into_owned())
}

/// Returns the tasks whose code answers an item: the item's own task and the tasks of the items that
/// the item depends on.
fn tasks_asked(exam: &Exam, item: &Item, handed_out: &HandedOut) -> Vec<&'static TaskInfo> {
    let needed = item
        .needs
        .iter()
        .filter_map(|id| exam.items.iter().find(|other| other.id == *id));
    let tasks: BTreeSet<Task> = needed.map(|other| other.task).chain([item.task]).collect();
    let tasks = tasks.into_iter();
    tasks.map(|task| handed_out.assignment.info(task)).collect()
}

/// Returns the indices of the question and the element that this number refers to.
fn find_element(item: &Item, number: usize) -> Result<(usize, usize), Error> {
    item.element(number).ok_or_else(|| {
        Error::User(format!(
            "{} has no question {number}: its questions are numbered from 1 to {count}; without a \
             number, the first wrongly answered question is run",
            item.id,
            count = item.count(),
        ))
    })
}

/// The answers to all questions of an item. The questions are sent together, as in an exam.
struct ExamRun {
    answers: Result<Vec<Answer>, Fault>,
    /// The question and the element in it that crash or hang the program, if a single element is
    /// the reason for the missing answers.
    culprit: Option<(usize, usize)>,
}

impl ExamRun {
    fn new(launcher: &Launcher, item: &Item, budget: Budget) -> Result<Self, Error> {
        let questions = item.questions.iter().map(|question| &question.question);
        let mut probe = launcher.start(budget.total_cpu())?;
        let answers = probe.ask(questions, budget.single_item());
        let culprit = match answers {
            Ok(_) => None,
            Err(_) => Culprit::find(launcher, item)?.position,
        };
        Ok(ExamRun { answers, culprit })
    }

    /// Returns the indices of the first question with a wrong answer and of the wrong element in
    /// it. If the program crashed or hung, returns the indices of the question and the element that
    /// caused this, or zeros if they aren't known.
    fn first_wrong(&self, item: &Item) -> Option<(usize, usize)> {
        let Ok(answers) = &self.answers else {
            return Some(self.culprit.unwrap_or((0, 0)));
        };
        let judged = item.questions.iter().zip(answers).enumerate();
        let mut failures = judged.filter_map(|(index, (question, answer))| {
            Some((index, judge(question, answer).failure?.element))
        });
        failures.next()
    }

    /// Returns the verdict on an element that is answered correctly when it is run in isolation.
    fn verdict(&self, item: &Item, (question, element): (usize, usize)) -> String {
        let answers = match (&self.answers, self.culprit) {
            (Ok(answers), _) => answers,
            (Err(fault), Some((question, element))) => {
                let number = item.number(question, element);
                return format!(
                    "correct in isolation, but the item got no answers because {}#{number} ended \
                     the program: {fault}",
                    item.id
                );
            }
            (Err(fault), None) => {
                return format!(
                    "correct in isolation, but there is no answer when all of the item's questions \
                     are asked together: {fault}"
                );
            }
        };
        let answer = answers.get(question);
        let error =
            answer.and_then(|answer| element_error(&item.questions[question], answer, element));
        match error {
            None => "right".to_owned(),
            Some(error) => format!(
                "correct in isolation, but not when asked together with the item's other \
                    questions: {error}. {}",
                clue::KEPT_STATE
            ),
        }
    }
}

/// A question that was rerun in isolation.
struct ReplayedQuestion {
    position: (usize, usize),
    answer: Result<Answer, Fault>,
    printed: String,
    /// A minimal set of primitives that still overflows the stack, if building the tree overflows
    /// it at all.
    smallest: Option<Vec<Shape>>,
}

impl ReplayedQuestion {
    fn run(
        launcher: &Launcher,
        item: &Item,
        (question, element): (usize, usize),
        budget: Budget,
    ) -> Result<Self, Error> {
        let question_alone =
            question_subset(&item.questions[question].question, element..element + 1);
        let mut probe = launcher.start(budget.total_cpu())?;
        let answers = probe.ask([&question_alone], budget.single_item());
        let overflowed = matches!(answers, Err(Fault::Crashed(Crash::StackOverflow)));
        let smallest = if overflowed
            && let Question::Build {
                shapes,
                max_leaf_size,
            } = &question_alone
        {
            smallest_overflow(launcher, shapes, *max_leaf_size, budget)?
        } else {
            None
        };
        Ok(ReplayedQuestion {
            position: (question, element),
            smallest,
            answer: answers.and_then(|answers| {
                let answer = answers.into_iter().next();
                answer.ok_or_else(|| Fault::Protocol("no answer".to_owned()))
            }),
            printed: sanitize(probe.finish().trim_end(), MAX_PRINTED_CHARS),
        })
    }

    fn report(&self, item: &Item, exam_run: &ExamRun) -> String {
        let (question, element) = self.position;
        let exam_question = &item.questions[question];
        let printed = match self.printed.as_str() {
            "" => "(nothing)".to_owned(),
            printed => format!("\n{printed}"),
        };
        let rows = [
            ("verdict", self.verdict(item, exam_run)),
            ("asked", describe::element(&exam_question.question, element)),
            ("got", self.got()),
            ("wanted", expected_text(exam_question, element)),
            ("printed", printed),
        ];
        let number = item.number(question, element);
        let smallest = self.smallest.as_ref().map(|shapes| {
            let text = format!(
                "the stack still overflows with {} of the primitives: {}",
                shapes.len(),
                describe::each_shape(shapes)
            );
            ("smallest", text)
        });
        let rows = rows.into_iter().chain(smallest);
        let rows: String = rows
            .map(|(label, text)| format!("{label:<8} {text}\n"))
            .collect();
        format!("{}#{number}\n{rows}", item.id)
    }

    fn got(&self) -> String {
        match &self.answer {
            Ok(Answer::Picture(ElementOutcome::Value(pixels))) => {
                format!("{} pixels", pixels.len())
            }
            Ok(answer) => describe::answer::got(answer, 0),
            Err(fault) => fault.to_string(),
        }
    }

    /// Returns the text that says whether the answer is right and, if not, what is wrong with it.
    fn verdict(&self, item: &Item, exam_run: &ExamRun) -> String {
        let (question, element) = self.position;
        let single = item.questions[question].single(element);
        let alone = match &self.answer {
            Ok(answer) => element_error(&single, answer, 0),
            Err(_) => Some("there is no answer".to_owned()),
        };
        match alone {
            Some(error) => format!("wrong: {error}"),
            None => exam_run.verdict(item, self.position),
        }
    }
}

/// Returns the expected answer as text, with alternatives on separate lines. A rendered picture
/// isn't printed.
fn expected_text(question: &ExamQuestion, element: usize) -> String {
    if let Question::Radiance { .. } = question.question {
        return "the reference's picture".to_owned();
    }
    describe::answer::wanted(question, element).join(", or\n         ")
}
