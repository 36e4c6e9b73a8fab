//! Links that open the submission's files in an editor.

use std::env;
use std::path::{Path, absolute};

use grader::handed_out::HandedOut;
use grader::workspace::Workspace;
use grader::workspace::source_paths::SourcePaths;
use serde::Serialize;

/// The location of the submission's files.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SourceLinks {
    /// The names of the files.
    files: Vec<&'static str>,
    /// The folder as shown on the page, relative to the workspace. Empty if the folder is outside
    /// the workspace.
    shown: String,
    /// The beginning of an address that opens one of this machine's files in the editor. The path
    /// is appended to it.
    editor: String,
    /// The absolute path of the folder, with `/` between its parts.
    folder: String,
}

impl SourceLinks {
    /// Finds the files of the submission in this folder. Returns `None` if they cannot be opened,
    /// for example because they are in an archive.
    pub fn find(
        submission: &Path,
        workspace: &Workspace,
        handed_out: &'static HandedOut,
    ) -> Option<Self> {
        let paths = SourcePaths::of(submission, handed_out);
        let folder = absolute(paths.folder()?).ok()?;
        let root = absolute(workspace.root()).ok()?;
        let below = folder.strip_prefix(root).map(with_slashes);
        Some(SourceLinks {
            files: handed_out.file_names().collect(),
            shown: below.map(|below| below + "/").unwrap_or_default(),
            editor: editor(),
            folder: format!("/{}/", with_slashes(&folder).trim_start_matches('/')),
        })
    }
}

fn with_slashes(path: &Path) -> String {
    path.display().to_string().replace('\\', "/")
}

/// Returns the beginning of the addresses that open files in the editor. In WSL, the editor usually
/// runs on Windows, outside this machine.
fn editor() -> String {
    match env::var("WSL_DISTRO_NAME") {
        Ok(name) => format!("vscode://vscode-remote/wsl+{name}"),
        Err(_) => "vscode://file".to_owned(),
    }
}
