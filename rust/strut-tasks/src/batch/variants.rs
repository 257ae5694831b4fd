//! Variants: named styles and options. Every input is styled in every variant.

use crate::error::{Outcome, TaskError};
use crate::files;
use crate::stylize::StyleSettings;
use crate::weights::StyleWeights;
use std::path::{Component, Path};
use strut_formats::quotation;

/// Greatest size of a table of variants, bytes.
const MAX_TABLE_BYTES: usize = 16 << 20;

/// Settings of a variant, and the name of its output folder.
#[derive(Clone, Debug)]
pub struct Variant {
    /// Name of the folder.
    pub name: String,
    /// Styles and options.
    pub settings: StyleSettings,
}

impl Variant {
    /// Creates a variant whose name is also a folder name.
    ///
    /// # Errors
    /// If the name is no valid folder name, begins with a dot, or has several parts.
    pub fn new(name: &str, settings: StyleSettings) -> Outcome<Self> {
        let mut parts = Path::new(name).components();
        let is_plain = matches!((parts.next(), parts.next()), (Some(Component::Normal(part)), None) if part == name);
        let is_strange = |c: char| c.is_control() || matches!(c, '\\' | ':' | '/');
        if !is_plain || name.starts_with('.') || name.contains(is_strange) || name.len() > 200 {
            let expected = "the name of a folder, without a path and without a leading dot, was expected";
            return Err(TaskError::usage(format_args!("the variant is '{}'; {expected}", quotation(name, 40))));
        }
        Ok(Self { name: name.to_owned(), settings })
    }

    /// Creates a variant of styles as they were typed. Its name is that text with `+` in place of commas.
    ///
    /// # Errors
    /// If the name is not valid as a folder name.
    pub fn of_styles(typed: &str, settings: StyleSettings) -> Outcome<Self> {
        Self::new(&typed.replace(',', "+"), settings)
    }
}

/// Reads the variants in a table with the columns `variant,style[,option…]`. An empty cell keeps the value of
/// `settings`.
///
/// # Errors
/// A message about the first faulty line.
pub fn read_variants(path: &Path, settings: impl Fn(StyleWeights) -> Outcome<StyleSettings>) -> Outcome<Vec<Variant>> {
    let bytes = files::read(path, MAX_TABLE_BYTES)?;
    let fail = |reason: String| TaskError::in_file(path, reason);
    let mut table = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(&bytes[..]);
    let header = table.headers().map_err(|e| fail(e.to_string()))?.clone();
    if header.get(0) != Some("variant") || header.get(1) != Some("style") {
        return Err(fail("line 1 has other columns; variant,style[,option…] was expected".into()));
    }
    let mut variants: Vec<Variant> = Vec::new();
    for row in table.records() {
        let row = row.map_err(|e| fail(e.to_string()))?;
        let line = row.position().map_or(0, csv::Position::line);
        let in_line = |reason: String| fail(format!("line {line}: {reason}"));
        let styles = row[1].parse().map_err(in_line)?;
        let mut of = settings(styles)?;
        for (name, value) in header.iter().zip(&row).skip(2).filter(|(_, value)| !value.is_empty()) {
            of.set(&name.replace('_', "-"), value).map_err(|e| in_line(e.to_string()))?;
        }
        let variant = Variant::new(&row[0], of).map_err(|e| in_line(e.to_string()))?;
        if variants.iter().any(|other| other.name == variant.name) {
            return Err(in_line(format!("there are two variants '{}'; different names were expected", variant.name)));
        }
        variants.push(variant);
    }
    if variants.is_empty() {
        Err(fail("the table has no variant; a line for each was expected".into()))
    } else {
        Ok(variants)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(table: &str) -> Outcome<Vec<Variant>> {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), table).unwrap();
        read_variants(file.path(), |styles| Ok(StyleSettings::new(styles)))
    }

    #[test]
    fn a_table_has_a_variant_a_line_with_options_by_column() {
        let variants =
            read("variant,style,k,input_style\ncalm,\"old=0.5,proud=0.2\",20,\nloud,angry=2,,neutral\n").unwrap();
        let [calm, loud] = &variants[..] else { panic!("{variants:?}") };
        assert_eq!((calm.name.as_str(), calm.settings.options.k, loud.settings.options.k), ("calm", 20, 40));
        assert_eq!((&calm.settings.input_style, &loud.settings.input_style), (&None, &Some("neutral".to_owned())));
    }

    #[test]
    fn faults_of_a_table_are_named_with_their_line() {
        for (table, expected) in [
            ("style,variant\nold,a\n", "line 1 has other columns"),
            ("variant,style\n", "the table has no variant"),
            ("variant,style\na,old\na,proud\n", "line 3: there are two variants 'a'"),
            ("variant,style\n../a,old\n", "line 2: the variant is '../a'"),
            ("variant,style\na,old=x\n", "line 2: the weight is 'x'"),
            ("variant,style,q\na,old,1\n", "line 2: there is no option 'q'"),
            ("variant,style,k\na,old\n", "found record with 2 fields"),
        ] {
            let error = read(table).unwrap_err().to_string();
            assert!(error.contains(expected), "{table:?}: {error}");
        }
    }

    #[test]
    fn messages_show_the_beginning_of_what_is_long() {
        let long = "x".repeat(5000);
        for table in [format!("variant,style\n{long},old\n"), format!("variant,style,k\na,old,{long}\n")] {
            let reason = read(&table).unwrap_err().to_string();
            assert!(reason.chars().count() < 500, "{} characters", reason.chars().count());
        }
    }

    #[test]
    fn the_styles_as_typed_name_a_folder() {
        let settings = || StyleSettings::new("old".parse().unwrap());
        assert_eq!(Variant::of_styles("proud=0.7,old=-0.3", settings()).unwrap().name, "proud=0.7+old=-0.3");
        for bad in ["", ".", "..", ".attempts", "a/b", "/a", "a/", "a\\b", "c:"] {
            assert!(Variant::new(bad, settings()).is_err(), "{bad}");
        }
    }
}
