//! Starts the viewer on a submission and talks to it as its page does.

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStderr, ChildStdout, Command, Stdio};
use std::time::{Duration, Instant};

use grader::handed_out::{HandedOut, LIGHT, RAYS};
use serde_json::{Value, json};
use tempfile::TempDir;

/// The slides' pseudocode for a traversal, taken literally.
pub const SLIDES_HIT: &str = r#"    pub fn hit(&self, ray: &Ray) -> Option<Trace> {
        let mut closest = None;
        self.slides_hit(ray, self.root, &mut closest);
        closest
    }

    // The slides' pseudocode, taken literally.
    fn slides_hit(&self, ray: &Ray, index: usize, closest: &mut Option<Trace>) {
        let node = &self.nodes[index];
        if node.is_leaf() {
            for primitive in &self.primitives[node.start..node.start + node.size] {
                *closest = Trace::nearer(*closest, primitive.hit(ray));
            }
            return;
        }
        let entry = |child: usize| {
            let inside = self.nodes[child].bbox.hit(ray, ray.range);
            inside.map_or(f32::INFINITY, |inside| inside.min)
        };
        let (hit1, hit2) = (entry(node.l), entry(node.r));
        let (first, second) = if hit1 <= hit2 { (node.l, node.r) } else { (node.r, node.l) };
        self.slides_hit(ray, first, closest);
        if closest.is_none_or(|closest| hit2 < closest.distance) {
            self.slides_hit(ray, second, closest);
        }
    }
"#;

/// The timeout for reaching a state. The first test compiles the dependencies.
const TIMEOUT: Duration = Duration::from_secs(600);

/// Returns the root folder of the workspace.
pub fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Returns a command that starts the viewer in the workspace's folder.
pub fn view() -> Command {
    let mut command = view_and_open();
    command.arg("--no-open");
    command
}

/// Returns a command that starts the viewer on a submission, without choosing the code for the
/// other part.
pub fn view_of(submission: &Submission) -> Command {
    let mut command = view();
    command.arg("--submission").arg(submission.path());
    command
}

/// Returns the text and location of each note in a state, one note per line.
pub fn notes(state: &Value) -> String {
    let notes = state["notes"].as_array().unwrap().iter();
    let line = |note: &Value| {
        format!(
            "{} ({})\n",
            note["text"].as_str().unwrap(),
            note["location"]
        )
    };
    notes.map(line).collect()
}

/// Returns a command that starts the viewer and opens the page.
pub fn view_and_open() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_view"));
    command.current_dir(workspace());
    command
}

/// The files of a submission in a temporary folder.
pub struct Submission {
    folder: TempDir,
}

impl Submission {
    /// Copies the reference's files.
    pub fn reference() -> Self {
        Submission::copy_of("reference/src", &RAYS)
    }

    /// Copies the reference's files for part two.
    pub fn reference_light() -> Self {
        Submission::copy_of("reference/light/src", &LIGHT)
    }

    /// Copies the starter's files.
    pub fn starter() -> Self {
        Submission::copy_of("grader/starter", &RAYS)
    }

    fn copy_of(source: &str, handed_out: &HandedOut) -> Self {
        let folder = TempDir::new().unwrap();
        for file in handed_out.file_names() {
            let from = workspace().join(source).join(file);
            fs::copy(from, folder.path().join(file)).unwrap();
        }
        Submission { folder }
    }

    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    pub fn read(&self, file: &str) -> String {
        fs::read_to_string(self.path().join(file)).unwrap()
    }

    pub fn write(&self, file: &str, text: &str) {
        fs::write(self.path().join(file), text).unwrap();
    }

    /// Replaces `Bvh::hit`.
    pub fn replace_traversal(&self, hit: &str) {
        let text = self.read("bvh.rs");
        let start = text.find("    pub fn hit(&self, ray: &Ray)").unwrap();
        let end = start + text[start..].find("\n    }\n").unwrap() + "\n    }\n".len();
        let (before, after) = (&text[..start], &text[end..]);
        self.write("bvh.rs", &format!("{before}{hit}{after}"));
    }

    /// Inserts a statement at the beginning of `Bvh::build`.
    pub fn insert_into_build(&self, statement: &str) {
        let text = self.read("bvh.rs");
        let signature = text.lines().find(|line| line.contains("pub fn build("));
        let signature = signature.unwrap();
        self.replace("bvh.rs", signature, &format!("{signature} {statement}"));
    }

    /// Wraps `Bvh::build` in a function that runs the statements in `change` before it returns the
    /// tree. They can modify the tree through the variable `bvh`.
    pub fn change_tree(&self, change: &str) {
        self.replace("bvh.rs", "pub fn build(", "fn correct_build(");
        let wrapper = format!(
            "impl Bvh {{ pub fn build(primitives: Vec<Primitive>, max_leaf_size: usize) -> Self {{ \
             let mut bvh = Self::correct_build(primitives, max_leaf_size); {change} bvh }} }}"
        );
        let text = self.read("bvh.rs");
        self.write("bvh.rs", &format!("{text}\n{wrapper}\n"));
    }

    /// Inserts a statement at the beginning of `Camera::sample_ray`.
    pub fn insert_into_camera(&self, statement: &str) {
        let signature = "pub fn sample_ray(&self, pixel: UVec2, offset: Vec2) -> Ray {";
        self.replace("camera.rs", signature, &format!("{signature} {statement}"));
    }

    /// Replaces text in a file. Panics if the file doesn't contain it.
    pub fn replace(&self, file: &str, from: &str, to: &str) {
        let text = self.read(file);
        assert!(text.contains(from), "{file} does not contain {from:?}");
        self.write(file, &text.replace(from, to));
    }
}

/// A response from the viewer.
pub struct Answer {
    pub status: u16,
    pub head: String,
    pub body: Vec<u8>,
}

/// A running viewer, which is killed when this value is dropped.
pub struct Viewer {
    child: Child,
    pub port: u16,
    /// The path of the address that the viewer prints first, including the token.
    pub first: String,
    /// Not read any further, but kept open, as a terminal would be.
    _output: BufReader<ChildStdout>,
    errors: ChildStderr,
}

impl Viewer {
    /// Starts the viewer on a submission, with arguments separated by spaces.
    pub fn start(submission: &Submission, arguments: &str) -> Self {
        Viewer::try_start(submission, arguments).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Starts the viewer like [`Viewer::start`], or returns its error message.
    pub fn try_start(submission: &Submission, arguments: &str) -> Result<Self, String> {
        let mut command = view_of(submission);
        command.arg("--reference-light");
        Viewer::run(command.args(arguments.split_whitespace()))
    }

    /// Starts the viewer on any free port.
    pub fn run(command: &mut Command) -> Result<Self, String> {
        Viewer::spawn(command.args(["--port", "0"]))
    }

    /// Starts the viewer without choosing the port.
    pub fn spawn(command: &mut Command) -> Result<Self, String> {
        let mut child = command
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        let mut output = BufReader::new(child.stdout.take().unwrap());
        let mut errors = child.stderr.take().unwrap();
        output.read_line(&mut line).unwrap();
        if line.is_empty() {
            let mut error = String::new();
            errors.read_to_string(&mut error).unwrap();
            child.wait().unwrap();
            return Err(error);
        }
        let url = line.rsplit_once("open http://127.0.0.1:").unwrap().1.trim();
        let (port, first) = url.split_once('/').unwrap();
        Ok(Viewer {
            port: port.parse().unwrap(),
            first: format!("/{first}"),
            child,
            _output: output,
            errors,
        })
    }

    /// Kills the viewer and returns its standard error.
    pub fn kill(mut self) -> String {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
        let mut errors = String::new();
        self.errors.read_to_string(&mut errors).unwrap();
        errors
    }

    /// Returns the process id.
    #[cfg_attr(not(target_os = "linux"), expect(dead_code, reason = "used on Linux"))]
    pub fn process(&self) -> u32 {
        self.child.id()
    }

    /// Sends a request with these headers and a `Content-Length`.
    pub fn request(&self, method: &str, path: &str, headers: &str, body: &str) -> Answer {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port)).unwrap();
        let length = body.len();
        let head = format!("{method} {path} HTTP/1.1\r\n{headers}Content-Length: {length}\r\n\r\n");
        stream.write_all((head + body).as_bytes()).unwrap();
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        let mut windows = bytes.windows(4);
        let end = windows.position(|end| end == b"\r\n\r\n").unwrap() + 4;
        let head = String::from_utf8(bytes[..end].to_vec()).unwrap();
        Answer {
            status: head.split(' ').nth(1).unwrap().parse().unwrap(),
            head,
            body: bytes[end..].to_vec(),
        }
    }

    /// Returns the headers of the page.
    pub fn headers(&self) -> String {
        let token = self.first.split_once('=').unwrap().1;
        format!("Host: localhost\r\nOrigin: http://localhost\r\nView-Token: {token}\r\n")
    }

    pub fn get(&self, path: &str) -> Answer {
        self.request("GET", path, &self.headers(), "")
    }

    pub fn get_json(&self, path: &str) -> Value {
        serde_json::from_slice(&self.get(path).body).unwrap()
    }

    /// Sends a command as the page does and returns the status.
    pub fn send(&self, command: &Value) -> u16 {
        self.request("POST", "/command", &self.headers(), &command.to_string())
            .status
    }

    /// Sends a command as the page does. The command must be accepted.
    #[track_caller]
    pub fn command(&self, command: &Value) {
        assert_eq!(self.send(command), 204, "{command}");
    }

    /// Waits for an expected state by polling for updates, as the page does.
    #[track_caller]
    pub fn wait_for(&self, is_expected: impl Fn(&Value) -> bool) -> Value {
        let deadline = Instant::now() + TIMEOUT;
        let mut version = 0;
        let mut state = Value::Null;
        while Instant::now() < deadline {
            let answer = self.get(&format!("/state?after={version}"));
            if answer.status == 204 {
                continue;
            }
            state = serde_json::from_slice(&answer.body).unwrap();
            version = state["version"].as_u64().unwrap();
            if is_expected(&state) {
                return state;
            }
        }
        panic!("the state is still {state:#}");
    }

    /// Waits until the complete picture is shown.
    #[track_caller]
    pub fn wait_for_picture(&self) -> Value {
        self.wait_for(|state| state["is_picture_complete"] == true)
    }

    /// Shows another quantity and waits until its complete picture is shown.
    #[track_caller]
    pub fn show(&self, view: &str) -> Value {
        self.command(&json!({ "view": view }));
        self.wait_for(|state| state["view"] == view && state["is_picture_complete"] == true)
    }

    /// Returns the number of pixels whose colour marks a panic.
    pub fn panicked_pixels(&self) -> usize {
        let picture = self.picture().into_iter();
        picture.filter(|pixel| *pixel == [255, 0, 255]).count()
    }

    /// Returns the pixels of the picture, row by row from the top.
    pub fn picture(&self) -> Vec<[u8; 3]> {
        let answer = self.get("/picture");
        let decoder = png::Decoder::new(std::io::Cursor::new(answer.body));
        let mut reader = decoder.read_info().unwrap();
        let mut bytes = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut bytes).unwrap();
        bytes.as_chunks().0.to_vec()
    }

    /// Explains a pixel and waits for the explanation.
    #[track_caller]
    pub fn explain(&self, pixel: [u32; 2], sample: Option<u32>) -> Value {
        let command = json!({ "pick": { "pixel": pixel, "sample": sample } });
        self.command(&command);
        self.explanation()
    }

    /// Waits for the explanation of the pinned ray.
    #[track_caller]
    pub fn explanation(&self) -> Value {
        self.wait_for(|state| {
            assert_eq!(state["explanation_fault"], Value::Null);
            state["explanation"].is_number()
        });
        self.get_json("/explanation")
    }
}

impl Drop for Viewer {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
