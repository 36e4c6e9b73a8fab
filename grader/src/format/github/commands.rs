//! Formats workflow commands: lines of the log that the runner executes
//! (<https://docs.github.com/en/actions/reference/workflows-and-actions/workflow-commands>).

use judging::sanitize::sanitize;

use crate::machine::printing::without_commands;

/// Returns a command with properties. Everything is sanitized and escaped, so that no text can
/// start another command.
pub fn command(name: &str, properties: &[(&str, String)], message: &str) -> String {
    let properties = properties.iter();
    let properties: Vec<String> = properties
        .map(|(key, value)| format!("{key}={}", escape_property(value)))
        .collect();
    format!(
        "::{name} {}::{}\n",
        properties.join(","),
        escape_message(message)
    )
}

fn escape_message(text: &str) -> String {
    without_commands(&sanitize(text, usize::MAX))
        .replace('%', "%25")
        .replace('\r', "%0D")
        .replace('\n', "%0A")
}

fn escape_property(text: &str) -> String {
    escape_message(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_text_can_end_its_command_or_start_another() {
        let file = [("file", "a,b:c.rs".to_owned())];
        let line = command("error", &file, "100%\r\n::set-output name=x::y");
        assert_eq!(
            line,
            "::error file=a%2Cb%3Ac.rs::100%25\\r%0A:\\:set-output name=x::y\n"
        );
        assert_eq!(line.lines().count(), 1);
    }
}
