//! Paths and controls of a character: the CSV files of `strut drive`.

use std::path::Path;
use strut_core::driving::{Control, Driver, Move};
use strut_core::math::Vec2;
use strut_core::math::float_funcs::sin_cos;
use strut_formats::quotation;
use strut_tasks::files;
use strut_tasks::{Outcome, TaskError};

/// Greatest size of a file, bytes.
const MAX_BYTES: usize = 16 << 20;

/// A path or a list of controls.
pub(super) enum Orders {
    /// Points of a path, each with its gait and the length of the line up to it.
    Path { points: Vec<Vec2>, gaits: Vec<[f32; 2]> },
    /// Controls, each with the time from which it applies, seconds.
    Log(Vec<(f32, Control)>),
}

impl Orders {
    /// Reads one of two files.
    ///
    /// # Errors
    /// A message with the file, the line and the expected content.
    pub(super) fn read(path: Option<&Path>, controls: Option<&Path>, gait: f32) -> Outcome<Self> {
        match (path, controls) {
            (Some(file), _) => read_path(file, gait),
            (_, Some(file)) => read_log(file),
            _ => Err(TaskError::usage("--path or --controls was expected")),
        }
    }

    /// Returns the line to follow, if there is one.
    pub(super) fn path(&self) -> Option<&[Vec2]> {
        match self {
            Self::Path { points, .. } => Some(points),
            Self::Log(_) => None,
        }
    }

    /// Returns the control at a time, and at a distance along the path.
    pub(super) fn at(&self, secs: f32, progress: Option<f32>) -> Control {
        match self {
            Self::Path { gaits, .. } => {
                let along = progress.unwrap_or_default();
                let i = gaits.partition_point(|[length, _]| *length <= along).saturating_sub(1);
                Control { gait: gaits[i][1], ..Control::default() }
            }
            Self::Log(log) => log[log.partition_point(|(from, _)| *from <= secs).saturating_sub(1)].1,
        }
    }

    /// Returns the controls of a log, each with the time from which it applies, seconds; empty for a path.
    pub(super) fn log(&self) -> &[(f32, Control)] {
        match self {
            Self::Path { .. } => &[],
            Self::Log(log) => log,
        }
    }

    /// Returns whether no further orders remain.
    pub(super) fn is_over(&self, secs: f32, driver: &Driver) -> bool {
        match self {
            Self::Path { .. } => driver.has_arrived(),
            Self::Log(log) => log.last().is_none_or(|(from, _)| secs >= *from),
        }
    }
}

fn read_path(file: &Path, gait: f32) -> Outcome<Orders> {
    let table = Table::read(file, &["x", "z"], &["gait"], None)?;
    let points: Vec<Vec2> =
        table.rows.iter().map(|(row, _)| Vec2::new(row[0].unwrap_or(0.0), row[1].unwrap_or(0.0))).collect();
    if strut_core::driving::Path::new(&points).is_none() {
        return Err(TaskError::in_file(file, "the path has fewer than two distinct points; two or more were expected"));
    }
    let mut length = 0.0;
    let mut gaits = Vec::new();
    for (i, (row, _)) in table.rows.iter().enumerate() {
        length += if i > 0 { points[i].distance(points[i - 1]) } else { 0.0 };
        gaits.push([length, row[2].unwrap_or(gait)]);
    }
    Ok(Orders::Path { points, gaits })
}

fn read_log(file: &Path) -> Outcome<Orders> {
    let table = Table::read(file, &["time", "gait", "heading"], &["face"], Some("action"))?;
    let mut log: Vec<(f32, Control)> = Vec::new();
    for (i, (row, action)) in table.rows.iter().enumerate() {
        let action = if action.is_empty() {
            None
        } else {
            let names = Move::ALL.map(Move::name).join(", ");
            let unknown =
                || format!("line {}: the action is '{}'; one of {names} was expected", i + 2, quotation(action, 40));
            Some(Move::named(action).ok_or_else(|| TaskError::in_file(file, unknown()))?)
        };
        let [time, gait, heading] = [row[0], row[1], row[2]].map(Option::unwrap_or_default);
        // Heading 0 is +Z, and a positive turn is to the left, towards +X.
        let (x, z) = sin_cos(heading.to_radians());
        let wish = if gait > 0.0 { Vec2::new(x, z) } else { Vec2::ZERO };
        log.push((time, Control { wish, gait, face: row[3].map(f32::to_radians), action }));
    }
    if !log.is_sorted_by_key(|(time, _)| *time) {
        return Err(TaskError::in_file(file, "the times do not increase from line to line"));
    }
    if log.is_empty() {
        return Err(TaskError::in_file(file, "there are no controls; at least one line was expected"));
    }
    Ok(Orders::Log(log))
}

/// Numbers by column, where optional columns may be absent or empty, and the text of another column.
struct Table {
    rows: Vec<(Vec<Option<f32>>, String)>,
}

impl Table {
    fn read(file: &Path, needed: &[&str], optional: &[&str], text: Option<&str>) -> Outcome<Self> {
        let bytes = files::read(file, MAX_BYTES)?;
        let fail = |line: u64, reason: String| TaskError::in_file(file, format!("line {line}: {reason}"));
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(bytes.as_slice());
        let headers = reader.headers().map_err(|error| fail(1, error.to_string()))?.clone();
        let may_be: Vec<&str> = optional.iter().chain(&text).copied().collect();
        let expected = || format!("the columns {}[,{}] were expected", needed.join(","), may_be.join("][,"));
        let column = |name: &str| headers.iter().position(|header| header == name);
        if let Some(unknown) = headers.iter().find(|header| !needed.contains(header) && !may_be.contains(header)) {
            return Err(fail(1, format!("there is a column '{}'; {}", quotation(unknown, 40), expected())));
        }
        let columns: Vec<Option<usize>> = needed.iter().chain(optional).map(|name| column(name)).collect();
        if columns[..needed.len()].contains(&None) {
            return Err(fail(1, expected()));
        }
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|error| {
                fail(error.position().map_or(1, csv::Position::line), "the number of fields differs from line 1".into())
            })?;
            let line = record.position().map_or(0, csv::Position::line);
            let field = |at: Option<usize>| at.and_then(|at| record.get(at)).unwrap_or_default();
            let mut row = Vec::new();
            for (i, at) in columns.iter().enumerate() {
                let text = field(*at);
                let number = text.parse().ok().filter(|number: &f32| number.is_finite());
                if number.is_none() && (i < needed.len() || !text.is_empty()) {
                    let name = needed.iter().chain(optional).nth(i).unwrap_or(&"");
                    return Err(fail(line, format!("the {name} is '{}'; a number was expected", quotation(text, 40))));
                }
                row.push(number);
            }
            rows.push((row, field(text.and_then(column)).to_owned()));
        }
        Ok(Self { rows })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_show_the_beginning_of_what_is_long() {
        let long = "x".repeat(5000);
        for (is_path, text) in [
            (true, format!("x,z,{long}\n0,0,0\n")),
            (true, format!("x,z\n0,{long}\n")),
            (false, format!("time,gait,heading,action\n0,1,0,{long}\n")),
        ] {
            let file = tempfile::NamedTempFile::new().unwrap();
            std::fs::write(file.path(), &text).unwrap();
            let [path, controls] = [is_path, !is_path].map(|is_given| is_given.then(|| file.path()));
            let refused = Orders::read(path, controls, 1.0).err().unwrap().to_string();
            assert!(refused.contains("xxx") && refused.chars().count() < 500, "{} characters", refused.chars().count());
        }
    }
}
