//! Errors from the render command, as shown to the user.

use std::fmt;
use std::process::ExitCode;

use glam::UVec2;
use protocol::Panic;

use crate::harness::attempt::attempt;
use crate::scene::SceneError;

/// An error that prevents a picture from being rendered or written.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum RenderError {
    /// The submission's code panicked.
    Panicked(SubmissionPanic),
    /// The message for any other error, such as a scene that doesn't exist.
    Other(String),
}

/// A panic in the submission's code.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct SubmissionPanic {
    pub(super) panic: Panic,
    /// The pixel that was being rendered, if any.
    pub(super) pixel: Option<UVec2>,
}

/// Calls the submission's code. A panic becomes an error that names the pixel being rendered, if
/// any.
pub(super) fn call<T>(pixel: Option<UVec2>, code: impl FnOnce() -> T) -> Result<T, RenderError> {
    attempt(code).map_err(|panic| RenderError::Panicked(SubmissionPanic { panic, pixel }))
}

impl RenderError {
    /// Creates the error to report if threads cannot be started.
    pub(super) fn threads(error: impl fmt::Display) -> Self {
        RenderError::Other(format!("cannot start threads: {error}"))
    }

    pub(super) fn exit_code(&self) -> ExitCode {
        match self {
            RenderError::Panicked(_) => ExitCode::from(1),
            RenderError::Other(_) => ExitCode::from(2),
        }
    }
}

impl From<SceneError> for RenderError {
    fn from(error: SceneError) -> Self {
        RenderError::Other(error.to_string())
    }
}

impl fmt::Display for RenderError {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            RenderError::Panicked(panic) => panic.fmt(f),
            RenderError::Other(message) => f.write_str(message),
        }
    }
}

impl fmt::Display for SubmissionPanic {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Panic { message, location } = &self.panic;
        if self.panic.is_unimplemented() {
            // For `todo!("task 1, camera: which ray ...")`, prints the task without the question.
            let task = message.split(": ").nth(1).unwrap_or("this part");
            return write!(f, "{task}: not written yet ({location})");
        }
        write!(f, "panicked: {message} ({location})")?;
        let Some(pixel) = self.pixel else {
            return Ok(());
        };
        let arguments = std::env::args_os().skip(1);
        let arguments = arguments.map(|argument| argument.to_string_lossy().into_owned());
        let command = pixel_command(&arguments.collect::<Vec<_>>(), pixel);
        write!(f, "\n  at pixel {pixel}; rerun with: {command}")
    }
}

/// Returns the command for examining a pixel of the picture rendered with these arguments.
fn pixel_command(arguments: &[String], UVec2 { x, y }: UVec2) -> String {
    let mut words = vec![format!("cargo render --pixel {x},{y}")];
    let mut arguments = arguments.iter();
    while let Some(argument) = arguments.next() {
        if argument == "--pixel" {
            arguments.next();
        } else if !argument.starts_with("--pixel=") {
            words.push(shell_word(argument));
        }
    }
    words.join(" ")
}

/// Quotes an argument for a command line, if necessary.
fn shell_word(text: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "_-./:\\+,@%=".contains(c);
    if !text.is_empty() && text.chars().all(is_plain) {
        text.to_owned()
    } else {
        format!("'{}'", text.replace('\'', r"'\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(message: &str) -> String {
        let panic = Panic {
            message: message.to_owned(),
            location: "student/src/camera.rs:47:9".to_owned(),
        };
        SubmissionPanic { panic, pixel: None }.to_string()
    }

    #[test]
    fn reports_an_unwritten_task_in_one_line() {
        let line =
            message("not yet implemented: task 1, camera: which ray of Camera { film: [1] }?");
        assert_eq!(
            line,
            "task 1, camera: not written yet (student/src/camera.rs:47:9)"
        );
        assert_eq!(
            message("not yet implemented"),
            "this part: not written yet (student/src/camera.rs:47:9)"
        );
    }

    #[test]
    fn the_command_for_a_pixel_can_be_copied_into_a_terminal() {
        let command = |arguments: &[&str]| {
            let arguments: Vec<String> = arguments.iter().map(ToString::to_string).collect();
            pixel_command(&arguments, UVec2::new(6, 4))
        };
        assert_eq!(
            command(&["cornell", "my picture.png", "--size", "8x8"]),
            "cargo render --pixel 6,4 cornell 'my picture.png' --size 8x8"
        );
        for before in [["--pixel", "1,2"].as_slice(), &["--pixel=1,2"]] {
            let again = command(&[before, &["it's"]].concat());
            assert_eq!(again, r"cargo render --pixel 6,4 'it'\''s'");
        }
    }
}
