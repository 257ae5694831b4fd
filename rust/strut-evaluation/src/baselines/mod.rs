//! Baselines with training, for comparison: global autoregression, linear time-invariant systems and Gaussian
//! processes. (Nearest neighbour, KNN interpolation and the local autoregression use the search and are in
//! [`strut_core::transfer`].)
//!
//! All are trained on the same pairs: rows of a database and their registered targets in one style. They are selected
//! by [`Method::Trained`] like every other method. They are trained when a style is activated, once for each model.
//! Sums are in double precision. In the browser only the package of the Compare view contains them.

mod gaussian_process;
mod global_ar;
mod gp;
mod lti;
mod memo;
mod pairs;
mod principal;
mod products;
mod subspace;

use memo::{Baseline, Baselines};
use pairs::Pairs;
use std::sync::Arc;
use strut_core::transfer::{Method, Predictor, TrainedMethod, Training};

/// One autoregression for each degree of freedom, fitted to all rows of the allowed classes.
pub const GLOBAL_AR: Method = Method::Trained(&TrainedMethod {
    name: "gar",
    has_ridge: Baseline::GlobalAr.has_ridge(),
    train: |training| train(Baseline::GlobalAr, training),
});
/// A linear time-invariant system for each degree of freedom (Hsu, Pulli, Popović 2005).
pub const LTI: Method = Method::Trained(&TrainedMethod {
    name: "lti-dof",
    has_ridge: Baseline::Lti.has_ridge(),
    train: |training| train(Baseline::Lti, training),
});
/// A linear time-invariant system for the principal components of all degrees of freedom.
pub const LTI_JOINT: Method = Method::Trained(&TrainedMethod {
    name: "lti",
    has_ridge: Baseline::LtiJoint.has_ridge(),
    train: |training| train(Baseline::LtiJoint, training),
});
/// Gaussian processes from the input to the change of pose (Ikemoto, Arikan, Forsyth 2009).
pub const GP: Method = Method::Trained(&TrainedMethod {
    name: "gp",
    has_ridge: Baseline::Gp.has_ridge(),
    train: |training| train(Baseline::Gp, training),
});

/// The method of a command-line name: one of the core's, or one with training.
pub fn method_named(name: &str) -> Option<Method> {
    let trained = || [GLOBAL_AR, LTI, LTI_JOINT, GP].into_iter().find(|method| method.name() == name);
    Method::from_name(name).or_else(trained)
}

/// The predictor of a model, trained at the first use.
fn train(baseline: Baseline, training: &Training<'_>) -> Arc<dyn Predictor> {
    let pairs = Pairs::new(training.model.catalogue(), training.targets, training.classes);
    training.model.extension::<Baselines>().predictor(baseline, &pairs, training.lambda)
}

#[cfg(test)]
mod tests;
