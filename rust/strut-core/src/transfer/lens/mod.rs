//! View into one frame of the transfer: the numbers behind a prediction, for lessons.
//!
//! A [`Lens`] runs a [`Stylizer`] up to a frame and reads the state from which the frame was computed. Variations, with
//! other neighbours, another ridge or a changed pose, are computed by the functions that the stylizer itself calls.

mod contacts;
mod error;
mod fit;
mod query;
mod sweep;
mod timing;
mod warps;

pub use contacts::Contacts;
pub use error::LensError;
pub use fit::{Fit, FitSettings};
pub use query::QueryChange;
pub use timing::Timing;
pub use warps::Warps;

use super::coherence::taper;
use super::mar::class_k;
use super::model::Model;
use super::options::Options;
use super::stylizer::Stylizer;
use crate::humanoid::Pose;
use crate::pose_vector::{HeadingFilter, Placement, PoseRow, ROW};
use crate::search::{MAX_WINDOW, Metric, Neighbour, Neighbours, Profile, QueryWindow, Scratch};
use error::among;
use std::sync::{Arc, OnceLock};

/// Number of frames before the viewed one on which the stylizer is run; earlier frames are ignored.
const WARM_UP: usize = 60;

/// First frame that can be viewed: the two before it provide a velocity and a previous output.
const FIRST: usize = 2;

/// A class of the database, for a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClassDistance {
    /// λⱼ of Eq. 4, 0 to 1.
    pub weight: f32,
    /// Dⱼ: mean squared distance of its K nearest windows, m². Also given for classes that the stylizer skips.
    pub mean_square: f32,
}

/// A neighbour of the query in a class.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WeightedNeighbour {
    /// Last row of its window.
    pub row: usize,
    /// D, m².
    pub square: f32,
    /// Its weight in regressions, 0 to 1.
    pub weight: f32,
}

/// An input and one of its frames, with the stylizer's internal state.
#[derive(Clone, Debug)]
pub struct Lens {
    stylizer: Stylizer,
    input: Vec<Pose>,
    frame: usize,
    /// xₜ and xₜ₋₁.
    now: PoseRow,
    previous: PoseRow,
    /// yₜ₋₁ of every style; `None` if the style is not predicted.
    outputs_before: Vec<Option<PoseRow>>,
    /// Windows of each length that was requested.
    profiles: [OnceLock<Profile>; MAX_WINDOW],
    scratch: Scratch,
}

impl Lens {
    /// A lens on an input that has the database's proportions and rate, in these styles (one weight for each style, as
    /// in [`Stylizer::set_styles`]), at the first frame that can be viewed.
    ///
    /// # Errors
    /// If the input is too short, or the options or weights are invalid.
    pub fn new(model: Arc<Model>, input: Vec<Pose>, options: Options, styles: &[f32]) -> Result<Self, LensError> {
        if input.len() <= FIRST {
            return Err(LensError::TooShort { frames: input.len(), least: FIRST + 1 });
        }
        let scratch = model.index().scratch(options.k);
        let outputs_before = vec![None; model.catalogue().styles.len()];
        let mut stylizer = Stylizer::new(model, options)?;
        stylizer.set_styles(styles)?;
        let mut lens = Self {
            stylizer,
            input,
            frame: FIRST,
            now: [0.0; ROW],
            previous: [0.0; ROW],
            outputs_before,
            profiles: Default::default(),
            scratch,
        };
        lens.look_at(FIRST);
        Ok(lens)
    }

    /// Moves to a frame, or to the nearest that can be viewed.
    pub fn look_at(&mut self, frame: usize) {
        self.frame = frame.clamp(FIRST, self.input.len() - 1);
        self.stylizer.reset(None);
        for at in self.frame.saturating_sub(WARM_UP)..self.frame {
            self.stylizer.push(&self.input[at]);
        }
        self.previous = self.stylizer.inside().input.copied().unwrap_or([0.0; ROW]);
        for (style, before) in self.outputs_before.iter_mut().enumerate() {
            *before = self.stylizer.predicted_row(style).copied();
        }
        self.stylizer.push(&self.input[self.frame]);
        self.now = self.stylizer.inside().input.copied().unwrap_or([0.0; ROW]);
    }

    /// Replaces the options and computes the frame again.
    ///
    /// # Errors
    /// If one is out of range; the previous options are then kept.
    pub fn set_options(&mut self, options: Options) -> Result<(), LensError> {
        self.stylizer.set_options(options)?;
        self.scratch = self.model().index().scratch(options.k);
        self.look_at(self.frame);
        Ok(())
    }

    /// Replaces the styles and computes the frame again.
    ///
    /// # Errors
    /// If the number of weights is wrong or one is not finite; the previous weights are then kept.
    pub fn set_styles(&mut self, weights: &[f32]) -> Result<(), LensError> {
        self.stylizer.set_styles(weights)?;
        self.look_at(self.frame);
        Ok(())
    }

    /// Index of the viewed frame.
    pub fn frame(&self) -> usize {
        self.frame
    }

    /// The stylizer after that frame.
    pub fn stylizer(&self) -> &Stylizer {
        &self.stylizer
    }

    /// The shared model.
    pub fn model(&self) -> &Arc<Model> {
        self.stylizer.model()
    }

    /// Degrees of freedom of every frame of the input.
    pub fn rows(&self) -> Vec<PoseRow> {
        Stream::new(self.model(), &self.input).collect()
    }

    /// Pose of a row of the database above the origin, heading along +Z.
    ///
    /// # Errors
    /// If the row does not exist.
    pub fn row_pose(&self, row: usize) -> Result<Pose, LensError> {
        let catalogue = self.model().catalogue();
        let row = among("row", row, catalogue.frames())?;
        Ok(catalogue.chart.decode(&catalogue.rows().get(row), Placement::default()))
    }

    /// Class with the largest weight; `None` if no class has neighbours.
    pub fn heaviest_class(&self) -> Option<usize> {
        self.stylizer.inside().mixture.heaviest_classes().first().copied()
    }

    /// Pose of a changed query.
    pub fn query_pose(&self, change: &QueryChange) -> Pose {
        let pose = self.input[self.frame];
        change.applied(&pose, pose.root)
    }

    /// Window of the last `length` frames, changed.
    fn changed_window(&self, length: usize, change: &QueryChange) -> QueryWindow {
        let catalogue = self.model().catalogue();
        let mut window = QueryWindow::new(length);
        let mut heading = HeadingFilter::default();
        let frames = &self.input[(self.frame + 1).saturating_sub(length)..=self.frame];
        let about = self.input[self.frame].root;
        for i in 0..frames.len() {
            let pose = &frames[if change.reversed { frames.len() - 1 - i } else { i }];
            let pose = change.applied(pose, about);
            window.follow(&pose, &catalogue.proportions, catalogue.rate_hz, &mut heading);
        }
        window
    }

    /// Every class of the database.
    pub fn classes(&mut self) -> Vec<ClassDistance> {
        let Self { stylizer, scratch, .. } = self;
        let model = stylizer.model();
        let index = model.index();
        let query = index.prepare(stylizer.inside().window, Metric::FullBody);
        let mut found = Neighbours::default();
        let weights = stylizer.trace().class_weights;
        let distance = |(class, &weight): (usize, &f32)| {
            let k = class_k(stylizer.options(), index.windows_in_class(class));
            found.begin(0);
            index.nearest(&query, &[class], k, scratch, &mut found);
            ClassDistance { weight, mean_square: found.mean_distance() }
        };
        weights.iter().enumerate().map(distance).collect()
    }

    /// The `k` windows of `length` frames in a class that are nearest to the changed query, nearest first; fewer if the
    /// class has fewer.
    ///
    /// # Errors
    /// If the class does not exist.
    pub fn neighbours(
        &self,
        class: usize,
        k: usize,
        length: usize,
        change: &QueryChange,
    ) -> Result<Vec<WeightedNeighbour>, LensError> {
        let classes = self.model().catalogue().classes();
        let k = k.min(classes[among("class", class, classes.len())?].rows.len());
        let mut nearest = Neighbours::with_capacity(k);
        nearest.begin(k);
        self.for_each_window(class, length, change, |window| nearest.offer(window))?;
        let mut weights = Vec::new();
        if self.stylizer.options().coherence {
            taper(nearest.as_slice(), &mut weights);
        } else {
            weights.resize(nearest.as_slice().len(), 1.0);
        }
        let weighted =
            |(n, &weight): (&Neighbour, &f32)| WeightedNeighbour { row: n.row as usize, square: n.distance, weight };
        Ok(nearest.as_slice().iter().zip(&weights).map(weighted).collect())
    }

    /// D between the changed query and the window of `length` frames that ends at each row of a class, m²; NaN at rows
    /// where no window ends.
    ///
    /// # Errors
    /// If the class does not exist.
    pub fn profile(&self, class: usize, length: usize, change: &QueryChange) -> Result<Vec<f32>, LensError> {
        let classes = self.model().catalogue().classes();
        let rows = classes[among("class", class, classes.len())?].rows.clone();
        let mut squares = vec![f32::NAN; rows.len()];
        self.for_each_window(class, length, change, |window| {
            squares[window.row as usize - rows.start] = window.distance;
        })?;
        Ok(squares)
    }

    /// Visits every window of `length` frames of a class with its distance from the changed query.
    fn for_each_window(
        &self,
        class: usize,
        length: usize,
        change: &QueryChange,
        visit: impl FnMut(Neighbour),
    ) -> Result<(), LensError> {
        let class = among("class", class, self.model().catalogue().classes().len())?;
        let profile =
            self.profiles[length.clamp(1, MAX_WINDOW) - 1].get_or_init(|| Profile::new(self.model().index(), length));
        let window;
        // Uses the stylizer's own window if nothing is changed, so that the distances are bit-identical to the stylizer's.
        let own = *change == QueryChange::default() && profile.window_length() == self.model().index().window_length();
        let query = if own {
            self.stylizer.inside().window
        } else {
            window = self.changed_window(profile.window_length(), change);
            &window
        };
        profile.distances(query, class).for_each(visit);
        Ok(())
    }
}

/// Rows of a stream of poses, computed as in a stylizer, each with the window that ends at it.
struct Stream<'a> {
    model: &'a Model,
    poses: std::slice::Iter<'a, Pose>,
    heading: HeadingFilter,
    window: QueryWindow,
    before: Option<Placement>,
}

impl<'a> Stream<'a> {
    fn new(model: &'a Model, poses: &'a [Pose]) -> Self {
        let window = QueryWindow::new(model.index().window_length());
        Self { model, poses: poses.iter(), heading: HeadingFilter::default(), window, before: None }
    }
}

impl Iterator for Stream<'_> {
    type Item = PoseRow;

    fn next(&mut self) -> Option<PoseRow> {
        let pose = self.poses.next()?;
        let catalogue = self.model.catalogue();
        let at = self.window.follow(pose, &catalogue.proportions, catalogue.rate_hz, &mut self.heading);
        let row = catalogue.chart.encode(pose, at.heading, self.before, 1.0 / catalogue.rate_hz);
        self.before = Some(at);
        Some(row)
    }
}

#[cfg(test)]
mod tests;
