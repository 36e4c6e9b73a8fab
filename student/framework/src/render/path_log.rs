//! A log of one path: what the path tracer asks about the scene, and the answers.

use std::cell::RefCell;

thread_local! {
    /// The lines so far, or `None` while no path is followed.
    static LINES: RefCell<Option<Vec<String>>> = const { RefCell::new(None) };
}

/// Runs code that traces a path. Returns its result and the lines that it logs, in order.
pub fn follow<T>(path: impl FnOnce() -> T) -> (T, Vec<String>) {
    LINES.set(Some(Vec::new()));
    let value = path();
    (value, LINES.take().unwrap_or_default())
}

/// Adds a line to the log if a path is followed. Otherwise, the line isn't created.
pub fn log(line: impl FnOnce() -> String) {
    LINES.with_borrow_mut(|lines| {
        if let Some(lines) = lines {
            lines.push(line());
        }
    });
}

/// Returns the number of lines so far. It is 0 if no path is followed.
pub fn line_count() -> usize {
    LINES.with_borrow(|lines| lines.as_ref().map_or(0, Vec::len))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_only_kept_while_a_path_is_followed() {
        log(|| unreachable!("no path is followed"));
        let (value, lines) = follow(|| {
            log(|| "a hit".to_owned());
            log(|| "a miss".to_owned());
            assert_eq!(line_count(), 2);
            7
        });
        assert_eq!(
            (value, lines),
            (7, ["a hit", "a miss"].map(str::to_owned).to_vec())
        );
        assert_eq!((follow(|| ()).1, line_count()), (Vec::new(), 0));
    }
}
