//! What the pipe costs: 100,000 rays asked of a probe, beside the same questions answered where they
//! are by the same code, turn by turn.

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

use glam::{Vec2, Vec3, vec3};
use grader::probe::{Budget, Launcher};
use protocol::{Question, Ray, Rays, Shape, Vertex, wire};

use crate::bare::BareRustc;
use crate::cost::Cost;
use crate::median;

const ROUNDS: usize = 7;
const RAYS: usize = 100_000;
/// The program without a pipe answers so often more, so that reading the questions does not count.
const REPETITIONS: u32 = 20;
const BUDGET: Budget = Budget {
    cpu: Duration::from_secs(60),
};

/// The end of a program that reads all questions, and then answers them once and so often more.
const IN_PROCESS: &str = r#"
fn main() {
    use std::io::Read;

    let mut bytes = Vec::new();
    std::io::stdin().read_to_end(&mut bytes).unwrap();
    let (mut rest, mut questions) = (bytes.as_slice(), Vec::new());
    while !rest.is_empty() {
        let frame = protocol::wire::read(&mut rest, usize::MAX).unwrap();
        questions.push(frame.decode::<protocol::Question>().unwrap());
    }
    let times: u32 = std::env::args().nth(1).unwrap().parse().unwrap();
    for _ in 0..=times {
        for question in &questions {
            std::hint::black_box(framework::answer::question(&world::Student, question));
        }
    }
}
"#;

/// Prints a line for questions as the exam's, of many rays each, and one for the worst: of one ray.
pub fn compare(folder: &Path, bare: &BareRustc, launcher: &Launcher) {
    let lib = fs::read_to_string(folder.join("lib.rs")).expect("it was copied");
    fs::write(folder.join("in_process.rs"), lib + IN_PROCESS).expect("it can be written");
    Cost::of_program(&mut bare.program(folder, "in_process.rs"));
    println!("\n{RAYS} rays, median of {ROUNDS} rounds, CPU ms");
    println!("rays a question   in process   over the pipe   ratio");
    for each in [100, 1] {
        let rounds = (0..ROUNDS).map(|_| round(folder, launcher, &questions(each)));
        let rounds: Vec<[f64; 2]> = rounds.collect();
        let here = median(rounds.iter().map(|[here, _]| *here));
        let there = median(rounds.iter().map(|[_, there]| *there));
        let ratio = median(rounds.iter().map(|[here, there]| there / here));
        println!("{each:>15}{here:>13.1}{there:>16.1}{ratio:>8.1}");
    }
}

/// CPU time in milliseconds: in process, and over the pipe.
fn round(folder: &Path, launcher: &Launcher, questions: &[Question]) -> [f64; 2] {
    let frames = questions.iter().fold(Vec::new(), |frames, question| {
        wire::append(frames, 0, question).expect("it can be encoded")
    });
    let file = folder.join("questions");
    fs::write(&file, frames).expect("it can be written");
    let [once, more] = [0, REPETITIONS].map(|times| {
        let mut command = std::process::Command::new(folder.join("in_process"));
        let questions = fs::File::open(&file).expect("it was written");
        command.arg(times.to_string()).stdin(Stdio::from(questions));
        Cost::of_program(&mut command).cpu
    });
    let there = Cost::of(|| {
        let mut probe = launcher.start(BUDGET).expect("it starts");
        let answers = probe.ask(questions, BUDGET).expect("it answers");
        assert_eq!(answers.len(), questions.len());
        // Its time counts once it has ended.
        probe.finish();
    });
    [more.saturating_sub(once) / REPETITIONS, there.cpu].map(|cpu| 1e3 * cpu.as_secs_f64())
}

/// All rays at one triangle, so many in each question; about half of them hit.
fn questions(each: usize) -> Vec<Question> {
    let corner = |x, y| Vertex::new(vec3(x, y, -2.0), Vec3::Z, Vec2::ZERO);
    let triangle = Shape::Triangle {
        vertices: [corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0)],
        material: 0,
    };
    let ray = |number: usize| {
        let [x, y] = [number % 317, number / 317].map(|step| step as f32 / 317.0);
        Ray::new(vec3(x, y, 0.0), Vec3::NEG_Z)
    };
    let rays: Vec<Ray> = (0..RAYS).map(ray).collect();
    let questions = rays.chunks(each).map(|rays| Question::Shapes {
        shapes: vec![triangle],
        rays: Rays::List(rays.to_vec()),
    });
    questions.collect()
}
