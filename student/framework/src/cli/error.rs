//! Why there is no picture, in the user's words.

use std::fmt;
use std::path::PathBuf;
use std::process::ExitCode;

use glam::UVec2;
use protocol::Panic;

use crate::scene::SceneError;

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub(super) enum RenderError {
    #[error("{}: no such scene{}", .path.display(), list_of_scenes(.known))]
    SceneNotFound { path: PathBuf, known: Vec<String> },
    #[error("{0}")]
    Scene(#[from] SceneError),
    #[error("{}: end the picture's name with .png or .exr", .0.display())]
    UnknownFormat(PathBuf),
    #[error("{}: there is no such folder to write to", .0.display())]
    FolderNotFound(PathBuf),
    #[error("pixel {pixel} is outside of the film of {} x {}", .size.x, .size.y)]
    PixelOutsideFilm { pixel: UVec2, size: UVec2 },
    #[error("can not start threads: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    #[error("{}: can not be written: {source}", .path.display())]
    Unwritable {
        path: PathBuf,
        source: image::ImageError,
    },
    #[error("{0}")]
    Accident(SubmissionPanic),
}

/// A panic of the submission's code.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct SubmissionPanic {
    pub(super) panic: Panic,
    /// Where in the picture, if it was in the picture.
    pub(super) pixel: Option<UVec2>,
}

impl RenderError {
    pub(super) fn exit_code(&self) -> ExitCode {
        match self {
            RenderError::Accident(_) => ExitCode::from(1),
            RenderError::SceneNotFound { .. }
            | RenderError::Scene(_)
            | RenderError::UnknownFormat(_)
            | RenderError::FolderNotFound(_)
            | RenderError::PixelOutsideFilm { .. }
            | RenderError::Threads(_)
            | RenderError::Unwritable { .. } => ExitCode::from(2),
        }
    }
}

impl fmt::Display for SubmissionPanic {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let Panic {
            message,
            location: place,
        } = &self.panic;
        if self.panic.is_unimplemented() {
            // `todo!("task 1, camera: which ray ...")`: the task, without the question.
            let task = message.split(": ").nth(1).unwrap_or("this part");
            return write!(f, "{task}: not written yet ({place})");
        }
        write!(f, "panicked: {message} ({place})")?;
        let Some(pixel) = self.pixel else {
            return Ok(());
        };
        let arguments: Vec<String> = std::env::args().skip(1).collect();
        let (UVec2 { x, y }, arguments) = (pixel, arguments.join(" "));
        write!(
            f,
            "\n  at pixel {pixel}; again: cargo render {arguments} --pixel {x},{y}"
        )
    }
}

fn list_of_scenes(known: &[String]) -> String {
    match known {
        [] => String::new(),
        known => format!("; the folder `scenes` holds: {}", known.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(message: &str) -> String {
        let panic = Panic {
            message: message.to_owned(),
            location: "student/src/camera.rs:47".to_owned(),
        };
        SubmissionPanic { panic, pixel: None }.to_string()
    }

    #[test]
    fn reports_an_unwritten_task_in_one_line() {
        let line =
            message("not yet implemented: task 1, camera: which ray of Camera { film: [1] }?");
        assert_eq!(
            line,
            "task 1, camera: not written yet (student/src/camera.rs:47)"
        );
        assert_eq!(
            message("not yet implemented"),
            "this part: not written yet (student/src/camera.rs:47)"
        );
    }

    #[test]
    fn reports_the_message_of_any_other_panic() {
        assert_eq!(
            message("index out of bounds"),
            "panicked: index out of bounds (student/src/camera.rs:47)"
        );
    }
}
