//! Measures the cost of the pipe. Questions with 100,000 rays are sent to a probe, and the same
//! code answers the same questions in one process. The two measurements alternate.

use std::fs;
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

use bench_support::{BareRustc, Cost, median, repetitions};
use glam::{Vec2, Vec3, vec3};
use grader::probe::{ItemLimits, Launcher};
use protocol::{Geometry, Question, Ray, Shape, Vertex, wire};

const ROUNDS: usize = 7;
const RAYS: usize = 100_000;
/// The number of times that the in-process program answers the questions again. The time for these
/// repetitions doesn't include reading the questions.
const REPETITIONS: u32 = 20;
const LIMITS: ItemLimits = ItemLimits::from_cpu(Duration::from_secs(60));

/// The end of a program that reads all questions, answers them once, and then answers them again as
/// many times as its argument specifies.
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
            std::hint::black_box(framework::harness::answer::answer_question(&world::Student, question));
        }
    }
}
"#;

/// Prints two rows: one for 100 rays per question, as in the exam, and one for the worst case, a
/// single ray per question.
pub fn compare(folder: &Path, bare: &BareRustc, launcher: &Launcher) {
    let lib = fs::read_to_string(folder.join("lib.rs")).expect("the file was copied");
    fs::write(folder.join("in_process.rs"), lib + IN_PROCESS).expect("the file can be written");
    Cost::of_program(&mut bare.program(folder, "in_process.rs"));
    let count = repetitions(ROUNDS);
    println!("\n{RAYS} rays, median of {count} rounds, CPU ms");
    println!("  rays/question   in process   over the pipe   ratio");
    for rays_per_question in [100, 1] {
        let rounds = (0..count).map(|_| round(folder, launcher, &questions(rays_per_question)));
        let rounds: Vec<[f64; 2]> = rounds.collect();
        let in_process = median(rounds.iter().map(|[in_process, _]| *in_process));
        let over_pipe = median(rounds.iter().map(|[_, over_pipe]| *over_pipe));
        let ratio = median(
            rounds
                .iter()
                .map(|[in_process, over_pipe]| over_pipe / in_process),
        );
        println!("{rays_per_question:>15}{in_process:>13.1}{over_pipe:>16.1}{ratio:>8.1}");
    }
}

/// Measures one round. Returns two CPU times in milliseconds: in one process, and over the pipe.
fn round(folder: &Path, launcher: &Launcher, questions: &[Question]) -> [f64; 2] {
    let frames = questions.iter().fold(Vec::new(), |frames, question| {
        wire::append(frames, 0, question).expect("the question can be encoded")
    });
    let file = folder.join("questions");
    fs::write(&file, frames).expect("the file can be written");
    let [once, more] = [0, REPETITIONS].map(|times| {
        let mut command = std::process::Command::new(folder.join("in_process"));
        let questions = fs::File::open(&file).expect("the file was written");
        command.arg(times.to_string()).stdin(Stdio::from(questions));
        Cost::of_program(&mut command).cpu
    });
    let over_pipe = Cost::of(|| {
        let mut probe = launcher.start(LIMITS.cpu).expect("the probe starts");
        let answers = probe.ask(questions, LIMITS).expect("the probe answers");
        assert_eq!(answers.len(), questions.len());
        // The CPU time of a child is only known once it has ended.
        probe.finish();
    });
    [more.saturating_sub(once) / REPETITIONS, over_pipe.cpu].map(|cpu| 1e3 * cpu.as_secs_f64())
}

/// Returns questions that each have this many rays. All rays are aimed near one triangle, and about
/// half of them hit it.
fn questions(rays_per_question: usize) -> Vec<Question> {
    let corner = |x, y| Vertex::new(vec3(x, y, -2.0), Vec3::Z, Vec2::ZERO);
    let triangle = Shape::Triangle {
        vertices: [corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0)],
        shape: 0,
    };
    let ray = |number: usize| {
        let [x, y] = [number % 317, number / 317].map(|step| step as f32 / 317.0);
        Ray::new(vec3(x, y, 0.0), Vec3::NEG_Z)
    };
    let rays: Vec<Ray> = (0..RAYS).map(ray).collect();
    let geometry = Geometry::List {
        shapes: vec![triangle],
    };
    let questions = rays.chunks(rays_per_question);
    questions
        .map(|rays| Question::hits(geometry.clone(), rays.to_vec()))
        .collect()
}
