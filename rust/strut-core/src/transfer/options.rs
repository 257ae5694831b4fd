//! Options of the transfer, with the reasons for the default values.

use super::trained::TrainedMethod;
use thiserror::Error;

/// Method that computes a prediction from the neighbours.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Method {
    /// Mixture of autoregressive models, one for each class (Eq. 2–5), with bias correction: Strut's own method.
    #[default]
    Mar,
    /// One local autoregression on the K nearest neighbours of all allowed classes together.
    LocalAr,
    /// The registered target of the nearest neighbour.
    NearestNeighbour,
    /// Inverse-distance mean of the registered targets of the K nearest neighbours of all allowed classes.
    Knn,
    /// A method of another crate that is trained on all rows of the allowed classes.
    Trained(&'static TrainedMethod),
}

impl Method {
    /// The method of a command-line name, apart from methods with training.
    pub fn from_name(name: &str) -> Option<Self> {
        match name {
            "mar" => Some(Self::Mar),
            "lar" => Some(Self::LocalAr),
            "nn" => Some(Self::NearestNeighbour),
            "knn" => Some(Self::Knn),
            _ => None,
        }
    }

    /// Command-line name of the method.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Mar => "mar",
            Self::LocalAr => "lar",
            Self::NearestNeighbour => "nn",
            Self::Knn => "knn",
            Self::Trained(method) => method.name,
        }
    }

    /// Returns whether λ is a parameter of the training.
    pub(super) fn trains_with_ridge(self) -> bool {
        self.trained().is_some_and(|method| method.has_ridge)
    }

    /// The method's training, if it needs one.
    pub(super) fn trained(self) -> Option<&'static TrainedMethod> {
        if let Self::Trained(method) = self { Some(method) } else { None }
    }
}

/// Options of a [`super::Stylizer`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// K: number of neighbours in each class. From 5 to 160 the error changes by 0.03 cm; 40 is the paper's value.
    pub k: usize,
    /// δ of Eq. 4: how fast a class's weight decreases with its distance, for known input; three times as wide for
    /// unknown input. Inside the database 0.35 is better than 0.7; outside a small database it is rough.
    pub delta: f32,
    /// Classes whose weight is below this share of the largest are skipped: with δ 0.35 those whose D is more than 4.8
    /// times the smallest (12.4 times for unknown input). 0 skips none. On ten clips of other data sets 31.3 of 35
    /// classes remain, and joints move by at most 6e-6 m before feet are planted, 6e-8 m on average; with 1e-4 it was
    /// 30.5, 6e-5 m and 2e-7 m.
    pub least_weight: f32,
    /// λ: ridge of the regressions as a share of K, on variables scaled by their global standard deviations.
    pub lambda: f32,
    /// κ of Eq. 6: the part of the input outside μ ± κσ of its neighbours is bias. With 3, input that is similar to the
    /// database has none.
    pub kappa: f32,
    /// ρ of Eq. 7: share of the bias that is added to the output. More keeps more of the input's own content, less
    /// gives more of the style.
    pub rho: f32,
    /// η of the phase lock: share of the tempo that the style determines where the input walks or runs. 0 keeps the
    /// input's deviation from the neutral tempo, 1 removes it.
    pub tempo: f32,
    /// Whether the output of [`Method::Mar`] is smoothed where the input is unlike the database: neighbours have less
    /// weight the farther they are, and a complementary filter smooths the predictions. Not in the paper; the
    /// acceleration ratio outside the database decreases from 1.59 to 1.24, inside nothing changes.
    pub coherence: bool,
    /// Whether output frames last as long as predicted; otherwise as long as the input's frames.
    pub timing: bool,
    /// Whether planted feet are held in place.
    pub footplant: bool,
    /// Index of the input's action, if known.
    pub action: Option<u16>,
    /// Index of the input's style, if known.
    pub input_style: Option<u16>,
    /// Method of prediction.
    pub method: Method,
}

impl Options {
    /// Default values of `docs/methods/mar.md` §1: unlabelled input, everything on.
    pub const DEFAULT: Self = Self {
        k: 40,
        delta: 0.35,
        least_weight: 2e-5,
        lambda: 0.1,
        kappa: 3.0,
        rho: 0.7,
        tempo: 0.5,
        coherence: true,
        timing: true,
        footplant: true,
        action: None,
        input_style: None,
        method: Method::Mar,
    };
}

impl Default for Options {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// Greatest number of neighbours in a class.
pub const MAX_K: usize = 1000;

/// Reason why options are rejected.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum OptionsError {
    /// A number is outside its range.
    #[error("{name} is {value}; {expected} was expected")]
    Range {
        /// Name of the option.
        name: &'static str,
        /// Its value.
        value: f32,
        /// Valid range.
        expected: &'static str,
    },
    /// The database has no frames of the action and style that the options specify for the input.
    #[error("the database has no class of action {action:?} and style {style:?}")]
    NoClass {
        /// Index of the requested action.
        action: Option<u16>,
        /// Index of the requested style.
        style: Option<u16>,
    },
}

impl Options {
    /// Returns whether the data that are prepared for these options before the first frame (components, working memory,
    /// trained predictors) are valid for the others too. All other options are read in every frame.
    pub(super) fn predicts_like(&self, other: &Self) -> bool {
        (self.k, self.action, self.input_style, self.method) == (other.k, other.action, other.input_style, other.method)
            && (self.lambda == other.lambda || !self.method.trains_with_ridge())
    }

    /// Checks all numbers.
    ///
    /// # Errors
    /// [`OptionsError::Range`] names the first option outside its range.
    pub fn validate(&self) -> Result<(), OptionsError> {
        let check = |name, value: f32, ok: bool, expected| {
            if ok { Ok(()) } else { Err(OptionsError::Range { name, value, expected }) }
        };
        check("k", self.k as f32, (1..=MAX_K).contains(&self.k), "1 to 1000")?;
        check("delta", self.delta, self.delta >= 0.01 && self.delta <= 100.0, "0.01 to 100")?;
        check("least_weight", self.least_weight, (0.0..=1.0).contains(&self.least_weight), "0 to 1")?;
        check("lambda", self.lambda, self.lambda >= 1e-4 && self.lambda <= 1e4, "0.0001 to 10000")?;
        check("kappa", self.kappa, self.kappa >= 0.0, "0 or more")?;
        check("rho", self.rho, (0.0..=1.0).contains(&self.rho), "0 to 1")?;
        check("tempo", self.tempo, (0.0..=1.0).contains(&self.tempo), "0 to 1")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_valid_and_nan_is_not() {
        assert_eq!(Options::DEFAULT.validate(), Ok(()));
        for bad in [
            Options { k: 0, ..Options::DEFAULT },
            Options { delta: f32::NAN, ..Options::DEFAULT },
            Options { least_weight: f32::NAN, ..Options::DEFAULT },
            Options { lambda: 0.0, ..Options::DEFAULT },
            Options { kappa: f32::NAN, ..Options::DEFAULT },
            Options { rho: 1.5, ..Options::DEFAULT },
            Options { tempo: -0.1, ..Options::DEFAULT },
        ] {
            assert!(bad.validate().is_err());
        }
    }
}
