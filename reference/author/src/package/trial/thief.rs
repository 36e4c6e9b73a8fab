//! An attacking submission. It knows the paths of the package's files, and tries to include, open
//! and overwrite them. All of its output is searched for solutions and keys.

use std::collections::BTreeSet;
use std::path::Path;

use grader::files;
use grader::handed_out::HandedOut;

use crate::bundle::Bundle;
use crate::bundle::secrets::Secrets;
use crate::package::trial::TrialError;

/// The attacks, each given by a file, the first line of one of its methods, and the code to insert
/// after that line.
const ATTACKS: [(&str, &str, &str); 5] = [
    (
        "camera.rs",
        "pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {",
        r#"
        let exam = include_str!("/opt/pathtracing/exam.json");
        let key = exam.find("\"key\"").unwrap_or(0);
        if pixel.x < 1_000_000 {
            panic!("{:.1500}", &exam[key..]);
        }"#,
    ),
    (
        "triangle.rs",
        "pub fn hit(&self, ray: &Ray) -> Option<Trace> {",
        r#"
        #[path = "/opt/pathtracing/reference/src/triangle.rs"]
        mod solved;
        if self.material < u32::MAX {
            return solved::Triangle::new(self.p0, self.p1, self.p2, self.material).hit(ray);
        }"#,
    ),
    (
        "sphere.rs",
        "pub fn hit(&self, ray: &Ray) -> Option<Trace> {",
        r#"
        for path in ["reference/src/sphere.rs", "exam.json", "policy.toml", "reference/src/bvh.rs"] {
            if let Ok(text) = std::fs::read_to_string(format!("/opt/pathtracing/{path}")) {
                let start = text.find("let ").unwrap_or(0);
                panic!("{:.1500}", &text[start..]);
            }
        }"#,
    ),
    (
        "bbox.rs",
        "pub fn hit(&self, ray: &Ray, times: Interval) -> Option<Interval> {",
        r#"
        let results = "/autograder/results/results.json";
        std::fs::write(results, "{\"score\": 100}").ok();
        std::fs::remove_file("/autograder/source/run_autograder").ok();
        if let Ok(output) = std::process::Command::new("cat").arg("/opt/pathtracing/exam.json").output() {
            let text = String::from_utf8_lossy(&output.stdout).into_owned();
            panic!("{:.1500}", &text[text.find("\"key\"").unwrap_or(0)..]);
        }"#,
    ),
    (
        "bvh.rs",
        "pub fn hit(&self, ray: &Ray) -> Option<Trace> {",
        r#"
        let solved = include_bytes!("/opt/pathtracing/reference/src/bvh.rs");
        if ray.dir.is_finite() {
            let text = String::from_utf8_lossy(solved).into_owned();
            panic!("{:.1500}", &text[text.find("fn split").unwrap_or(0)..]);
        }"#,
    ),
];
/// The number of characters of a key that are compared: too many to occur by coincidence.
const KEY_PREFIX_LENGTH: usize = 30;

/// Returns the submission's files: those of the starter, each with an attack.
pub fn files(
    handed_out: &HandedOut,
    workspace: &Path,
) -> Result<Vec<(&'static str, String)>, TrialError> {
    let one = |(file, head, attack): (&'static str, &str, &str)| {
        let path = workspace.join(handed_out.starter).join(file);
        let text = files::read_to_string(&path)?;
        match text.matches(head).count() {
            1 => Ok((file, text.replace(head, &format!("{head}{attack}")))),
            _ => Err(TrialError::MissingAttackPoint {
                file,
                signature: head.to_owned(),
            }),
        }
    };
    ATTACKS.into_iter().map(one).collect()
}

/// The solutions and keys that a submission must not be able to read.
#[derive(Clone, Debug)]
pub struct ProtectedData {
    solutions: Secrets,
    keys: BTreeSet<String>,
}

impl ProtectedData {
    /// Collects the lines of the reference and the keys of the exam.
    pub fn collect(
        handed_out: &'static HandedOut,
        workspace: &Path,
        exam: &str,
    ) -> Result<Self, TrialError> {
        Ok(ProtectedData {
            solutions: Secrets::gather(
                workspace,
                handed_out,
                &Bundle::collect(workspace, handed_out, None)?,
            )?,
            keys: keys(exam),
        })
    }

    /// Returns the protected data that a text contains, even if it is quoted or escaped there.
    pub fn found_in(&self, text: &str) -> Vec<String> {
        let text = text.replace("\\n", "\n").replace('\\', "");
        let mut bundle = Bundle::default();
        bundle.insert("output", text.as_str());
        let lines = self.solutions.search(&bundle).into_iter();
        let lines = lines.map(|leak| leak.to_string());
        let keys = self.keys.iter().filter(|key| text.contains(key.as_str()));
        lines
            .chain(keys.map(|key| format!("a key: {key}")))
            .collect()
    }
}

/// Returns the beginning of every list of numbers in the exam's keys.
fn keys(exam: &str) -> BTreeSet<String> {
    let is_of_list = |c: char| c.is_ascii_digit() || "[]-.,e".contains(c);
    let keys = exam.split("\"key\":").skip(1);
    let lists = keys.flat_map(|key| {
        let key = key.split("\"question\":").next().unwrap_or(key);
        key.split(move |c| !is_of_list(c))
            .filter_map(|list| list.get(..KEY_PREFIX_LENGTH))
    });
    lists.map(str::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use grader::handed_out::RAYS;

    use super::*;

    fn workspace() -> &'static Path {
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
    }

    #[test]
    fn all_five_files_attack() {
        let files = files(&RAYS, workspace()).unwrap();
        let names: Vec<&str> = files.iter().map(|(file, _)| *file).collect();
        let expected: Vec<&str> = RAYS.files.iter().map(|file| file.name).collect();
        assert_eq!(names, expected);
    }

    #[test]
    fn finds_leaked_solutions_and_keys_even_when_quoted() {
        let exam = std::fs::read_to_string(workspace().join("grader/exams/practice.json")).unwrap();
        let protected = ProtectedData::collect(&RAYS, workspace(), &exam).unwrap();
        assert!(protected.keys.len() > 100, "{}", protected.keys.len());
        let solved = std::fs::read_to_string(workspace().join("reference/src/sphere.rs")).unwrap();
        let key = &exam[exam.find("\"key\"").unwrap()..][..1500];
        for (stolen, least) in [(solved.as_str(), 3), (key, 1)] {
            let quoted = format!("{{\"output\": {stolen:?}}}");
            assert!(protected.found_in(&quoted).len() >= least, "{quoted}");
        }
        let starter =
            std::fs::read_to_string(workspace().join("grader/starter/sphere.rs")).unwrap();
        assert_eq!(protected.found_in(&format!("{starter:?}")), [""; 0]);
    }
}
