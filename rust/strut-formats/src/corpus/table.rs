//! Labels from a table: CSV with the columns `file,action,style[,take]`.

use super::pattern::{LabelError, Labels, Pattern, parse_take};
use crate::quotation::quotation;
use std::collections::HashMap;
use thiserror::Error;

/// Header of a table; the take may be omitted.
const HEADER: [&str; 4] = ["file", "action", "style", "take"];

/// A table of labels.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    rows: Vec<Row>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct Row {
    line: u64,
    file: String,
    labels: Labels,
}

/// Reason why a table is invalid.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum TableError {
    /// The columns are wrong.
    #[error("line 1 is '{0}'; 'file,action,style' or 'file,action,style,take' was expected")]
    Header(String),
    /// A row has another number of columns than the header.
    #[error("line {line} has {found} columns; {expected} were expected")]
    Columns {
        /// Line in the file, from 1.
        line: u64,
        /// Number of columns of the row.
        found: u64,
        /// Number of columns of the header.
        expected: u64,
    },
    /// The table is not UTF-8.
    #[error("line {0} is not UTF-8 text")]
    NotText(u64),
    /// A cell is empty.
    #[error("line {line} has no {column}; a name was expected")]
    Empty {
        /// Line in the file, from 1.
        line: u64,
        /// Name of the column.
        column: &'static str,
    },
    /// A take is not a number.
    #[error("line {line}: {error}")]
    Take {
        /// Line in the file, from 1.
        line: u64,
        /// The reason.
        error: LabelError,
    },
    /// A row does not identify exactly one input.
    #[error("line {line} names '{file}', {fault}")]
    File {
        /// Line in the file, from 1.
        line: u64,
        /// File name in the row.
        file: String,
        /// The reason.
        fault: &'static str,
    },
    /// The file is not CSV.
    #[error("{0}")]
    Csv(String),
}

impl Table {
    /// Parses a CSV file.
    ///
    /// # Errors
    /// Returns the line and the expected content.
    pub fn parse(bytes: &[u8]) -> Result<Self, TableError> {
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(bytes);
        let headers = reader.headers().map_err(|e| csv_error(&e))?;
        let header: Vec<&str> = headers.iter().collect();
        if header.len() < 3 || !HEADER.starts_with(&header) {
            return Err(TableError::Header(quotation(&header.join(","), 200)));
        }
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|e| csv_error(&e))?;
            let line = record.position().map_or(0, csv::Position::line);
            let text = |column: usize| match record.get(column) {
                Some(text) if !text.is_empty() => Ok(text.to_owned()),
                _ => Err(TableError::Empty { line, column: HEADER[column] }),
            };
            let take = match record.get(3) {
                Some(take) if !take.is_empty() => {
                    Some(parse_take(take).map_err(|error| TableError::Take { line, error })?)
                }
                _ => None,
            };
            rows.push(Row { line, file: text(0)?, labels: Labels { action: text(1)?, style: text(2)?, take } });
        }
        Ok(Self { rows })
    }
}

/// Labels of every path, or the reason why there are none. Each row of the table must identify exactly one of the
/// paths. The table takes precedence over the pattern.
///
/// # Errors
/// If a row of the table identifies no input, several, or the same one as another row.
pub fn assign(
    paths: &[String],
    pattern: Option<&Pattern>,
    table: Option<&Table>,
) -> Result<Vec<Result<Labels, LabelError>>, TableError> {
    let mut listed: HashMap<usize, Labels> = HashMap::new();
    for Row { line, file, labels } in table.iter().flat_map(|table| &table.rows) {
        let fault = |fault| TableError::File { line: *line, file: quotation(file, 200), fault };
        let mut named = paths.iter().enumerate().filter(|(_, path)| ends_with_path(path, file));
        let (index, _) = named.next().ok_or_else(|| fault("which is not among the inputs"))?;
        if named.next().is_some() {
            return Err(fault("which is the name of several inputs; more of the path was expected"));
        }
        if listed.insert(index, labels.clone()).is_some() {
            return Err(fault("which already has labels"));
        }
    }
    let label = |(index, path): (usize, &String)| match (listed.remove(&index), pattern) {
        (Some(labels), _) => Ok(labels),
        (None, Some(pattern)) => pattern.labels(path),
        (None, None) => Err(LabelError::NotListed),
    };
    Ok(paths.iter().enumerate().map(label).collect())
}

/// Returns whether the last components of `path` are those of `end`.
fn ends_with_path(path: &str, end: &str) -> bool {
    let end = end.strip_prefix("./").unwrap_or(end);
    path.strip_suffix(end).is_some_and(|before| before.is_empty() || before.ends_with('/'))
}

fn csv_error(error: &csv::Error) -> TableError {
    let line = error.position().map_or(1, csv::Position::line);
    match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            TableError::Columns { line, found: *len, expected: *expected_len }
        }
        csv::ErrorKind::Utf8 { .. } => TableError::NotText(line),
        _ => TableError::Csv(error.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table_of(text: &str) -> Result<Table, String> {
        Table::parse(text.as_bytes()).map_err(|e| e.to_string())
    }

    fn assigned(table: &str) -> Result<Vec<Result<Labels, LabelError>>, String> {
        let paths = ["in/a/walk_old_1.bvh", "in/b/walk_old_1.bvh", "in/c.bvh"].map(str::to_owned);
        let pattern = "{action}_{style}_{take}".parse().unwrap();
        assign(&paths, Some(&pattern), Some(&table_of(table)?)).map_err(|e| e.to_string())
    }

    #[test]
    fn a_table_gives_labels_with_and_without_takes() {
        let rows = table_of("file,action,style,take\nc.bvh, run ,proud,7\r\n\"d,e.bvh\",run,proud,\n").unwrap().rows;
        assert_eq!(rows[0].labels, Labels { action: "run".into(), style: "proud".into(), take: Some(7) });
        assert_eq!((rows[1].file.as_str(), rows[1].labels.take), ("d,e.bvh", None));
    }

    #[test]
    fn a_bad_table_is_refused_with_the_line() {
        for (text, expected) in [
            ("name,style\n", "line 1 is 'name,style'; 'file,action,style' or 'file,action,style,take' was expected"),
            ("\"a\nb\"\n", "line 1 is 'a\u{FFFD}b'; 'file,action,style' or 'file,action,style,take' was expected"),
            ("file,action,style\na,b\n", "line 2 has 2 columns; 3 were expected"),
            ("file,action,style\na,,c\n", "line 2 has no action; a name was expected"),
            ("file,action,style,take\na,b,c,x\n", "line 2: its take is 'x'; a number was expected"),
        ] {
            assert_eq!(table_of(text).unwrap_err(), expected);
        }
    }

    #[test]
    fn the_table_goes_before_the_pattern() {
        let labels = assigned("file,action,style\nb/walk_old_1.bvh,run,proud\n").unwrap();
        let style = |i: usize| labels[i].as_ref().map(|l| l.style.as_str());
        assert_eq!((style(0), style(1)), (Ok("old"), Ok("proud")));
        assert_eq!(labels[2], Err(LabelError::NoMatch("{action}_{style}_{take}".into())));
    }

    #[test]
    fn rows_must_name_one_input_once() {
        for (row, expected) in [
            ("x.bvh,a,b", "line 2 names 'x.bvh', which is not among the inputs"),
            (
                "walk_old_1.bvh,a,b",
                "line 2 names 'walk_old_1.bvh', which is the name of several inputs; more of the path was expected",
            ),
            ("c.bvh,a,b\nin/c.bvh,a,b", "line 3 names 'in/c.bvh', which already has labels"),
        ] {
            assert_eq!(assigned(&format!("file,action,style\n{row}\n")).unwrap_err(), expected);
        }
    }
}
