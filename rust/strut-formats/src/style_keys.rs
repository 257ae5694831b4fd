//! Styles over time from a table: CSV with the columns `time` (seconds) and one for every axis of a key-style model, in
//! the axes' own units and in any order.

use crate::counted;
use crate::quotation::{quotation, shown_number};
use strut_core::somn::{Key, MAX_AXES, Measure};
use thiserror::Error;

const TIME: &str = "time";

/// Reason why a table is invalid.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum StyleKeysError {
    /// The columns are wrong.
    #[error("line 1 is '{found}'; '{expected}' was expected")]
    Header {
        /// The line.
        found: String,
        /// Columns of this model.
        expected: String,
    },
    /// A row has another number of columns than the header.
    #[error("line {line} has {}; {expected} were expected", counted(*found, "column"))]
    Columns {
        /// Line in the file, from 1.
        line: u64,
        /// Number of columns of the row.
        found: usize,
        /// Number of columns of the header.
        expected: usize,
    },
    /// A cell is not a number.
    #[error("line {line}: {column} is '{found}'; a number was expected")]
    Number {
        /// Line in the file, from 1.
        line: u64,
        /// Name of the column.
        column: String,
        /// The cell.
        found: String,
    },
    /// The times are not ascending.
    #[error("line {line}: the time {} s does not come after the one before; ascending times were expected", shown_number(*.secs))]
    Order {
        /// Line in the file, from 1.
        line: u64,
        /// The time.
        secs: f64,
    },
    /// There are no keys.
    #[error("there is no key below the header; at least one was expected")]
    Empty,
    /// The file is not CSV.
    #[error("{0}")]
    Csv(String),
}

/// Parses the keys in a CSV file for a model with these axes.
///
/// # Errors
/// Returns the line and the expected content.
pub fn parse(bytes: &[u8], axes: &[Measure]) -> Result<Vec<Key>, StyleKeysError> {
    let no_csv = |e: csv::Error| StyleKeysError::Csv(format!("this is not a CSV file: {e}"));
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).flexible(true).from_reader(bytes);
    let header: Vec<String> = reader.headers().map_err(no_csv)?.iter().map(str::to_owned).collect();
    // Spaces in expressions are ignored.
    let bare = |text: &str| text.split_whitespace().collect::<String>();
    let column = |name: &str| header.iter().position(|h| bare(h) == bare(name));
    let found = axes.iter().map(|axis| column(axis.text())).collect::<Option<Vec<usize>>>();
    let (Some(time), Some(columns), true) = (column(TIME), found, header.len() == axes.len() + 1) else {
        let quoted = |axis: &Measure| if axis.text().contains(',') { format!("\"{axis}\"") } else { axis.to_string() };
        let expected = [TIME.to_owned()].into_iter().chain(axes.iter().map(quoted)).collect::<Vec<_>>().join(",");
        return Err(StyleKeysError::Header { found: quotation(&header.join(","), 200), expected });
    };
    let mut keys: Vec<Key> = Vec::new();
    for record in reader.records() {
        let record = record.map_err(no_csv)?;
        let line = record.position().map_or(0, csv::Position::line);
        if record.len() != header.len() {
            return Err(StyleKeysError::Columns { line, found: record.len(), expected: header.len() });
        }
        let number = |column: usize| {
            let cell = &record[column];
            cell.parse().ok().filter(|v: &f64| v.is_finite()).ok_or_else(|| StyleKeysError::Number {
                line,
                column: quotation(&header[column], 200),
                found: quotation(cell, 40),
            })
        };
        let secs = number(time)?;
        if keys.last().is_some_and(|last| secs <= last.secs) {
            return Err(StyleKeysError::Order { line, secs });
        }
        let mut style = [0.0; MAX_AXES];
        for (value, column) in style.iter_mut().zip(&columns) {
            *value = number(*column)?;
        }
        keys.push(Key { secs, style, row: None });
    }
    if keys.is_empty() { Err(StyleKeysError::Empty) } else { Ok(keys) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn axes() -> Vec<Measure> {
        Measure::parse_list("hips_height, max(hand_l.y, hand_r.y)").unwrap()
    }

    #[test]
    fn columns_come_in_any_order() {
        let text = "\"max(hand_l.y,hand_r.y)\", time ,hips_height\n120,0,90.5\n130.25,0.5,-3e1\n";
        let keys = parse(text.as_bytes(), &axes()).unwrap();
        assert_eq!(keys[0], Key { secs: 0.0, style: [90.5, 120.0, 0.0], row: None });
        assert_eq!(keys[1], Key { secs: 0.5, style: [-30.0, 130.25, 0.0], row: None });
    }

    #[test]
    fn faults_are_named_with_their_line() {
        let axes = &axes()[..1];
        for (text, expected) in [
            ("", "line 1 is ''; 'time,hips_height' was expected"),
            ("time,hips\n0,1\n", "line 1 is 'time,hips'; 'time,hips_height' was expected"),
            ("\"a\nb\",hips\n0,1\n", "line 1 is 'a\u{FFFD}b,hips'; 'time"),
            ("time,hips_height,time\n0,1,2\n", "line 1 is"),
            ("time,hips_height\n", "there is no key below the header"),
            ("time,hips_height\n1e300,90\n1e299,90\n", "line 3: the time 1e299 s does not come after"),
            ("time,hips_height\n0,90\n1\n", "line 3 has 1 column; 2 were expected"),
            ("time,hips_height\n0,90\n1,NaN\n", "line 3: hips_height is 'NaN'; a number was expected"),
            ("time,hips_height\n0,ninety\n", "line 2: hips_height is 'ninety'"),
            ("time,hips_height\ninf,90\n", "line 2: time is 'inf'"),
            ("time,\"hips_\nheight\"\n0,ninety\n", "line 3: hips_\u{FFFD}height is 'ninety'"),
            ("time,hips_height\n1,90\n1,91\n", "line 3: the time 1 s does not come after"),
        ] {
            let error = parse(text.as_bytes(), axes).unwrap_err().to_string();
            assert!(error.starts_with(expected), "{text:?}: {error}");
        }
    }

    proptest! {
        #[test]
        fn parse_never_panics(bytes in prop::collection::vec(any::<u8>(), 0..100), valid: bool) {
            let header: &[u8] = if valid { b"time,hips_height\n" } else { b"" };
            let _ = parse(&[header, &bytes].concat(), &axes()[..1]);
        }
    }
}
