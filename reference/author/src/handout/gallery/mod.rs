//! The gallery of pictures: each chapter shows a correct picture beside the pictures that known
//! mistakes produce.

mod pictures;

use std::path::Path;

use anyhow::{Context, Result};
use grader::handed_out::HandedOut;
use judging::section::CHAPTERS;
use serde::Deserialize;

use crate::authoring::Authoring;
use crate::generated_file::GeneratedFile;
use crate::solutions::catalogue::{Mistake, mistakes};
use crate::solutions::read_toml;

pub use pictures::write_or_check;

/// The list of pictures, relative to the folder of an assignment's solutions.
const LIST: &str = "mistakes/gallery.toml";
/// The line below the text about a chapter's pictures.
const END: &str = "<!-- end of the gallery -->";

/// The pictures of all chapters.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Gallery {
    chapter: Vec<Chapter>,
}

/// The pictures of a chapter, all of the same scene.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Chapter {
    /// The chapter's page, such as `sphere.md` or `light/glass.md`.
    page: String,
    /// A sentence that says when to draw the picture.
    when: String,
    /// The name of a scene, such as `cornell-box`.
    scene: String,
    /// The options of `cargo render`, such as `--view normals`.
    #[serde(default)]
    options: String,
    /// A description of the correct picture.
    shows: String,
    /// The known mistakes, in the order of their pictures.
    mistakes: Vec<String>,
}

impl Chapter {
    /// The path of the sheet with all pictures, relative to the chapters' folder.
    fn sheet(&self) -> String {
        let name = self.page.rsplit('/').next().unwrap_or_default();
        format!("figures/{}", name.replace(".md", "-gallery.png"))
    }

    /// The link to the sheet, relative to the chapter's folder.
    fn link(&self) -> String {
        "../".repeat(self.page.matches('/').count()) + &self.sheet()
    }

    /// The command that draws the picture, as students type it.
    fn command(&self) -> String {
        let command = format!("cargo render scenes/{}.json {}", self.scene, self.options);
        command.trim_end().to_owned()
    }

    /// The text below the heading: the command, the sheet and a caption for each picture.
    fn text(&self, catalogue: &[Mistake]) -> Result<String> {
        let captions = self.mistakes.iter().enumerate().map(|(index, id)| {
            let mistake = catalogue.iter().find(|mistake| mistake.id == *id);
            let mistake = mistake.with_context(|| format!("{LIST}: unknown mistake `{id}`"))?;
            Ok(format!("{}. The code {}.", index + 2, mistake.title))
        });
        let captions = captions.collect::<Result<Vec<_>>>()?.join("\n");
        Ok(format!(
            "{}\n\n```sh\n{}\n```\n\nYou should see the first picture, {}. The others were drawn by \
             incorrect code and are numbered row by row.\n\n![The right picture, followed by {} \
             wrong ones. Each is described below.]({})\n\n<details><summary>What causes each wrong picture\
             </summary>\n\n1. The right picture.\n{captions}\n\n</details>",
            self.when,
            self.command(),
            self.shows,
            self.mistakes.len(),
            self.link()
        ))
    }
}

/// Returns the line above the text about a chapter's pictures.
fn begin(handed_out: &HandedOut) -> String {
    format!("<!-- generated from {}/{LIST} -->", handed_out.solutions())
}

/// Reads the list of an assignment's pictures.
fn gallery(root: &Path, authoring: &Authoring) -> Result<Gallery> {
    read_toml(&root.join(authoring.handed_out.solutions()).join(LIST))
}

/// Returns the chapters with the text about their pictures regenerated.
pub fn with_pictures(
    root: &Path,
    authoring: &Authoring,
    mut chapters: Vec<GeneratedFile>,
) -> Result<Vec<GeneratedFile>> {
    let catalogue = mistakes(root, authoring.handed_out)?;
    let begin = begin(authoring.handed_out);
    for chapter in gallery(root, authoring)?.chapter {
        let path = format!("{CHAPTERS}/{}", chapter.page);
        let page = chapters.iter_mut().find(|file| file.path == path);
        let page =
            page.with_context(|| format!("{LIST}: no task has the chapter {}", chapter.page))?;
        let (before, after) = page.contents.split_once(&begin).unwrap_or_default();
        let end = after.find(END);
        let end = end.with_context(|| format!("{path} needs the lines {begin:?} and {END:?}"))?;
        let text = chapter.text(&catalogue)?;
        page.contents = format!("{before}{begin}\n{text}\n{}", &after[end..]);
    }
    Ok(chapters)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::authoring::ASSIGNMENTS;

    fn chapter(mistake: &str) -> Chapter {
        Chapter {
            page: "sphere.md".to_owned(),
            when: "Draw this now:".to_owned(),
            scene: "spheres".to_owned(),
            options: "--view uv".to_owned(),
            shows: "three balls".to_owned(),
            mistakes: vec![mistake.to_owned()],
        }
    }

    #[test]
    fn the_line_above_the_pictures_names_their_list() {
        let lines = ASSIGNMENTS.map(|authoring| begin(authoring.handed_out));
        let list = |folder| format!("<!-- generated from {folder}/mistakes/gallery.toml -->");
        assert_eq!(lines, ["reference", "reference/light"].map(list));
    }

    #[test]
    fn the_link_to_a_sheet_is_relative_to_the_chapters_folder() {
        let known = Mistake {
            id: "glass.straight".to_owned(),
            ..Mistake::default()
        };
        let mut chapter = chapter("glass.straight");
        for (page, link) in [
            ("glass.md", "(figures/glass-gallery.png)"),
            ("light/glass.md", "(../figures/glass-gallery.png)"),
        ] {
            chapter.page = page.to_owned();
            let text = chapter.text(std::slice::from_ref(&known));
            let text = text.expect("the mistake is known");
            assert!(text.contains(link), "{text}");
            assert_eq!(chapter.sheet(), "figures/glass-gallery.png");
        }
    }

    #[test]
    fn a_command_without_options_ends_with_the_scene() {
        let mut chapter = chapter("");
        assert_eq!(
            chapter.command(),
            "cargo render scenes/spheres.json --view uv"
        );
        chapter.options.clear();
        assert_eq!(chapter.command(), "cargo render scenes/spheres.json");
    }

    #[test]
    fn a_caption_is_the_title_of_a_known_mistake() {
        let mistake = Mistake {
            id: "sphere.radius_one".to_owned(),
            title: "assumes a radius of 1".to_owned(),
            ..Mistake::default()
        };
        let text = chapter("sphere.radius_one").text(std::slice::from_ref(&mistake));
        let text = text.expect("the mistake is known");
        let command = "```sh\ncargo render scenes/spheres.json --view uv\n```";
        assert!(text.contains(command), "{text}");
        assert!(
            text.contains("2. The code assumes a radius of 1."),
            "{text}"
        );
        let error = chapter("sphere.radius_two")
            .text(&[mistake])
            .expect_err("no such mistake");
        assert_eq!(
            error.to_string(),
            "mistakes/gallery.toml: unknown mistake `sphere.radius_two`"
        );
    }
}
