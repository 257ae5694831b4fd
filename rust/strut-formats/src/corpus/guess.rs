//! Guesses the pattern of a set of file names.
//!
//! Names are split into columns at a delimiter; folders are columns too. A column whose values are known words for
//! actions, or for styles, is most likely that label; a last column of numbers is the take. Without known words,
//! columns that vary are preferred, and the action comes before the style, as in most published sets.

use super::pattern::{Pattern, without_extension};
use std::collections::{BTreeMap, BTreeSet};

/// Separators of the parts of a name, the usual one first.
const DELIMITERS: [char; 4] = ['_', '-', ' ', '.'];
/// Number of folders above a file that may contain a label.
const MAX_FOLDERS: usize = 2;

/// Beginnings of words for actions; two letters are whole words …
const ACTIONS: [&str; 44] = [
    "walk", "run", "jog", "sprint", "jump", "hop", "leap", "skip", "kick", "punch", "box", "fight", "slash", "throw",
    "catch", "dance", "wave", "bow", "greet", "call", "respond", "turn", "sit", "stand", "idle", "crawl", "climb",
    "march", "step", "stair", "sneak", "lift", "push", "pull", "reach", "guide", "fw", "bw", "fr", "br", "sw", "sr",
    "tr1", "tr2",
];
/// … and for styles.
const STYLES: [&str; 60] = [
    "neutral",
    "normal",
    "angry",
    "anger",
    "happy",
    "happi",
    "sad",
    "proud",
    "depress",
    "strut",
    "child",
    "old",
    "elder",
    "young",
    "youth",
    "sexy",
    "femini",
    "masculin",
    "female",
    "male",
    "active",
    "exhaust",
    "tired",
    "fatigue",
    "drunk",
    "afraid",
    "fear",
    "scared",
    "disgust",
    "surpris",
    "shy",
    "confiden",
    "relax",
    "lazy",
    "heavy",
    "zombie",
    "robot",
    "swagger",
    "polite",
    "hurt",
    "injur",
    "limp",
    "joy",
    "excit",
    "nervous",
    "calm",
    "aggress",
    "gentle",
    "enthusias",
    "giant",
    "musical",
    "chimp",
    "cat",
    "dinosaur",
    "elated",
    "graceful",
    "stiff",
    "crouch",
    "tiptoe",
    "style",
];

/// Values of one column of the names.
struct Column<'a> {
    values: BTreeSet<&'a str>,
    names: usize,
    is_folder: bool,
}

impl Column<'_> {
    fn varies(&self) -> bool {
        self.values.len() > 1
    }

    fn is_numeric(&self) -> bool {
        self.values.iter().all(|v| !v.is_empty() && v.bytes().all(|b| b.is_ascii_digit()))
    }

    /// Share of the values that contain a word with one of these beginnings.
    fn share_of(&self, beginnings: &[&str]) -> f32 {
        let known = |value: &&&str| {
            let lower = value.to_lowercase();
            let mut words = lower.split(|c: char| !c.is_alphanumeric());
            words.any(|word| beginnings.iter().any(|b| word == *b || (b.len() > 2 && word.starts_with(b))))
        };
        self.values.iter().filter(known).count() as f32 / self.values.len() as f32
    }

    /// Likelihood that the column is the label to which these words belong.
    fn fits(&self, beginnings: &[&str]) -> f32 {
        // Known words weigh most; then variation, but labels repeat; file names before folders, which often contain a
        // whole set.
        let varies = if self.varies() { 0.3 } else { 0.0 };
        let repeats = 0.2 * (1.0 - self.values.len() as f32 / self.names as f32);
        self.share_of(beginnings) + varies + repeats - if self.is_folder { 0.1 } else { 0.0 }
    }
}

/// Most likely pattern of these paths; `None` if no delimiter results in both an action and a style.
pub fn guess_pattern<P: AsRef<str>>(paths: &[P]) -> Option<Pattern> {
    let best = DELIMITERS.into_iter().filter_map(|delimiter| candidate(paths, delimiter));
    // Of equal candidates the first one is chosen: the more common delimiter.
    best.reduce(|a, b| if b.0 > a.0 { b } else { a }).map(|(_, pattern)| pattern)
}

/// Pattern for one delimiter, and its score.
fn candidate<P: AsRef<str>>(paths: &[P], delimiter: char) -> Option<(f32, Pattern)> {
    let cut: Vec<(Vec<&str>, Vec<&str>)> = paths.iter().map(|path| columns_of(path.as_ref(), delimiter)).collect();
    let mut counts: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for (folders, parts) in &cut {
        *counts.entry((parts.len(), folders.len())).or_default() += 1;
    }
    let (&(parts, folders), &agreeing) = counts.iter().max_by_key(|(_, count)| **count)?;
    let usual: Vec<Vec<&str>> =
        cut.into_iter().filter(|(f, p)| p.len() == parts && f.len() == folders).map(|(f, p)| [f, p].concat()).collect();
    let columns: Vec<Column> = (0..folders + parts)
        .map(|i| Column {
            values: usual.iter().map(|row| row[i]).collect(),
            names: usual.len(),
            is_folder: i < folders,
        })
        .collect();

    let take = (columns.len() > 2).then_some(columns.len() - 1).filter(|&i| columns[i].is_numeric());
    let free = || (0..columns.len()).filter(move |i| Some(*i) != take);
    let fits = |beginnings: &[&str]| columns.iter().map(|column| column.fits(beginnings)).collect::<Vec<f32>>();
    let (fits_action, fits_style) = (fits(&ACTIONS), fits(&STYLES));
    let is_numeric: Vec<bool> = columns.iter().map(Column::is_numeric).collect();
    let mut best: Option<(f32, usize, usize)> = None;
    for (action, style) in free().flat_map(|a| free().map(move |s| (a, s))).filter(|(a, s)| a != s) {
        let numeric_style = if is_numeric[style] { 0.2 } else { 0.0 };
        let order = if action < style { 0.01 } else { 0.0 };
        let score = fits_action[action] + fits_style[style] - numeric_style + order;
        if best.is_none_or(|(s, ..)| score > s) {
            best = Some((score, action, style));
        }
    }
    let (score, action, style) = best?;

    let mut text = String::new();
    // Folders above the first label are ignored.
    for (i, column) in columns.iter().enumerate().skip(action.min(style).min(folders)) {
        if !text.is_empty() {
            text.push(if i <= folders { '/' } else { delimiter });
        }
        match column.values.first() {
            _ if i == action => text.push_str("{action}"),
            _ if i == style => text.push_str("{style}"),
            _ if Some(i) == take => text.push_str("{take}"),
            Some(value) if !column.varies() && !value.is_empty() && !value.contains(['{', '}']) => text.push_str(value),
            _ => text.push_str("{any}"),
        }
    }
    let share = agreeing as f32 / paths.len() as f32;
    Some((score + 2.0 * share, (text + ".bvh").parse().ok()?))
}

/// Folders directly above a file, and the parts of its name.
fn columns_of(path: &str, delimiter: char) -> (Vec<&str>, Vec<&str>) {
    let mut components = without_extension(path).rsplit('/');
    let parts = components.next().unwrap_or_default().split(delimiter).collect();
    let mut folders: Vec<&str> = components.take(MAX_FOLDERS).collect();
    folders.reverse();
    (folders, parts)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn guessed(paths: &[&str]) -> String {
        guess_pattern(paths).map(|p| p.to_string()).unwrap_or_default()
    }

    #[test]
    fn published_sets_are_recognised() {
        let bandai = ["a.zip/dataset-2_walk-turn-left_normal_001.bvh", "a.zip/dataset-2_run_elderly_002.bvh"];
        assert_eq!(guessed(&bandai), "dataset-2_{action}_{style}_{take}.bvh");
        assert_eq!(guessed(&["angry_01_000.bvh", "old_13_000.bvh", "old_01_001.bvh"]), "{style}_{action}_{take}.bvh");
        assert_eq!(guessed(&["Angry_FW.bvh", "Old_BR.bvh", "Zombie_FW.bvh"]), "{style}_{action}.bvh");
    }

    #[test]
    fn a_label_may_be_a_folder_or_the_same_everywhere() {
        let folders = ["set/old/walk 1.bvh", "set/angry/walk 2.bvh", "set/angry/run 3.bvh"];
        assert_eq!(guessed(&folders), "{style}/{action} {take}.bvh");
        assert_eq!(guessed(&["walk-old-1.bvh", "walk-sad-1.bvh"]), "{action}-{style}-{take}.bvh");
    }

    #[test]
    fn a_few_odd_names_do_not_hide_the_pattern() {
        let paths = ["walk_old_1.bvh", "run_old_1.bvh", "test.bvh", "walk_sad_1.bvh", "a_b_c_d.bvh"];
        assert_eq!(guessed(&paths), "{action}_{style}_{take}.bvh");
    }

    #[test]
    fn words_that_are_not_known_fall_back_on_the_usual_order() {
        assert_eq!(guessed(&["歩く_怒り_1.bvh", "走る_普通_2.bvh"]), "{action}_{style}_{take}.bvh");
        assert_eq!(guessed(&["x{y_{style_1.bvh", "z_w_2.bvh"]), "{action}_{style}_{take}.bvh");
    }

    /// Names of many parts, such as hashes and dates, have many columns; each is evaluated once.
    #[test]
    fn names_of_many_parts_take_no_more_than_their_length() {
        const FILES: usize = 200;
        const PARTS: usize = 30;
        let name = |file: usize| {
            let parts: Vec<String> = (0..PARTS).map(|part| format!("{:x}", file * 7919 + part)).collect();
            parts.join("_") + ".bvh"
        };
        let paths: Vec<String> = (0..FILES).map(name).collect();
        let counted = allocation_counter::measure(|| _ = guess_pattern(&paths));
        assert!(counted.count_total < 10 * (FILES * PARTS) as u64, "{} allocations", counted.count_total);
    }

    #[test]
    fn names_without_two_parts_have_no_pattern() {
        assert_eq!(guess_pattern(&["walk.bvh", "run.bvh"]), None);
        assert_eq!(guess_pattern::<&str>(&[]), None);
    }

    #[test]
    fn a_guessed_pattern_matches_the_names() {
        for paths in [["a/b/c.bvh", "a/d/e.bvh"], ["a_b.bvh", "c_d.bvh"], ["s/1_2_3_4.bvh", "t/1_2_3_5.bvh"]] {
            let pattern = guess_pattern(&paths).unwrap();
            for path in paths {
                assert!(pattern.labels(path).is_ok(), "{pattern} and {path}");
            }
        }
    }
}
