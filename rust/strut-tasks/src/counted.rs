//! Numbers of things in messages.

/// A number of things whose name gets an s where there is not one of them: `1 clip`, `2 clips`.
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
