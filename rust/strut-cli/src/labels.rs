//! Labels of the clips of a build: from a pattern, a table, or both.

use crate::failure::{Failure, Outcome};
use crate::files;
use crate::pattern::{Labels, Pattern, parse_take};
use std::collections::HashMap;
use std::path::Path;

/// Most bytes of a table.
const MAX_TABLE_BYTES: usize = 64 << 20;
/// The header of a table; the take may be left out.
const HEADER: [&str; 4] = ["file", "action", "style", "take"];

/// A row of a `--labels` table.
#[derive(Debug, PartialEq)]
struct Entry {
    line: u64,
    file: String,
    labels: Labels,
}

/// The labels of every path, or why it has none. The table, whose entries must each name one of the
/// paths, goes before the pattern.
pub(crate) fn assign(
    paths: &[String],
    pattern: Option<&Pattern>,
    table: Option<&Path>,
) -> Outcome<Vec<Result<Labels, String>>> {
    let mut listed: HashMap<usize, Labels> = HashMap::new();
    if let Some(table) = table {
        for entry in read_table(&files::read(table, MAX_TABLE_BYTES)?).map_err(|e| Failure::in_file(table, e))? {
            let fail = |reason: &str| {
                Failure::in_file(table, format_args!("line {} names '{}', {reason}", entry.line, entry.file))
            };
            let mut named = paths.iter().enumerate().filter(|(_, path)| ends_with_path(path, &entry.file));
            let (index, _) = named.next().ok_or_else(|| fail("which is not among the inputs"))?;
            if named.next().is_some() {
                return Err(fail("which is the name of several inputs; more of the path was expected"));
            }
            if listed.insert(index, entry.labels.clone()).is_some() {
                return Err(fail("which has labels already"));
            }
        }
    }
    let label = |(index, path): (usize, &String)| match (listed.remove(&index), pattern) {
        (Some(labels), _) => Ok(labels),
        (None, Some(pattern)) => pattern.labels(path),
        (None, None) => Err("it is not in the table of labels".to_owned()),
    };
    Ok(paths.iter().enumerate().map(label).collect())
}

/// Whether the last components of `path` are those of `end`.
fn ends_with_path(path: &str, end: &str) -> bool {
    let end = end.strip_prefix("./").unwrap_or(end);
    path.strip_suffix(end).is_some_and(|before| before.is_empty() || before.ends_with('/'))
}

fn read_table(bytes: &[u8]) -> Result<Vec<Entry>, String> {
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(bytes);
    let headers = reader.headers().map_err(|e| table_error(&e))?;
    let header: Vec<&str> = headers.iter().collect();
    if header.len() < 3 || !HEADER.starts_with(&header) {
        return Err(format!(
            "line 1 is '{}'; 'file,action,style' or 'file,action,style,take' was expected",
            header.join(",")
        ));
    }
    let mut entries = Vec::new();
    for record in reader.records() {
        let record = record.map_err(|e| table_error(&e))?;
        let line = record.position().map_or(0, csv::Position::line);
        let text = |column: usize| match record.get(column) {
            Some(text) if !text.is_empty() => Ok(text.to_owned()),
            _ => Err(format!("line {line} has no {}; a name was expected", HEADER[column])),
        };
        let take = match record.get(3) {
            Some(take) if !take.is_empty() => Some(parse_take(take).map_err(|e| format!("line {line}: {e}"))?),
            _ => None,
        };
        entries.push(Entry { line, file: text(0)?, labels: Labels { action: text(1)?, style: text(2)?, take } });
    }
    Ok(entries)
}

fn table_error(error: &csv::Error) -> String {
    let line = error.position().map_or(1, csv::Position::line);
    match error.kind() {
        csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
            format!("line {line} has {len} columns; {expected_len} were expected")
        }
        csv::ErrorKind::Utf8 { .. } => format!("line {line} is not UTF-8 text"),
        _ => error.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table_of(text: &str) -> Result<Vec<Entry>, String> {
        read_table(text.as_bytes())
    }

    fn paths() -> Vec<String> {
        ["in/a/walk_old_1.bvh", "in/b/walk_old_1.bvh", "in/c.bvh"].map(str::to_owned).to_vec()
    }

    fn assigned(table: &str) -> Result<Vec<Result<Labels, String>>, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("labels.csv");
        std::fs::write(&path, table).unwrap();
        let pattern = "{action}_{style}_{take}".parse().unwrap();
        let name = format!("{}: ", path.display());
        assign(&paths(), Some(&pattern), Some(&path)).map_err(|e| e.to_string().replace(&name, ""))
    }

    #[test]
    fn a_table_gives_labels_with_and_without_takes() {
        let rows = table_of("file,action,style,take\nc.bvh, run ,proud,7\r\n\"d,e.bvh\",run,proud,\n").unwrap();
        assert_eq!(rows[0].labels, Labels { action: "run".into(), style: "proud".into(), take: Some(7) });
        assert_eq!((rows[1].file.as_str(), rows[1].labels.take), ("d,e.bvh", None));
    }

    #[test]
    fn a_bad_table_is_refused_with_the_line() {
        for (text, expected) in [
            ("name,style\n", "line 1 is 'name,style'; 'file,action,style' or 'file,action,style,take' was expected"),
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
        assert_eq!(labels[2], Err("its name does not match '{action}_{style}_{take}'".into()));
    }

    #[test]
    fn entries_must_name_one_input_once() {
        for (row, expected) in [
            ("x.bvh,a,b", "line 2 names 'x.bvh', which is not among the inputs"),
            (
                "walk_old_1.bvh,a,b",
                "line 2 names 'walk_old_1.bvh', which is the name of several inputs; more of the path was expected",
            ),
            ("c.bvh,a,b\nin/c.bvh,a,b", "line 3 names 'in/c.bvh', which has labels already"),
        ] {
            assert_eq!(assigned(&format!("file,action,style\n{row}\n")).unwrap_err(), expected);
        }
    }
}
