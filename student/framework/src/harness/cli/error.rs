//! Errors of the render command, as shown to the user.

use std::fmt;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use glam::UVec2;
use protocol::Panic;

use crate::scene::SceneError;
use crate::suggestion::suggestion;

/// An error that prevents a picture from being rendered or written.
#[derive(Debug, thiserror::Error)]
pub(super) enum RenderError {
    #[error("cannot find the scene {}{}", .path.display(), list_of_scenes(.path, .known))]
    SceneNotFound { path: PathBuf, known: Vec<String> },
    #[error("{0}")]
    Scene(#[from] SceneError),
    #[error("cannot write {}: use a file name that ends in .png or .exr", .0.display())]
    UnknownFormat(PathBuf),
    #[error("cannot write to the folder {}: it does not exist", .0.display())]
    FolderNotFound(PathBuf),
    #[error("pixel {pixel} is outside the film, which has {} x {} pixels", .size.x, .size.y)]
    PixelOutsideFilm { pixel: UVec2, size: UVec2 },
    #[error("cannot start threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    #[error("cannot start a thread: {0}")]
    Thread(std::io::Error),
    #[error("cannot write {}: {source}", .path.display())]
    Unwritable {
        path: PathBuf,
        source: image::ImageError,
    },
    #[error("{0}")]
    SubmissionPanic(SubmissionPanic),
}

/// A panic in the submission's code.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct SubmissionPanic {
    pub(super) panic: Panic,
    /// The pixel that was being rendered, if any.
    pub(super) pixel: Option<UVec2>,
}

impl RenderError {
    pub(super) fn exit_code(&self) -> ExitCode {
        match self {
            RenderError::SubmissionPanic(_) => ExitCode::from(1),
            RenderError::SceneNotFound { .. }
            | RenderError::Scene(_)
            | RenderError::UnknownFormat(_)
            | RenderError::FolderNotFound(_)
            | RenderError::PixelOutsideFilm { .. }
            | RenderError::Threads(_)
            | RenderError::Thread(_)
            | RenderError::Unwritable { .. } => ExitCode::from(2),
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

/// Returns the command that examines a pixel, for a picture that these arguments render.
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

/// Returns the last part of an error message: the scene that may be meant, and a list of the known
/// scenes.
fn list_of_scenes(path: &Path, known: &[String]) -> String {
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    match known {
        [] => String::new(),
        known => format!(
            "{}; the folder `scenes` contains: {}",
            suggestion(&name, known),
            known.join(", ")
        ),
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

    #[test]
    fn reports_the_message_of_any_other_panic() {
        assert_eq!(
            message("index out of bounds"),
            "panicked: index out of bounds (student/src/camera.rs:47:9)"
        );
    }
}
