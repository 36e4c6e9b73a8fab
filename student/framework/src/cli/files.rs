//! Which scene is meant, and where the picture goes.

use std::env;
use std::path::{Path, PathBuf};

use super::error::RenderError;
use super::options::Options;

/// The folder of scenes, beside which a workspace's root is known.
const SCENES: &str = "scenes";

/// The scene's file: relative to where we are, then to the workspace around us; then by its name
/// alone, in the workspace's folder of scenes. `.json` may be left out.
pub(super) fn find_scene(asked: &Path) -> Result<PathBuf, RenderError> {
    let here = env::current_dir().unwrap_or_default();
    let root = here.ancestors().find(|folder| folder.join(SCENES).is_dir());
    let mut places = vec![asked.to_owned()];
    if let Some(root) = root {
        places.extend([root.join(asked), root.join(SCENES).join(asked)]);
    }
    let with_ending = |place: &PathBuf| [place.clone(), place.with_added_extension("json")];
    let found = places
        .iter()
        .flat_map(with_ending)
        .find(|place| place.is_file());
    found.ok_or_else(|| RenderError::SceneNotFound {
        path: asked.to_owned(),
        known: root.map(scene_names).unwrap_or_default(),
    })
}

fn scene_names(root: &Path) -> Vec<String> {
    let entries = root.join(SCENES).read_dir().into_iter().flatten().flatten();
    let paths = entries.map(|entry| entry.path());
    let mut names: Vec<String> = paths
        .filter(|path| path.extension().is_some_and(|ending| ending == "json"))
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
        .collect();
    names.sort();
    names
}

/// Where the picture goes. Looked at before anything is drawn: it would be a pity after.
pub(super) fn output_path(options: &Options, scene: &Path) -> Result<PathBuf, RenderError> {
    let asked = options.out.as_ref().or(options.out_option.as_ref());
    let out = match asked {
        Some(out) => out.clone(),
        None => PathBuf::from(scene.file_stem().unwrap_or_default()).with_added_extension("png"),
    };
    let format = image::ImageFormat::from_path(&out).ok();
    if !matches!(
        format,
        Some(image::ImageFormat::Png | image::ImageFormat::OpenExr)
    ) {
        return Err(RenderError::UnknownFormat(out));
    }
    match out.parent() {
        Some(folder) if !folder.as_os_str().is_empty() && !folder.is_dir() => {
            Err(RenderError::FolderNotFound(folder.to_owned()))
        }
        Some(_) | None => Ok(out),
    }
}
