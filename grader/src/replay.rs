//! Asking one question again, alone, and showing all of its answer: for a `println!` or a look.

use std::fmt::Write;

use protocol::{Answer, Outcome, Question, Rays, Samples};

use crate::ask::{Fault, Launcher};
use crate::build::Builder;
use crate::cli::Arguments;
use crate::describe;
use crate::error::Error;
use crate::exam::{Asked, Exam, Hit, Key, Surface};
use crate::exam_file;
use crate::grade::{budget, collect};
use crate::place::Place;
use crate::tame::tame;
use crate::verdict::file_message;
use crate::workspace::Workspace;

/// The most characters that are shown of what was printed.
const LONGEST_PRINT: usize = 20_000;

/// Asks it; returns what a terminal shows.
pub fn replay(arguments: &Arguments, place: &Place) -> Result<String, Error> {
    let workspace = Workspace::find()?;
    let exam = exam_file::load(arguments.exam.as_deref())?.exam;
    let (question, wanted) = find(&exam, place)?;
    let submission = collect(arguments, &workspace)?;
    let build = Builder::prepare(&workspace)?.build(&submission)?;

    let mut shown = String::new();
    for (file, why) in &build.not_compiled {
        writeln!(shown, "{}\n", file_message(file, why)).expect("text takes text");
    }
    let Some(program) = build.probe.clone() else {
        return Ok(shown);
    };
    let budget = budget(arguments);
    let mut probe = Launcher { program }.start(budget)?;
    let answered = probe.ask([&question], budget);
    let got = got(answered);
    let printed = tame(probe.finish().trim_end(), LONGEST_PRINT);
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
fn find(exam: &Exam, place: &Place) -> Result<(Question, String), Error> {
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
    let mut left = place.number - 1;
    for asked in &item.questions {
        let count = asked.question.count();
        if left < count {
            return Ok((alone(&asked.question, left), wanted(asked, left)));
        }
        left -= count;
    }
    let count: usize = item
        .questions
        .iter()
        .map(|asked| asked.question.count())
        .sum();
    Err(Error::Replay(format!(
        "{} asks {count} questions: there is no number {}",
        place.item, place.number
    )))
}

/// The same question, with this element only.
fn alone(question: &Question, element: usize) -> Question {
    let one = |rays: &Rays| Rays::List(rays.to_vec()[element..=element].to_vec());
    let mut question = question.clone();
    match &mut question {
        Question::Camera { camera, samples } => {
            let sample = samples.on(camera.film)[element];
            *samples = Samples::List(vec![sample]);
        }
        Question::Shapes { rays, .. }
        | Question::Traverse { rays, .. }
        | Question::BuildAndTraverse { rays, .. } => *rays = one(rays),
        Question::BBox { shots, .. } => *shots = vec![shots[element]],
        Question::Build { .. } | Question::Radiance { .. } | Question::Done => {}
    }
    question
}

fn wanted(asked: &Asked, element: usize) -> String {
    match &asked.key {
        Key::Rays { directions, .. } => {
            format!(
                "ray from (0, 0, 0) toward {}",
                describe::point(directions[element])
            )
        }
        Key::Hits { hits, .. } => hits[element].as_ref().map_or("no hit".to_owned(), hit),
        Key::FirstHits { hits, also } => {
            let also = also.iter().filter(|(place, _)| *place as usize == element);
            let all = std::iter::once(&hits[element]).chain(also.map(|(_, answer)| answer));
            let all: Vec<String> = all
                .map(|answer| answer.as_ref().map_or("no hit".to_owned(), surface))
                .collect();
            all.join(", or\n         ")
        }
        Key::Spans { spans } => describe::span(spans[element]),
        Key::Tree { judged, sweep_cost } => format!(
            "a tree of which these hold: {judged:?}{}",
            sweep_cost.map_or(String::new(), |cost| format!("; SAH cost about {cost:.2}"))
        ),
        Key::Radiance { .. } => "the reference's picture".to_owned(),
    }
}

fn hit(hit: &Hit) -> String {
    format!(
        "distance {}, position {}, normal {}, uv {}, material {}",
        describe::number(hit.distance),
        describe::point(hit.position),
        describe::point(hit.normal),
        describe::uv(hit.uv),
        hit.material
    )
}

fn surface(surface: &Surface) -> String {
    format!(
        "distance {}, normal {}, uv {}",
        describe::number(surface.depth),
        describe::point(surface.normal),
        describe::uv(surface.uv)
    )
}

fn got(answered: Result<Vec<Answer>, Fault>) -> String {
    let answer = match answered {
        Ok(answers) => answers.into_iter().next(),
        Err(fault) => return fault.to_string(),
    };
    match answer {
        Some(Answer::Rays(rays)) => first(&rays, describe::ray),
        Some(Answer::Hits(hits)) => first(&hits, |hit| describe::trace(hit.as_ref())),
        Some(Answer::Spans(spans)) => first(&spans, |span| describe::span(*span)),
        Some(Answer::Tree(tree)) => first(&[tree], |tree| {
            let nodes = tree.nodes.iter().enumerate().map(|(place, node)| {
                let corners = (describe::point(node.min), describe::point(node.max));
                let below = match node.is_leaf() {
                    true => format!("leaf of {} from {}", node.size, node.start),
                    false => format!("children {} and {}", node.l, node.r),
                };
                format!("\n  {place}: {} to {}, {below}", corners.0, corners.1)
            });
            format!("root {}{}", tree.root, nodes.collect::<String>())
        }),
        Some(Answer::Picture(picture)) => {
            first(&[picture], |pixels| format!("{} pixels", pixels.len()))
        }
        Some(Answer::Done) | None => "no answer".to_owned(),
    }
}

fn first<T>(outcomes: &[Outcome<T>], show: impl Fn(&T) -> String) -> String {
    match outcomes.first() {
        Some(Outcome::Value(value)) => show(value),
        Some(Outcome::Panicked(panic)) => tame(
            &format!("a panic at {}: {}", panic.place, panic.message),
            2_000,
        ),
        Some(Outcome::GivenUp) | None => "no answer".to_owned(),
    }
}
