//! Errors as values for JavaScript.

use std::fmt::Display;
use wasm_bindgen::prelude::wasm_bindgen;

/// What every fallible call throws: `web/engine/errors.ts` makes it a `StrutError`.
#[wasm_bindgen]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EngineError {
    code: &'static str,
    message: String,
    hint: String,
}

#[wasm_bindgen]
impl EngineError {
    /// `bad-file` or `bad-input`.
    #[wasm_bindgen(getter)]
    pub fn code(&self) -> String {
        self.code.into()
    }

    /// A sentence for people.
    #[wasm_bindgen(getter)]
    pub fn message(&self) -> String {
        self.message.clone()
    }

    /// What to do about it, or empty.
    #[wasm_bindgen(getter)]
    pub fn hint(&self) -> String {
        self.hint.clone()
    }
}

impl EngineError {
    /// The bytes are not what they should be.
    pub(crate) fn bad_file(error: impl Display, hint: &str) -> Self {
        Self { code: "bad-file", message: sentence(&error.to_string()), hint: hint.into() }
    }

    /// An argument is outside its range.
    pub(crate) fn bad_input(error: impl Display) -> Self {
        Self { code: "bad-input", message: sentence(&error.to_string()), hint: String::new() }
    }
}

/// The core's messages follow Rust's custom: no capital, no full stop. People get a sentence.
fn sentence(message: &str) -> String {
    let mut letters = message.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string()).unwrap_or_default();
    let stop = if message.ends_with(['.', '!', '?']) { "" } else { "." };
    format!("{first}{}{stop}", letters.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_become_sentences() {
        let error = EngineError::bad_input("k is 0; 1 to 1000 was expected");
        assert_eq!(error.message(), "K is 0; 1 to 1000 was expected.");
        assert_eq!(EngineError::bad_file("No frames.", "").message(), "No frames.");
    }
}
