//! Finds the scene file and chooses the picture's path.

use std::env;
use std::path::{Path, PathBuf};

use glam::UVec2;

use super::error::RenderError;
use super::options::Options;
use super::parallel::RenderPool;
use crate::suggestion::suggestion;

/// The name of the folder of scenes. Its parent folder is assumed to be the workspace's root.
const SCENES: &str = "scenes";

/// Finds a scene file. The path is tried relative to the current folder, the workspace's root and
/// the folder of scenes. `.json` can be omitted.
pub(super) fn find_scene(scene: &Path) -> Result<PathBuf, RenderError> {
    let here = env::current_dir().unwrap_or_default();
    let root = workspace_root(&here);
    let mut candidates = vec![scene.to_owned()];
    if let Some(root) = root {
        candidates.extend([root.join(scene), root.join(SCENES).join(scene)]);
    }
    let with_extension = |path: &PathBuf| [path.clone(), path.with_added_extension("json")];
    let found = candidates
        .iter()
        .flat_map(with_extension)
        .find(|path| path.is_file());
    found.ok_or_else(|| {
        let known = root.map(scene_names).unwrap_or_default();
        let name = scene.file_stem().unwrap_or_default().to_string_lossy();
        let mut message = format!("cannot find the scene {}", scene.display());
        if !known.is_empty() {
            let (suggestion, known) = (suggestion(&name, &known), known.join(", "));
            message += &format!("{suggestion}; the `scenes` folder contains: {known}");
        }
        RenderError::Other(message)
    })
}

fn workspace_root(here: &Path) -> Option<&Path> {
    let mut folders = here.ancestors();
    folders.find(|folder| folder.join(SCENES).is_dir())
}

/// Returns the sorted names of the scenes in a workspace.
fn scene_names(root: &Path) -> Vec<String> {
    let entries = root.join(SCENES).read_dir().into_iter().flatten().flatten();
    let paths = entries.map(|entry| entry.path());
    let mut names: Vec<String> = paths
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "json")
        })
        .filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
        .collect();
    names.sort();
    names
}

/// Returns the path of the file that stores a scene's last measurement at this size and with this
/// number of threads. The file is in the workspace's target folder.
pub(super) fn bench_file(scene: &Path, pool: &RenderPool) -> PathBuf {
    let here = env::current_dir().unwrap_or_default();
    let root = workspace_root(&here).unwrap_or(&here);
    let name = scene.file_stem().unwrap_or_default().to_string_lossy();
    let (UVec2 { x, y }, threads) = (pool.size(), pool.threads());
    let file = format!("{name}-{x}x{y}-{threads}.txt");
    root.join("target/bench").join(file)
}

/// Returns the path of the picture, after checking its format and its folder. Call this before
/// rendering, because an error afterwards would waste the finished picture.
pub(super) fn output_path(options: &Options, scene: &Path) -> Result<PathBuf, RenderError> {
    let given = options.out.as_ref().or(options.out_option.as_ref());
    let out = match given {
        Some(out) => out.clone(),
        None => PathBuf::from(scene.file_stem().unwrap_or_default()).with_added_extension("png"),
    };
    let format = image::ImageFormat::from_path(&out).ok();
    if !matches!(
        format,
        Some(image::ImageFormat::Png | image::ImageFormat::OpenExr)
    ) {
        return Err(RenderError::Other(format!(
            "cannot write {}: use a file name that ends in .png or .exr",
            out.display()
        )));
    }
    match out.parent() {
        Some(folder) if !folder.as_os_str().is_empty() && !folder.is_dir() => {
            let folder = folder.display();
            let message = format!("cannot write to the folder {folder}: it does not exist");
            Err(RenderError::Other(message))
        }
        Some(_) | None => Ok(out),
    }
}
