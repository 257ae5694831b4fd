//! Labels from file names: `{set}_{action}_{style}_{take}.bvh`.

use crate::quotation::quotation;
use std::fmt::{self, Display};
use std::str::FromStr;
use thiserror::Error;

/// Labels of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Labels {
    /// Name of the action.
    pub action: String,
    /// Name of the style.
    pub style: String,
    /// Number of the take, if there is one.
    pub take: Option<u32>,
}

/// Reason why a file has no labels.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum LabelError {
    /// The name does not match the pattern.
    #[error("its name does not match '{}'", quotation(.0, 80))]
    NoMatch(String),
    /// The take is not a number.
    #[error("its take is '{0}'; a number was expected")]
    Take(String),
    /// There is no pattern, and the file is not in the table.
    #[error("it is not in the table of labels")]
    NotListed,
}

/// Reason why a text is not a valid pattern.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum PatternError {
    /// A field has no closing brace.
    #[error("a '{{' has no '}}'")]
    Unclosed,
    /// There is no text between two fields.
    #[error("'{{{0}}}' follows another field; text between them was expected")]
    Adjacent(String),
    /// A label is missing or occurs twice.
    #[error("'{{{0}}}' was expected once, as in '{{action}}_{{style}}_{{take}}.bvh'")]
    NotOnce(&'static str),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Field {
    Action,
    Style,
    Take,
    /// Any other name: matched and ignored.
    Other,
}

#[derive(Clone, Debug, PartialEq, Eq)]
enum Part {
    Text(String),
    Field(Field),
}

/// Fields with text between them. A field matches one or more characters up to the text that follows it. `{action}`,
/// `{style}` and `{take}` do not match the text before them either, so that `{action}_{style}` does not read `old_001`
/// as the style in `walk_old_001`.
///
/// A pattern with `/` is compared with the same number of folders of a path. `.bvh` at its end may be omitted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    text: String,
    parts: Vec<Part>,
    slashes: usize,
}

impl Display for Pattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl FromStr for Pattern {
    type Err = PatternError;

    fn from_str(text: &str) -> Result<Self, PatternError> {
        let mut parts = Vec::new();
        let mut rest = without_extension(text);
        while !rest.is_empty() {
            if let Some(field) = rest.strip_prefix('{') {
                let (name, after) = field.split_once('}').ok_or(PatternError::Unclosed)?;
                if matches!(parts.last(), Some(Part::Field(_))) {
                    return Err(PatternError::Adjacent(quotation(name, 40)));
                }
                parts.push(Part::Field(match name {
                    "action" => Field::Action,
                    "style" => Field::Style,
                    "take" => Field::Take,
                    _ => Field::Other,
                }));
                rest = after;
            } else {
                let (literal, after) = rest.split_at(rest.find('{').unwrap_or(rest.len()));
                parts.push(Part::Text(literal.to_owned()));
                rest = after;
            }
        }
        for (name, field) in [("action", Field::Action), ("style", Field::Style)] {
            if parts.iter().filter(|p| **p == Part::Field(field)).count() != 1 {
                return Err(PatternError::NotOnce(name));
            }
        }
        Ok(Self { text: text.to_owned(), parts, slashes: text.matches('/').count() })
    }
}

impl Pattern {
    /// Labels of a file.
    ///
    /// # Errors
    /// If its name does not match the pattern.
    pub fn labels(&self, path: &str) -> Result<Labels, LabelError> {
        let no_match = || LabelError::NoMatch(self.text.clone());
        let mut rest = tail(without_extension(path), self.slashes);
        let mut before = "";
        let (mut action, mut style, mut take) = (String::new(), String::new(), None);
        for (i, part) in self.parts.iter().enumerate() {
            let field = match part {
                Part::Text(text) => {
                    rest = rest.strip_prefix(text.as_str()).ok_or_else(no_match)?;
                    before = text;
                    continue;
                }
                Part::Field(field) => *field,
            };
            let end = match self.parts.get(i + 1) {
                Some(Part::Text(next)) => rest.find(next.as_str()).ok_or_else(no_match)?,
                _ => rest.len(),
            };
            let (value, after) = rest.split_at(end);
            if value.is_empty() || (field != Field::Other && !before.is_empty() && value.contains(before)) {
                return Err(no_match());
            }
            match field {
                Field::Action => value.clone_into(&mut action),
                Field::Style => value.clone_into(&mut style),
                Field::Take => take = Some(parse_take(value)?),
                Field::Other => {}
            }
            rest = after;
        }
        if rest.is_empty() { Ok(Labels { action, style, take }) } else { Err(no_match()) }
    }
}

/// Number of a take.
pub(super) fn parse_take(text: &str) -> Result<u32, LabelError> {
    text.parse().map_err(|_| LabelError::Take(quotation(text, 40)))
}

/// End of a path, including the last `slashes` folders.
fn tail(path: &str, slashes: usize) -> &str {
    path.rmatch_indices('/').nth(slashes).map_or(path, |(at, _)| &path[at + 1..])
}

/// Path without `.bvh` at its end, in any case.
pub(super) fn without_extension(path: &str) -> &str {
    let stem =
        path.len().checked_sub(4).filter(|&at| path.is_char_boundary(at) && path[at..].eq_ignore_ascii_case(".bvh"));
    stem.map_or(path, |at| &path[..at])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(pattern: &str, path: &str) -> Result<Labels, LabelError> {
        pattern.parse::<Pattern>().unwrap().labels(path)
    }

    fn found(action: &str, style: &str, take: Option<u32>) -> Labels {
        Labels { action: action.into(), style: style.into(), take }
    }

    #[test]
    fn fields_are_taken_from_the_name() {
        let bandai = "{set}_{action}_{style}_{take}.bvh";
        let path = "data/dataset-2_walk-turn-left_normal_004.bvh";
        assert_eq!(labels(bandai, path), Ok(found("walk-turn-left", "normal", Some(4))));
        assert_eq!(labels("{style}_{action}_{take}", "old_01_002.BVH"), Ok(found("01", "old", Some(2))));
        assert_eq!(labels("{style}/{action}-{x}.bvh", "a/old/run-3-b.bvh"), Ok(found("run", "old", None)));
    }

    #[test]
    fn other_names_do_not_match() {
        let no_match = Err(LabelError::NoMatch("{action}_{style}.bvh".to_owned()));
        assert!(LabelError::NoMatch("x".repeat(5000)).to_string().len() < 200);
        for path in ["walk.bvh", "walk_.bvh", "_old.bvh", "walk_old_001.bvh"] {
            assert_eq!(labels("{action}_{style}.bvh", path), no_match, "{path}");
        }
        let take = labels("{action}_{style}_{take}", "walk_old_x.bvh").unwrap_err();
        assert_eq!(take.to_string(), "its take is 'x'; a number was expected");
    }

    #[test]
    fn patterns_need_both_labels_and_text_between_fields() {
        for (bad, expected) in [
            ("", "'{action}' was expected once"),
            ("{action}", "'{style}' was expected once, as in '{action}_{style}_{take}.bvh'"),
            ("{action}{style}", "'{style}' follows another field; text between them was expected"),
            ("{action_{style", "a '{' has no '}'"),
            ("{action}_{style}_{action}", "'{action}' was expected once"),
        ] {
            let error = bad.parse::<Pattern>().unwrap_err().to_string();
            assert!(error.starts_with(expected), "{bad}: {error}");
        }
    }
}
