//! Errors as values for JavaScript.

use std::fmt::Display;
use wasm_bindgen::prelude::wasm_bindgen;

/// Error that every fallible call throws. `web/engine/errors.ts` converts it to a `StrutError`.
#[wasm_bindgen]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EngineError {
    code: &'static str,
    message: String,
    hint: String,
}

#[wasm_bindgen]
impl EngineError {
    /// Returns the code: `bad-file`, `bad-input` or `gpu-lost`.
    #[wasm_bindgen(getter)]
    pub fn code(&self) -> String {
        self.code.into()
    }

    /// Returns the message, a sentence for users.
    #[wasm_bindgen(getter)]
    pub fn message(&self) -> String {
        self.message.clone()
    }

    /// Returns how to solve the problem, or an empty string.
    #[wasm_bindgen(getter)]
    pub fn hint(&self) -> String {
        self.hint.clone()
    }
}

impl EngineError {
    /// Creates the error of an invalid file.
    pub fn bad_file(error: impl Display, hint: &str) -> Self {
        Self { code: "bad-file", message: sentence(error), hint: hint.into() }
    }

    /// Creates the error of an invalid file, without a hint.
    pub fn unusable_file(error: impl Display) -> Self {
        Self::bad_file(error, "")
    }

    /// Creates the error of an argument outside its range.
    pub fn bad_input(error: impl Display) -> Self {
        Self { code: "bad-input", message: sentence(error), hint: String::new() }
    }

    /// Creates the error of a GPU that gives no result.
    pub fn without_graphics(error: impl Display) -> Self {
        Self { code: "gpu-lost", message: sentence(error), hint: String::new() }
    }
}

/// Makes a sentence of a message: Rust's messages begin with a small letter and have no full stop.
pub fn sentence(message: impl Display) -> String {
    let message = message.to_string();
    let mut sentence = message;
    // Our messages begin with ASCII. The tables of other letters would take a tenth of a small package.
    if let Some(first) = sentence.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    if !sentence.ends_with(['.', '!', '?']) {
        sentence.push('.');
    }
    sentence
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
