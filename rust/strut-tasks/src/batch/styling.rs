//! Open variants, which style the inputs of jobs.

use super::key::Digests;
use super::request::BatchRequest;
use super::variants::Variant;
use crate::error::Outcome;
use crate::search::Search;
use crate::stylize::Styling;
use std::sync::Arc;
use strut_core::transfer::Model;

/// A variant with an open database.
pub(super) struct VariantStyling {
    /// Name of the variant.
    pub(super) name: String,
    /// The styling of the inputs.
    pub(super) styling: Styling,
    /// Digests of what outputs depend on.
    pub(super) digests: Digests,
}

/// Opens all variants of a request with the database of this SHA-256. `open` is called once for every kind of search.
///
/// # Errors
/// If the database lacks a style or an action, or cannot be opened.
pub(super) fn stylings(
    request: &BatchRequest,
    sha256: &str,
    mut open: impl FnMut(Search) -> Outcome<Arc<Model>>,
) -> Outcome<Vec<VariantStyling>> {
    let mut models: Vec<(Search, Arc<Model>)> = Vec::new();
    let mut of = |Variant { name, settings }: &Variant| {
        let known = models.iter().find(|(search, _)| *search == settings.search).map(|(_, model)| Arc::clone(model));
        let model = if let Some(model) = known {
            model
        } else {
            let model = open(settings.search)?;
            models.push((settings.search, Arc::clone(&model)));
            model
        };
        let styling = Styling::new(settings.stylizer(&model, &request.database)?).with_reading(&settings.reading);
        Ok(VariantStyling { name: name.clone(), styling, digests: Digests::new(sha256, &settings.canonical()?) })
    };
    request.variants.iter().map(&mut of).collect()
}
