//! Labels from file names: `--pattern '{set}_{action}_{style}_{take}.bvh'`.

use std::str::FromStr;

/// What a file name says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Labels {
    pub(crate) action: String,
    pub(crate) style: String,
    pub(crate) take: Option<u32>,
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

/// Fields with text between. A field stands for one or more characters up to the text that follows it;
/// `{action}`, `{style}` and `{take}` do not contain the text before them either, so that
/// `{action}_{style}` does not take `walk_old_001` for the style `old_001`.
///
/// A pattern with `/` is compared with as many folders of a path; `.bvh` at its end may be left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Pattern {
    text: String,
    parts: Vec<Part>,
    slashes: usize,
}

impl FromStr for Pattern {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut parts = Vec::new();
        let mut rest = without_extension(text);
        while !rest.is_empty() {
            if let Some(field) = rest.strip_prefix('{') {
                let (name, after) = field.split_once('}').ok_or("a '{' has no '}'")?;
                if matches!(parts.last(), Some(Part::Field(_))) {
                    return Err(format!("'{{{name}}}' follows another field; text between them was expected"));
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
                return Err(format!("'{{{name}}}' was expected once, as in '{{action}}_{{style}}_{{take}}.bvh'"));
            }
        }
        Ok(Self { text: text.to_owned(), parts, slashes: text.matches('/').count() })
    }
}

impl Pattern {
    /// The labels of a file, or why it has none.
    pub(crate) fn labels(&self, path: &str) -> Result<Labels, String> {
        let no_match = || format!("its name does not match '{}'", self.text);
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

/// The number of a take.
pub(crate) fn parse_take(text: &str) -> Result<u32, String> {
    text.parse().map_err(|_| format!("its take is '{text}'; a number was expected"))
}

/// The end of a path from the last but `slashes` folder on.
fn tail(path: &str, slashes: usize) -> &str {
    path.rmatch_indices('/').nth(slashes).map_or(path, |(at, _)| &path[at + 1..])
}

fn without_extension(path: &str) -> &str {
    let stem =
        path.len().checked_sub(4).filter(|&at| path.is_char_boundary(at) && path[at..].eq_ignore_ascii_case(".bvh"));
    stem.map_or(path, |at| &path[..at])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(pattern: &str, path: &str) -> Result<Labels, String> {
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
        let no_match = Err("its name does not match '{action}_{style}.bvh'".to_owned());
        for path in ["walk.bvh", "walk_.bvh", "_old.bvh", "walk_old_001.bvh"] {
            assert_eq!(labels("{action}_{style}.bvh", path), no_match, "{path}");
        }
        let take = labels("{action}_{style}_{take}", "walk_old_x.bvh");
        assert_eq!(take, Err("its take is 'x'; a number was expected".into()));
    }

    #[test]
    fn patterns_need_both_labels_and_text_between_fields() {
        for bad in ["", "{action}", "{action}{style}", "{action_{style}", "{action}_{style}_{action}"] {
            assert!(bad.parse::<Pattern>().is_err(), "{bad}");
        }
    }
}
