//! Writes a page with the report's drawings for every known mistake, for inspection.
//!
//! `cargo run --release -p author --example drawings -- target/drawings.html [WORD]` draws the
//! first wrong answer of every mistake. With a `WORD`, it draws the first wrong answer to every
//! item whose id, or whose mistake's id, contains the word.

use std::fmt::Write;
use std::path::Path;
use std::process::ExitCode;
use std::{env, error, fs};

use author::authoring::RAYS;
use author::exams;
use author::solutions::Solutions;
use author::solutions::workbench::Workbench;
use grader::drawing::{self, Drawing};
use judging::exam::Item;
use judging::judge::{Credit, judge};
use protocol::Answer;
use rayon::prelude::*;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

const STYLE: &str = "
:root { color-scheme: light dark; --paper: #fff; --ink: #1b1b1f; }
@media (prefers-color-scheme: dark) {
  :root { --paper: #16181d; --ink: #e8e8ec; --right: #56b4e9; --wrong: #f0883e; }
}
body { margin: 10px; background: var(--paper); color: var(--ink); font: 14px system-ui, sans-serif;
  display: grid; grid-template-columns: repeat(auto-fill, minmax(min(340px, 100%), 1fr)); gap: 24px; }
figure { margin: 0; max-width: 420px; } h2 { font-size: 13px; margin: 0; }
svg { width: 100%; height: auto; }
";

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Box<dyn error::Error>> {
    let file = env::args()
        .nth(1)
        .ok_or("specify the page to write, such as target/drawings.html")?;
    let word = env::args().nth(2).unwrap_or_default();
    let solutions = Solutions::load(Workbench::open(&RAYS)?)?;
    let exam = exams::load_practice(Path::new(ROOT), &RAYS)?;
    let figures = solutions
        .mistakes
        .par_iter()
        .map(|mistake| {
            let solution = solutions.workbench.build(&mistake.sources, &mistake.id)?;
            let mut figures = String::new();
            let items = exam.items.iter().filter(|item| item.task == mistake.task());
            let named = items.filter(|item| item.id.contains(&word) || mistake.id.contains(&word));
            for item in named {
                let Ok(answers) = solution.answers(item)? else {
                    continue;
                };
                if let Some((location, drawing)) = first_failure(item, &answers) {
                    let title = format!("{} in {}{location}", mistake.id, item.id);
                    write!(figures, "{}", figure(&title, drawing))
                        .expect("writing to a String cannot fail");
                    // If there is no word to search for, one drawing per mistake is enough.
                    if word.is_empty() {
                        break;
                    }
                }
            }
            Ok(figures)
        })
        .collect::<anyhow::Result<Vec<String>>>()?;
    let page = format!(
        "<!doctype html><meta charset=utf-8><meta name=viewport content='width=device-width'>\
         <title>Drawings</title><style>{STYLE}</style>{}",
        figures.concat()
    );
    Ok(fs::write(file, page)?)
}

/// Returns the location of the first wrong element in the answers to an item and the drawing of
/// this element.
fn first_failure(item: &Item, answers: &[Answer]) -> Option<(String, Option<Drawing>)> {
    let numbered = item.questions.iter().zip(answers).enumerate();
    let mut failures = numbered.filter_map(|(number, (question, answer))| {
        let judgement = judge(question, answer);
        let failure = judgement
            .failure
            .filter(|_| judgement.credit < Credit::FULL)?;
        let location = format!(", question {number}, element {}", failure.element);
        let drawing = drawing::draw(question, failure.element, Some(answer));
        Some((location, drawing))
    });
    failures.next()
}

fn figure(title: &str, drawing: Option<Drawing>) -> String {
    let (svg, caption) = match drawing {
        Some(drawing) => (drawing.svg, drawing.caption),
        None => (String::new(), "no drawing".to_owned()),
    };
    format!("<figure><h2>{title}</h2>{svg}<figcaption>{caption}</figcaption></figure>\n")
}
