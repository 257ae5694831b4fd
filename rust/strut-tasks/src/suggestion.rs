//! Suggestions for misspelt names: "Did you mean …?"

use strut_formats::quotation;

/// Greatest number of characters of a name in a message.
const MAX_SHOWN: usize = 40;
/// Greatest number of names in a message.
const MAX_LISTED: usize = 12;
/// Similarity (1: equal) from which a name is suggested: "eldery" and "elderly" have 0.86.
const MIN_LIKENESS: f64 = 0.6;

/// Returns the message for an unknown name.
pub fn unknown(what: &str, name: &str, known: &[impl AsRef<str>]) -> String {
    let name = &quotation(name, MAX_SHOWN);
    let likeness = |k: &str| strsim::normalized_damerau_levenshtein(&name.to_lowercase(), &k.to_lowercase());
    let closest = known.iter().map(AsRef::as_ref).max_by(|a, b| likeness(a).total_cmp(&likeness(b)));
    let advice = if let Some(closest) = closest.filter(|c| likeness(c) >= MIN_LIKENESS) {
        format!("did you mean '{closest}'?")
    } else {
        let listed: Vec<&str> = known.iter().take(MAX_LISTED).map(AsRef::as_ref).collect();
        let more = if known.len() > MAX_LISTED { ", …" } else { "" };
        format!("there are {}{more}", listed.join(", "))
    };
    format!("there is no {what} '{name}'; {advice}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_name_is_recognised_and_a_strange_one_answered_with_the_list() {
        let styles = ["active", "elderly", "normal"];
        assert_eq!(unknown("style", "Eldery", &styles), "there is no style 'Eldery'; did you mean 'elderly'?");
        assert_eq!(
            unknown("style", "zombie", &styles),
            "there is no style 'zombie'; there are active, elderly, normal"
        );
    }
}
