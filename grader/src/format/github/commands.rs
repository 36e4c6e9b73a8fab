//! Formats and disables workflow commands: lines of the log that the runner executes
//! (<https://docs.github.com/en/actions/reference/workflows-and-actions/workflow-commands>).

use std::fmt::Write;

use judging::sanitize::sanitize;

/// Returns a command with properties. Everything is sanitized and escaped, so that no text can start
/// another command.
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
    sanitize(text, usize::MAX)
        .replace('%', "%25")
        .replace('\r', "%0D")
        .replace('\n', "%0A")
}

fn escape_property(text: &str) -> String {
    escape_message(text).replace(':', "%3A").replace(',', "%2C")
}

/// Wraps a text so that the runner ignores all commands in it. The text must not contain `token`,
/// which marks the end.
pub fn with_commands_stopped(text: &str, token: &str) -> String {
    format!("::stop-commands::{token}\n{text}\n::{token}::\n")
}

/// Returns a token that a submission cannot guess.
pub fn random_token() -> Result<String, getrandom::Error> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes)?;
    let mut token = String::new();
    for byte in bytes {
        write!(token, "{byte:02x}").expect("writing to a string cannot fail");
    }
    Ok(token)
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
            "::error file=a%2Cb%3Ac.rs::100%25\\r%0A::set-output name=x::y\n"
        );
        assert_eq!(line.lines().count(), 1);
    }

    #[test]
    fn tokens_are_long_and_differ() {
        let (one, other) = (random_token().unwrap(), random_token().unwrap());
        assert!(one.len() == 32 && one != other);
    }

    #[test]
    fn commands_are_stopped_around_a_text() {
        let text = with_commands_stopped("::error::mine", "token");
        assert_eq!(text, "::stop-commands::token\n::error::mine\n::token::\n");
    }
}
