//! Mixture of autoregressive models of one frame: neighbours → classes → styles (Eq. 2–7).

use super::bias::Bias;
use super::class_weights::{class_weights, greatest_distance, known};
use super::coherence::{ComplementaryFilter, half_life_secs, taper};
use super::found::FoundFrame;
use super::input::Input;
use super::model::Model;
use super::options::{Method, Options};
use super::output::Predicted;
use super::phase_lock::{PhaseEstimate, PhaseLock};
use super::regression::{Gathered, InputMoments, Prediction, Regressors, Samples, interpolate, predict};
use super::timing::{Moment, duration};
use super::trained::{Trained, Training};
use crate::catalogue::{ExampleRows, TargetTable};
use crate::math::float_funcs::half_life_share;
use crate::math::order::sort_pairs;
use crate::pose_vector::{PoseRow, ROW};
use crate::search::{Metric, Neighbour, Neighbours, QueryWindow, Scratch};
use std::sync::Arc;

/// A term of the mixture: one class, or for other methods than MAR all allowed classes together.
#[derive(Clone, Debug)]
struct Component {
    classes: Vec<usize>,
    k: usize,
    neighbours: Neighbours,
    /// Weight of each neighbour in regressions and durations.
    neighbour_weights: Vec<f32>,
}

impl Component {
    fn weigh_neighbours(&mut self, coherent: bool) {
        if coherent {
            taper(self.neighbours.as_slice(), &mut self.neighbour_weights);
        } else {
            self.neighbour_weights.clear();
            self.neighbour_weights.resize(self.neighbours.as_slice().len(), 1.0);
        }
    }
}

/// Prediction of one target style.
#[derive(Clone, Debug)]
pub(super) struct StylePrediction {
    /// Index of the style.
    pub(super) style: usize,
    /// Whether `previous` holds the last frame's output.
    pub(super) started: bool,
    /// yₜ₋₁.
    pub(super) previous: PoseRow,
    /// Of this frame.
    pub(super) now: Predicted,
    /// Expected difference of yₜ from yₜ₋₁.
    filter: ComplementaryFilter,
    /// Targets of the style.
    table: Arc<TargetTable>,
    /// Trained predictor; `None` for methods without training.
    trained: Option<Trained>,
}

impl StylePrediction {
    /// Row that a trained method predicts; `None` for methods without training.
    fn trained_row(&mut self, model: &Model, input: Input<'_>, neighbours: &[Neighbour]) -> Option<PoseRow> {
        let trained = self.trained.as_mut()?;
        if self.started {
            return Some(trained.predict(input, &self.previous));
        }
        trained.start(model, neighbours.first().map(|n| n.row as usize));
        let start = interpolate(|row| self.table.pose(row - 1), neighbours);
        Some(trained.predict(input, &start))
    }
}

/// Mixture of one stream of frames: working memory and latest results.
#[derive(Clone, Debug)]
pub(super) struct Mixture {
    components: Vec<Component>,
    distances: Vec<f32>,
    /// Components in the order of their search, each with its expected distance.
    order: Vec<(f32, usize)>,
    weights: Vec<f32>,
    class_weights: Vec<f32>,
    active_classes: Vec<usize>,
    /// Rows of a class's neighbours, and their targets in a style.
    inputs: Gathered,
    targets: Gathered,
    /// Squared distances of the neighbours' inputs and outputs.
    timing_distances: [Vec<f32>; 2],
    phase_lock: PhaseLock,
    scratch: Scratch,
    /// Largest |Δx| of the heaviest class, in σ.
    pub(super) bias: f32,
}

impl Mixture {
    /// Creates the mixture for the classes that `options` allow; `None` if there are none.
    pub(super) fn new(model: &Model, options: &Options) -> Option<Self> {
        let classes: Vec<usize> = model
            .catalogue()
            .classes()
            .iter()
            .enumerate()
            .filter(|(_, c)| options.action.is_none_or(|a| a == c.action))
            .filter(|(_, c)| options.input_style.is_none_or(|s| s == c.style))
            .map(|(i, _)| i)
            .collect();
        let component = |classes: Vec<usize>| {
            let windows = classes.iter().map(|&c| model.index().windows_in_class(c)).sum();
            Component {
                classes,
                k: class_k(options, windows),
                neighbours: Neighbours::with_capacity(options.k),
                neighbour_weights: Vec::with_capacity(options.k),
            }
        };
        let components: Vec<Component> = match options.method {
            _ if classes.is_empty() => return None,
            Method::Mar => classes.into_iter().map(|c| component(vec![c])).collect(),
            _ => vec![component(classes)],
        };
        Some(Self {
            distances: vec![f32::INFINITY; components.len()],
            order: Vec::with_capacity(components.len()),
            weights: vec![0.0; components.len()],
            class_weights: vec![0.0; model.catalogue().classes().len()],
            active_classes: Vec::with_capacity(model.catalogue().classes().len()),
            inputs: Gathered::with_capacity(options.k),
            targets: Gathered::with_capacity(options.k),
            timing_distances: [(); 2].map(|()| Vec::with_capacity(options.k)),
            phase_lock: PhaseLock::default(),
            scratch: model.index().scratch(options.k),
            bias: 0.0,
            components,
        })
    }

    /// Prediction of a style, not started. Creates the style's targets, and trains methods with training.
    pub(super) fn prediction_of(&self, model: &Model, options: &Options, style: usize) -> StylePrediction {
        let classes: Vec<usize> = self.components.iter().flat_map(|c| c.classes.iter().copied()).collect();
        let table = model.target_table(style);
        StylePrediction {
            style,
            started: false,
            previous: [0.0; ROW],
            now: Predicted { row: [0.0; ROW], step_secs: 0.0, contact: [0.0; 2] },
            filter: ComplementaryFilter::NONE,
            trained: options.method.trained().map(|method| {
                let (targets, classes) = (&*table, &*classes);
                Trained::new(method, &Training { model, targets, classes, lambda: options.lambda })
            }),
            table,
        }
    }

    /// Discards the input, before another stream.
    pub(super) fn forget_input(&mut self) {
        self.phase_lock = PhaseLock::default();
    }

    /// Finds the neighbours of the input in every class that can have a weight. The distance of other classes is infinite.
    pub(super) fn search(&mut self, model: &Model, options: &Options, window: &QueryWindow) {
        let index = model.index();
        let query = index.prepare(window, Metric::FullBody);
        if !self.found_any() {
            for (c, d) in self.components.iter().zip(&mut self.distances) {
                *d = c.classes.iter().map(|&class| index.rough_distance(&query, class)).fold(f32::INFINITY, f32::min);
            }
        }
        // The nearest classes of the last frame come first: the sooner a small distance is known, the more classes can
        // be skipped.
        self.order.clear();
        self.order.extend(self.distances.iter().copied().zip(0..));
        sort_pairs(&mut self.order);
        let mut least = f32::INFINITY;
        for &(_, i) in &self.order {
            let (c, d) = (&mut self.components[i], &mut self.distances[i]);
            let out = &mut c.neighbours;
            if let ([class], true) = (&c.classes[..], self.weights[i] == 0.0) {
                let greatest = greatest_distance(least, options.delta, options.least_weight);
                if index.mean_exceeds(&query, *class, c.k, greatest) {
                    out.begin(0);
                    *d = f32::INFINITY;
                    continue;
                }
            }
            index.nearest(&query, &c.classes, c.k, &mut self.scratch, out);
            *d = out.mean_distance();
            least = least.min(*d);
            c.weigh_neighbours(is_coherent(options));
        }
    }

    /// Uses search results found earlier for a frame with these options, in place of [`Mixture::search`].
    pub(super) fn adopt(&mut self, options: &Options, found: &FoundFrame<'_>) {
        self.distances.fill(f32::INFINITY);
        for (i, neighbours) in found.components() {
            if let (Some(c), Some(d)) = (self.components.get_mut(i), self.distances.get_mut(i)) {
                c.neighbours.assign(neighbours);
                *d = c.neighbours.mean_distance();
                c.weigh_neighbours(is_coherent(options));
            }
        }
    }

    /// Index and neighbours of each component that has a weight.
    pub(super) fn weighted_neighbours(&self) -> impl Iterator<Item = (usize, &[Neighbour])> {
        let weighted = (0..self.weights.len()).filter(|&i| self.weights[i] > 0.0);
        weighted.map(|i| (i, self.components[i].neighbours.as_slice()))
    }

    /// Computes the weights of the classes from their distances.
    pub(super) fn weigh(&mut self, model: &Model, options: &Options) {
        class_weights(&self.distances, options.delta, options.least_weight, &mut self.weights);
        self.class_weights.fill(0.0);
        for (component, &weight) in self.components.iter().zip(&self.weights) {
            if weight == 0.0 {
                continue;
            }
            if let [class] = component.classes[..] {
                self.class_weights[class] = weight;
                continue;
            }
            let neighbours = component.neighbours.as_slice();
            for n in neighbours {
                let class = model.catalogue().class_of_row(n.row as usize);
                self.class_weights[class] += weight / neighbours.len() as f32;
            }
        }
        self.active_classes.clear();
        self.active_classes.extend((0..self.class_weights.len()).filter(|&c| self.class_weights[c] > 0.0));
    }

    /// Predicts every style's next row: E(y) = Σ λⱼ uᵀβⱼ.
    pub(super) fn predict(
        &mut self,
        model: &Model,
        options: &Options,
        input: Input<'_>,
        styles: &mut [StylePrediction],
    ) {
        let db = model.catalogue();
        for s in styles.iter_mut() {
            s.now.row = [0.0; ROW];
            s.filter = ComplementaryFilter::of_input(input, options.rho);
        }
        let heaviest = self.heaviest();
        for (i, (component, &weight)) in self.components.iter().zip(&self.weights).enumerate() {
            if weight == 0.0 {
                continue;
            }
            let neighbours = component.neighbours.as_slice();
            let weights = component.neighbour_weights.as_slice();
            let ridge = options.lambda * weights.iter().sum::<f32>();
            let regresses = matches!(options.method, Method::Mar | Method::LocalAr);
            let moments = regresses.then(|| {
                self.inputs.fill(&ExampleRows::Inputs(model.rows()), neighbours, weights);
                InputMoments::new(&self.inputs, weights)
            });
            let bias = match (&moments, options.method) {
                (Some(m), Method::Mar) => {
                    Bias::new(input.current, &m.statistics, db.sigma(), options.kappa, options.rho)
                }
                _ => Bias::NONE,
            };
            if Some(i) == heaviest {
                self.bias = bias.largest;
            }
            for s in styles.iter_mut() {
                let row = if let Some(row) = s.trained_row(model, input, neighbours) {
                    row
                } else if let Some(moments) = &moments {
                    let targets = &*s.table;
                    // A style in its first frame has no previous output; the neighbours' mean is used instead.
                    let start = if s.started {
                        s.previous
                    } else {
                        bias.put_on(interpolate(|row| targets.pose(row - 1), neighbours))
                    };
                    self.targets.fill(&ExampleRows::Targets(targets), neighbours, weights);
                    let samples = Samples { inputs: &self.inputs, targets: &self.targets, weights };
                    let u =
                        Regressors { previous_input: input.previous, input: input.current, previous_output: &start };
                    let Prediction { output, target_step } = predict(u, moments, samples, ridge, db.sigma(), &bias);
                    s.filter.add(weight, options.rho, &moments.input_step(), &target_step);
                    output
                } else {
                    let nearest = if options.method == Method::NearestNeighbour { 1 } else { neighbours.len() };
                    interpolate(|row| s.table.pose(row), &neighbours[..nearest])
                };
                s.now.row.iter_mut().zip(&row).for_each(|(sum, v)| *sum += weight * v);
            }
        }
        if is_coherent(options) && heaviest.is_some() {
            let nearest = self.heaviest_neighbours().first().map_or(f32::INFINITY, |n| n.distance);
            let share = half_life_share(1.0 / db.rate_hz, half_life_secs(nearest));
            for s in styles.iter_mut().filter(|s| s.started) {
                s.filter.correct(&s.previous, share, &mut s.now.row);
            }
        }
    }

    /// Predicts the duration of every style's frame, and which feet are planted in it.
    pub(super) fn predict_durations_and_contacts(
        &mut self,
        model: &Model,
        options: &Options,
        input: Input<'_>,
        styles: &mut [StylePrediction],
    ) {
        let db = model.catalogue();
        let frame_secs = 1.0 / db.rate_hz;
        for s in styles.iter_mut() {
            (s.now.step_secs, s.now.contact) = (0.0, [0.0; 2]);
        }
        let now = Moment { pose: input.current, previous: input.previous };
        let mut seen = PhaseEstimate::default();
        let [of_inputs, of_outputs] = &mut self.timing_distances;
        for (component, &weight) in self.components.iter().zip(&self.weights) {
            if weight == 0.0 {
                continue;
            }
            let neighbours = component.neighbours.as_slice();
            let nearest = if options.method == Method::NearestNeighbour { 1 } else { neighbours.len() };
            let (neighbours, weights) = (&neighbours[..nearest], component.neighbour_weights.as_slice());
            seen.add(db.gait_phase(), weight, neighbours, weights);
            model.scales().squared_distances(now, &ExampleRows::Inputs(model.rows()), neighbours, of_inputs);
            for s in styles.iter_mut() {
                let table = &*s.table;
                let now = Moment { pose: &s.now.row, previous: if s.started { &s.previous } else { &s.now.row } };
                model.scales().squared_distances(now, &ExampleRows::Targets(table), neighbours, of_outputs);
                let secs = duration(of_inputs, of_outputs, neighbours, weights, |row| table.step_secs(row));
                s.now.step_secs += weight * secs.unwrap_or(frame_secs);
                let contact: [f32; 2] = interpolate(|row| table.contact(row), neighbours);
                s.now.contact.iter_mut().zip(contact).for_each(|(sum, c)| *sum += weight * c);
            }
        }
        let least = self.distances.iter().copied().fold(f32::INFINITY, f32::min);
        let pace = self.phase_lock.follow(seen, known(least), options.tempo, frame_secs);
        for s in styles {
            match &s.trained {
                Some(trained) => s.now.step_secs = trained.step_secs(),
                None => s.now.step_secs *= pace,
            }
        }
    }

    /// Nearest windows by the lower-body metric within the active classes.
    pub(super) fn search_contacts(&mut self, model: &Model, window: &QueryWindow, k: usize, out: &mut Neighbours) {
        let query = model.index().prepare(window, Metric::LowerBody);
        model.index().nearest(&query, &self.active_classes, k, &mut self.scratch, out);
    }

    /// Weight of every class of the database.
    pub(super) fn class_weights(&self) -> &[f32] {
        &self.class_weights
    }

    /// Classes of the heaviest component: one for MAR.
    pub(super) fn heaviest_classes(&self) -> &[usize] {
        self.heaviest().map_or(&[], |i| &self.components[i].classes)
    }

    /// Neighbours in the heaviest class.
    pub(super) fn heaviest_neighbours(&self) -> &[Neighbour] {
        self.heaviest().map_or(&[], |i| self.components[i].neighbours.as_slice())
    }

    /// Weight of each of the heaviest class's neighbours in regressions and durations.
    pub(super) fn heaviest_neighbour_weights(&self) -> &[f32] {
        self.heaviest().map_or(&[], |i| self.components[i].neighbour_weights.as_slice())
    }

    /// Returns whether any class has neighbours.
    pub(super) fn found_any(&self) -> bool {
        !self.active_classes.is_empty()
    }

    fn heaviest(&self) -> Option<usize> {
        (0..self.weights.len())
            .filter(|&i| self.weights[i] > 0.0)
            .reduce(|best, i| if self.weights[i] > self.weights[best] { i } else { best })
    }
}

/// Returns whether the measures of [`super::coherence`] apply: only to MAR.
fn is_coherent(options: &Options) -> bool {
    options.coherence && options.method == Method::Mar
}

/// K of a class: at most a quarter of its windows, so that neighbours stay near in small classes.
pub(super) fn class_k(options: &Options, windows: usize) -> usize {
    if windows >= 4 * options.k { options.k } else { options.k.min((windows / 4).max(5)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_classes_take_fewer_neighbours() {
        let options = Options::DEFAULT;
        assert_eq!(class_k(&options, 160), 40);
        assert_eq!(class_k(&options, 100), 25);
        assert_eq!(class_k(&options, 8), 5);
        assert_eq!(class_k(&Options { k: 3, ..options }, 8), 3);
    }
}
