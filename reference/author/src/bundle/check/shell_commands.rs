//! Extracts the commands that Markdown documents show.

/// Returns the distinct commands in the documents' `sh` blocks, one per line, split into words and
/// without comments.
pub(super) fn commands<'a>(texts: impl Iterator<Item = &'a str>) -> Vec<Vec<String>> {
    let mut commands = Vec::new();
    for text in texts {
        let mut inside = false;
        for line in text.lines() {
            if let Some(fence) = line.strip_prefix("```") {
                inside = !inside && fence == "sh";
                continue;
            }
            let line = line.split(" #").next().unwrap_or(line);
            let words: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
            if inside && !words.is_empty() && !commands.contains(&words) {
                commands.push(words);
            }
        }
    }
    commands
}

#[cfg(test)]
mod tests {
    use super::commands;

    #[test]
    fn reads_each_line_of_a_shell_block_without_its_comment() {
        let text = "Say `x`:\n```sh\ncargo grade # all\n\ncargo grade\n```\n```text\nno\n```\n";
        assert_eq!(commands([text].into_iter()), [["cargo", "grade"]]);
    }
}
