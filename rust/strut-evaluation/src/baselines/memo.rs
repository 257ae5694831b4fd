//! Trained predictors, which are kept as long as their model.

use super::global_ar::GlobalAr;
use super::gp::{Features, Gp};
use super::lti::Lti;
use super::pairs::Pairs;
use std::ops::Range;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use strut_core::transfer::Predictor;

/// A trained method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Baseline {
    /// Global autoregression ([`super::global_ar`]).
    GlobalAr,
    /// Linear systems ([`super::lti`]), one for each degree of freedom.
    Lti,
    /// A linear system ([`super::lti`]) for the principal components of all degrees of freedom.
    LtiJoint,
    /// Gaussian processes ([`super::gp`]).
    Gp,
}

impl Baseline {
    /// Returns whether the training depends on λ.
    pub(super) const fn has_ridge(self) -> bool {
        matches!(self, Self::GlobalAr)
    }
}

/// All inputs of a predictor's training, for one database.
#[derive(Clone, Debug, PartialEq)]
struct Key {
    baseline: Baseline,
    style: u16,
    /// 0 for predictors without a ridge.
    lambda: f32,
    segments: Vec<Range<usize>>,
}

/// Predictors trained so far, and features shared by those of several styles.
#[derive(Debug, Default)]
pub(super) struct Baselines {
    predictors: Memo<Key, Arc<dyn Predictor>>,
    features: Memo<Vec<Range<usize>>, Arc<Features>>,
}

impl Baselines {
    /// Predictor for some pairs, trained at the first use. Threads that train different predictors do not wait for each
    /// other.
    pub(super) fn predictor(&self, baseline: Baseline, pairs: &Pairs<'_>, lambda: f32) -> Arc<dyn Predictor> {
        let key = Key {
            baseline,
            style: pairs.style,
            lambda: if baseline.has_ridge() { lambda } else { 0.0 },
            segments: pairs.segments.clone(),
        };
        self.predictors.get(key, || match baseline {
            Baseline::GlobalAr => Arc::new(GlobalAr::train(pairs, f64::from(lambda))),
            Baseline::Lti => Arc::new(Lti::train(pairs)),
            Baseline::LtiJoint => Arc::new(Lti::train_joint(pairs)),
            Baseline::Gp => {
                let features = self.features.get(pairs.segments.clone(), || Arc::new(Features::new(pairs)));
                Arc::new(Gp::train(pairs, &features))
            }
        })
    }
}

/// Values by key; a list, as there are few.
#[derive(Debug)]
struct Memo<K, V> {
    entries: Mutex<Vec<(K, Arc<OnceLock<V>>)>>,
}

impl<K, V> Default for Memo<K, V> {
    fn default() -> Self {
        Self { entries: Mutex::default() }
    }
}

impl<K: PartialEq, V: Clone> Memo<K, V> {
    fn get(&self, key: K, make: impl FnOnce() -> V) -> V {
        let entry = {
            let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some((_, entry)) = entries.iter().find(|(k, _)| *k == key) {
                Arc::clone(entry)
            } else {
                let entry = Arc::new(OnceLock::new());
                entries.push((key, Arc::clone(&entry)));
                entry
            }
        };
        entry.get_or_init(make).clone()
    }
}
