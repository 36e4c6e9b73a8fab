//! Arranges a report on a terminal that may be too small for it.

use judging::assignment::Task;

use crate::report::text::ReportParts;

/// Everything shown on one page.
#[derive(Clone, Copy)]
pub(super) struct Page<'a> {
    /// The phase of grading.
    pub(super) status: &'a str,
    pub(super) report: &'a ReportParts,
    /// The next step, if any.
    pub(super) next: &'a str,
    /// The table on one line.
    pub(super) short_table: &'a str,
    /// Returns a line that says how to see the rest of the report. The argument is the task that
    /// the first hidden line is about.
    pub(super) rest: &'a dyn Fn(Option<Task>) -> String,
}

/// A line and the task it is about.
type Line = (String, Option<Task>);

/// Returns at most `rows` lines. If even the first failing item doesn't fit, it comes first and the
/// table shrinks to one line below it.
pub(super) fn fit(page: &Page, rows: usize) -> Vec<String> {
    let lines = arrange(page, rows).into_iter();
    lines.map(|(line, _)| line).collect()
}

fn arrange(page: &Page, rows: usize) -> Vec<Line> {
    let ReportParts {
        headline,
        table,
        details,
    } = page.report;
    let mut whole = vec![line(page.status), line("")];
    whole.extend(headline.lines().chain(table.lines()).map(line));
    let before_details = whole.len();
    for detail in details {
        let lines = detail.text.lines();
        whole.extend(lines.map(|line| (line.to_owned(), detail.task)));
    }
    let details = &whole[before_details..];
    let first_item = details.iter().skip(1).take_while(|line| !is_empty(line));
    let first_item = first_item.count();
    let mut short: Vec<Line> = details
        .iter()
        .skip_while(|line| is_empty(line))
        .cloned()
        .collect();

    let next = page.next.lines().map(line).filter(|line| !is_empty(line));
    if !page.next.is_empty() {
        whole.push(line(""));
        whole.extend(next.clone());
    }
    if whole.len() <= rows {
        return whole;
    }
    if first_item > 0 && before_details + 1 + first_item < rows {
        return cut(whole, rows, page);
    }
    if short.is_empty() {
        short = next.collect();
    }
    short.insert(0, line(page.status));
    let mut lines = cut(short, rows.saturating_sub(1), page);
    lines.push(line(page.short_table));
    lines.truncate(rows);
    lines
}

/// Returns the lines that fit. If some lines don't fit, the last line says how to see them.
fn cut(mut lines: Vec<Line>, rows: usize, page: &Page) -> Vec<Line> {
    if lines.len() > rows {
        let rest = lines.split_off(rows.saturating_sub(1));
        let task = rest.first().and_then(|(_, task)| *task);
        lines.push(((page.rest)(task), task));
    }
    lines
}

fn line(text: &str) -> Line {
    (text.to_owned(), None)
}

fn is_empty((line, _): &Line) -> bool {
    line.is_empty()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::text::Detail;

    fn lines(details: usize, rows: usize) -> Vec<String> {
        let numbered = |name: &str, count: usize| -> String {
            (0..count).map(|line| format!("{name} {line}\n")).collect()
        };
        let report = ReportParts {
            headline: "headline\n\n".to_owned(),
            table: numbered("task", 6),
            details: vec![Detail {
                task: None,
                text: format!("\n{}", numbered("detail", details)),
            }],
        };
        let page = Page {
            status: "status",
            report: &report,
            next: "next\n\n",
            short_table: "short table",
            rest: &|_| "rest".to_owned(),
        };
        fit(&page, rows)
    }

    #[test]
    fn a_large_terminal_shows_everything() {
        let all = lines(3, 16);
        assert_eq!(all.len(), 16);
        assert_eq!(all[2..5], ["headline", "", "task 0"]);
        assert_eq!(all[11..], ["detail 0", "detail 1", "detail 2", "", "next"]);
        let cut = lines(3, 15);
        assert_eq!(cut[11..], ["detail 0", "detail 1", "detail 2", "rest"]);
    }

    #[test]
    fn a_small_terminal_shows_the_failing_item_first_and_a_short_table() {
        for (details, rows, expected) in [
            (
                9,
                6,
                "status, detail 0, detail 1, detail 2, rest, short table",
            ),
            (
                4,
                6,
                "status, detail 0, detail 1, detail 2, detail 3, short table",
            ),
            (0, 5, "status, next, short table"),
        ] {
            assert_eq!(lines(details, rows).join(", "), expected);
        }
    }

    #[test]
    fn never_returns_more_lines_than_rows() {
        for rows in 0..30 {
            assert!(lines(9, rows).len() <= rows, "{rows}");
        }
    }

    #[test]
    fn the_line_about_the_rest_names_the_task_that_is_cut() {
        let [one, two] = ["one.x", "two.x"].map(|id| Task::in_id(id).unwrap());
        let detail = |task: Task, lines: &str| Detail {
            task: Some(task),
            text: format!("\n{lines}"),
        };
        let report = ReportParts {
            headline: "headline\n\n".to_owned(),
            table: "table\n".to_owned(),
            details: vec![detail(one, "1\n2\n"), detail(two, "3\n4\n")],
        };
        let page = Page {
            status: "status",
            report: &report,
            next: "",
            short_table: "short table",
            rest: &|task| task.map_or("none".to_owned(), |task| task.to_string()),
        };
        let last = |rows| fit(&page, rows).pop().unwrap();
        assert_eq!(fit(&page, 11).len(), 11);
        // With ten rows, a line of the second task doesn't fit.
        assert_eq!([11, 10, 9].map(last), ["4", "two", "two"]);
        // With fewer rows, the table shrinks, and a line of the first task doesn't fit either.
        assert_eq!(fit(&page, 4), ["status", "1", "one", "short table"]);
    }
}
