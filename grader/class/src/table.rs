//! CSV tables as platforms export them: separated by commas, semicolons or tabs, with or without a
//! byte order mark.

use std::path::Path;

use grader::files;
use judging::sanitize::sanitize_line;

use crate::error::Error;

/// A CSV table. Cells are kept as text: numbers and dates aren't parsed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// The cells of the first row, which name the columns.
    pub header: Vec<String>,
    /// The other rows.
    pub rows: Vec<Vec<String>>,
    /// The row numbers as in spreadsheets, which also count blank lines.
    row_numbers: Vec<usize>,
    delimiter: u8,
    has_byte_order_mark: bool,
}

/// The delimiters that spreadsheets write. If several are equally frequent, the first one is used.
const DELIMITERS: [u8; 3] = [b',', b';', b'\t'];
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

impl Table {
    /// Reads a CSV file.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let bytes = files::read(path).map_err(Error::user)?;
        Table::parse(&bytes).map_err(|why| {
            let path = path.display();
            Error::user(format!(
                "{path}: {why}; export it again as a UTF-8 CSV file"
            ))
        })
    }

    /// Parses the bytes of a CSV file.
    pub fn parse(bytes: &[u8]) -> Result<Self, String> {
        let has_mark = bytes.starts_with(BYTE_ORDER_MARK);
        let bytes = bytes.strip_prefix(BYTE_ORDER_MARK).unwrap_or(bytes);
        let mut lines = bytes.split(|byte| *byte == b'\n');
        let first = lines.find(|line| !line.trim_ascii().is_empty());
        let first = first.unwrap_or_default();
        let count = |sign: &u8| first.iter().filter(|byte| *byte == sign).count();
        let delimiter = DELIMITERS.into_iter().rev().max_by_key(count);
        let delimiter = delimiter.unwrap_or(b',');
        let mut reader = csv::ReaderBuilder::new()
            .delimiter(delimiter)
            .has_headers(false)
            .flexible(true)
            .from_reader(bytes);
        let (mut rows, mut row_numbers) = (Vec::new(), Vec::new());
        let mut record = csv::StringRecord::new();
        let mut number = 0;
        let read = |error: csv::Error| error.to_string();
        while reader.read_record(&mut record).map_err(read)? {
            let start = record.position().map_or(0, csv::Position::byte);
            let start = usize::try_from(start).unwrap_or(bytes.len());
            number += blank_lines(bytes, start) + 1;
            row_numbers.push(number);
            rows.push(record.iter().map(str::to_owned).collect::<Vec<String>>());
        }
        if rows.is_empty() {
            return Err("the file is empty".to_owned());
        }
        let header = rows.remove(0);
        row_numbers.remove(0);
        for row in &mut rows {
            row.resize(header.len().max(row.len()), String::new());
        }
        Ok(Table {
            header,
            rows,
            row_numbers,
            delimiter,
            has_byte_order_mark: has_mark,
        })
    }

    /// Creates a table with this header and these rows.
    pub fn new(header: &[&str], rows: Vec<Vec<String>>) -> Self {
        Table {
            header: header.iter().map(|name| (*name).to_owned()).collect(),
            rows,
            row_numbers: Vec::new(),
            delimiter: b',',
            has_byte_order_mark: false,
        }
    }

    /// Returns the table that begins this many rows below the header.
    pub fn below(&self, rows: usize) -> Option<Self> {
        let Some(above) = rows.checked_sub(1) else {
            return Some(self.clone());
        };
        Some(Table {
            header: self.rows.get(above)?.clone(),
            rows: self.rows[rows..].to_vec(),
            row_numbers: self.row_numbers[rows..].to_vec(),
            ..*self
        })
    }

    /// Returns the index of the column with this name, ignoring case.
    pub fn column(&self, name: &str) -> Option<usize> {
        let same = |column: &String| column.trim().eq_ignore_ascii_case(name);
        self.header.iter().position(same)
    }

    /// Returns the index of the column with this name. If there is no such column, the error says
    /// what to do. `path` is the table's path.
    pub fn require_column(&self, path: &Path, name: &str, remedy: &str) -> Result<usize, Error> {
        let column = self.column(name);
        column.ok_or_else(|| missing_column(path, name, remedy))
    }

    /// Returns the cell of the first row in the column with this name.
    pub fn first_cell(&self, name: &str) -> Option<String> {
        self.rows.first()?.get(self.column(name)?).cloned()
    }

    /// Returns a table with only these columns, in the order of `columns`.
    pub fn select_columns(&self, columns: &[usize]) -> Self {
        let pick = |row: &Vec<String>| {
            let cell = |column: &usize| row.get(*column).cloned().unwrap_or_default();
            columns.iter().map(cell).collect()
        };
        Table {
            header: pick(&self.header),
            rows: self.rows.iter().map(pick).collect(),
            row_numbers: self.row_numbers.clone(),
            ..*self
        }
    }

    /// Returns the rows and their row numbers, as in spreadsheets.
    pub fn numbered_rows(&self) -> impl Iterator<Item = (usize, &Vec<String>)> {
        self.row_numbers.iter().copied().zip(&self.rows)
    }

    /// Returns the table as CSV, with its original delimiter and byte order mark.
    pub fn to_csv(&self) -> String {
        let mut writer = csv::WriterBuilder::new()
            .delimiter(self.delimiter)
            .flexible(true)
            .from_writer(Vec::new());
        for row in [&self.header].into_iter().chain(&self.rows) {
            let written = writer.write_record(row);
            written.expect("writing to memory succeeds");
        }
        let bytes = writer.into_inner().expect("writing to memory succeeds");
        let text = String::from_utf8(bytes).expect("cells are UTF-8");
        let has_mark = self.has_byte_order_mark;
        let mark = if has_mark { "\u{feff}" } else { "" };
        format!("{mark}{text}")
    }
}

/// Returns the error to report when a column is missing. The error includes a remedy.
pub fn missing_column(path: &Path, column: &str, remedy: &str) -> Error {
    let path = path.display();
    Error::user(format!("{path} has no column {column}: {remedy}"))
}

/// Returns the number of blank lines that the reader skips after a row. `read` is the number of
/// bytes up to the row's end.
fn blank_lines(bytes: &[u8], read: usize) -> usize {
    let (row, rest) = bytes.split_at(read);
    let is_end = |byte: &&u8| [b'\r', b'\n'].contains(*byte);
    let ends = &rest[..rest.iter().take_while(is_end).count()];
    let end_of_row = match row {
        // The reader stops between the two characters of a line end.
        [.., b'\r'] => ends.strip_prefix(b"\n"),
        _ => None,
    };
    let ends = end_of_row.unwrap_or(ends);
    let pairs = ends.windows(2).filter(|pair| *pair == b"\r\n").count();
    ends.len() - pairs
}

/// Characters that begin a formula in spreadsheets, including their wide and small forms.
const FORMULA_SIGNS: &str = "=+-@|＝＋－＠｜﹦﹢﹣﹫−";
/// Characters at which spreadsheets in some languages split lines, regardless of the table's
/// delimiter.
const SPLITTING_SIGNS: [char; 2] = [';', '|'];

/// Returns untrusted text as a cell, without control characters and with formulas defused.
/// Otherwise, a student's name could run a formula on the teacher's machine (OWASP, "CSV
/// Injection").
pub fn safe_cell(text: &str) -> String {
    let text = sanitize_line(text, usize::MAX);
    let escape = |part: &str| {
        // A formula may begin after spaces and quotation marks. Tabs have already been replaced by
        // spaces.
        let is_before = |sign: char| sign.is_whitespace() || sign == '"';
        let begin = part.trim_start_matches(is_before);
        let is_formula = begin.starts_with(|sign| FORMULA_SIGNS.contains(sign));
        format!("{}{part}", if is_formula { "'" } else { "" })
    };
    text.split_inclusive(SPLITTING_SIGNS).map(escape).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_is_written_as_it_was_read() {
        let text = "\u{feff}Name;Grade\n\"Müller; Ann\";87,5\n";
        let table = Table::parse(text.as_bytes()).unwrap();
        assert_eq!(table.rows, [["Müller; Ann", "87,5"]]);
        assert_eq!(table.to_csv(), text);
        let tabs = "Name\tGrade\nAnn, Lee\t87\n";
        let table = Table::parse(tabs.as_bytes()).unwrap();
        assert_eq!(table.rows, [["Ann, Lee", "87"]]);
        assert_eq!(table.to_csv(), tabs);
    }

    #[test]
    fn of_equally_frequent_delimiters_a_comma_comes_first_and_a_tab_last() {
        for (text, row) in [
            ("name,e;mail\nAnn,a\n", ["Ann", "a"]),
            ("name\te;mail\nAnn\ta\n", ["Ann\ta", ""]),
        ] {
            let table = Table::parse(text.as_bytes());
            assert_eq!(
                table.map(|table| table.rows),
                Ok(vec![row.map(str::to_owned).to_vec()])
            );
        }
    }

    #[test]
    fn rows_are_numbered_as_spreadsheets_number_them() {
        for end in ["\n", "\r\n", "\r"] {
            let text = "a,b\n\n1,\"x\n\ny\"\n2,\n\n\n3,\n".replace('\n', end);
            let table = Table::parse(text.as_bytes()).unwrap();
            let numbers = table.numbered_rows();
            let numbers: Vec<(usize, &str)> =
                numbers.map(|(n, row)| (n, row[0].as_str())).collect();
            assert_eq!(numbers, [(3, "1"), (4, "2"), (7, "3")], "{end:?}");
        }
        let table = Table::parse(b"\n\na;b\n1;2").unwrap();
        assert_eq!(table.numbered_rows().next().unwrap().0, 4);
        assert_eq!(table.header, ["a", "b"]);
    }

    #[test]
    fn formulas_are_escaped_and_other_text_is_kept() {
        assert_eq!(safe_cell("=1+1"), "'=1+1");
        assert_eq!(safe_cell("@SUM(A1)"), "'@SUM(A1)");
        assert_eq!(safe_cell("\t=1+1"), "'    =1+1");
        assert_eq!(safe_cell("\u{3000}＝1+1"), "'\u{3000}＝1+1");
        for sign in FORMULA_SIGNS.chars() {
            assert_eq!(safe_cell(&format!("{sign}A1")), format!("'{sign}A1"));
        }
        // If the comma is the decimal separator, spreadsheets split lines at semicolons.
        assert_eq!(safe_cell("Ann;=1+1; \"@A1"), "Ann;'=1+1;' \"@A1");
        assert_eq!(safe_cell("Ann|=1+1"), "Ann|'=1+1");
        assert_eq!(safe_cell("Ann; Bob-Lee, a=b"), "Ann; Bob-Lee, a=b");
        assert_eq!(safe_cell("O'Hara"), "O'Hara");
        assert_eq!(safe_cell("a\r\n\u{202e}b"), "a\\r\\n\\u{202e}b");
    }
}
