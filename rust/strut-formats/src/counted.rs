//! Counts of things in messages.

/// Returns a number and a noun, with a plural s unless the number is 1: `1 clip`, `2 clips`.
pub fn counted(number: usize, thing: &str) -> String {
    format!("{number} {thing}{}", if number == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_thing_is_not_several() {
        let of = |number: usize| counted(number, "gait cycle");
        assert_eq!([0, 1, 2].map(of), ["0 gait cycles", "1 gait cycle", "2 gait cycles"]);
    }
}
