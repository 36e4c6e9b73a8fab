//! Arranges a report on a terminal that may be too small for it.

use crate::report::text::ReportParts;

/// Everything that one page shows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Page<'a> {
    /// The phase of grading.
    pub(super) status: &'a str,
    pub(super) report: &'a ReportParts,
    /// The next step, if there is one.
    pub(super) next: &'a str,
    /// The table in one line.
    pub(super) short_table: &'a str,
    /// How to see what does not fit.
    pub(super) rest: &'a str,
}

/// Returns at most `rows` lines. If not even the first failing item fits, it comes first, and the
/// table shrinks to a line below it.
pub(super) fn fit<'a>(page: &Page<'a>, rows: usize) -> Vec<&'a str> {
    let ReportParts {
        headline,
        table,
        details,
    } = page.report;
    let mut whole = vec![page.status, ""];
    let parts = [headline, table, details];
    whole.extend(parts.into_iter().flat_map(|part| part.lines()));
    if !page.next.is_empty() {
        whole.push("");
        whole.extend(page.next.lines().filter(|line| !line.is_empty()));
    }
    if whole.len() <= rows {
        return whole;
    }
    let before_details = 2 + headline.lines().count() + table.lines().count();
    let first_item = details.lines().skip(1).take_while(|line| !line.is_empty());
    let first_item = first_item.count();
    if first_item > 0 && before_details + 1 + first_item < rows {
        whole.truncate(rows - 1);
        whole.push(page.rest);
        return whole;
    }
    let mut details: Vec<&str> = details.lines().skip_while(|line| line.is_empty()).collect();
    if details.is_empty() {
        details = page.next.lines().filter(|line| !line.is_empty()).collect();
    }
    let around = [page.status, page.short_table].len();
    let space = rows.saturating_sub(around);
    let mut lines = vec![page.status];
    if details.len() <= space {
        lines.extend(details);
    } else {
        lines.extend(&details[..space.saturating_sub(1)]);
        lines.push(page.rest);
    }
    lines.push(page.short_table);
    lines.truncate(rows);
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(details: usize, rows: usize) -> Vec<String> {
        let numbered = |name: &str, count: usize| -> String {
            (0..count).map(|line| format!("{name} {line}\n")).collect()
        };
        let report = ReportParts {
            headline: "headline\n\n".to_owned(),
            table: numbered("task", 6),
            details: format!("\n{}", numbered("detail", details)),
        };
        let page = Page {
            status: "status",
            report: &report,
            next: "next\n\n",
            short_table: "short table",
            rest: "rest",
        };
        fit(&page, rows).into_iter().map(str::to_owned).collect()
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
        let small = lines(9, 6);
        let expected = [
            "status",
            "detail 0",
            "detail 1",
            "detail 2",
            "rest",
            "short table",
        ];
        assert_eq!(small, expected);
        let enough = lines(4, 6);
        let expected = [
            "status",
            "detail 0",
            "detail 1",
            "detail 2",
            "detail 3",
            "short table",
        ];
        assert_eq!(enough, expected);
        assert_eq!(lines(0, 5), ["status", "next", "short table"]);
    }

    #[test]
    fn never_returns_more_lines_than_rows() {
        for rows in 0..30 {
            assert!(lines(9, rows).len() <= rows, "{rows}");
        }
    }
}
