//! The window metric: Eq. 1 of Xia et al. 2015 in the closed form of `docs/methods/search.md` §1.
//!
//! A window is a point cloud: the joints of s successive frames ([`WINDOW`]) in a common frame of reference, so that
//! travel within the window counts. Two windows are compared after the best rigid motion of one over the ground plane:
//! a turn θ about the vertical and a shift (x₀, z₀).
//!
//! D(p, q) = min over θ, x₀, z₀ of Σ wᵢ |pᵢ − T(θ, x₀, z₀) qᵢ|²
//!
//! With both clouds centred horizontally (weighted centroid), √wᵢ folded in, heights as a real vector y
//! and the ground plane as a complex one z = x + i·z:  D = |y − y'|² + |z|² + |z'|² − 2 |⟨z, z'⟩|.
//! As the weights sum to 1, D is a mean squared distance in m².

use super::lanes::products;
use super::points::{
    FramePoints, GroundRow, HeightRow, LANES, LEG_LANES, LEG_POINTS, POINTS, PointRow, point_roots, point_weights,
};
use crate::humanoid::{JOINTS, Pose, Proportions};
use crate::kinematics::world_from_local;
use crate::math::Vec3;
use crate::math::order::positive;
use crate::pose_vector::{HeadingFilter, Placement, heading_free_positions};

/// Default number of frames of a window (s; at 60 Hz they span 67 ms). The results hardly depend on it from 1 to 15.
pub const WINDOW: usize = 5;
/// Greatest number of frames of a window; only experiments use other values than the default.
pub const MAX_WINDOW: usize = if cfg!(any(test, feature = "long-windows")) { 15 } else { WINDOW };

/// Number of frames of a window: the compile-time constant `S`, for which loops are unrolled, or `frames` if `S` is
/// [`ANY`].
#[inline]
pub(super) const fn frames_of<const S: usize>(frames: usize) -> usize {
    if S == ANY { frames } else { S }
}

/// The length as a constant if only one is possible, otherwise [`ANY`].
pub(super) const LENGTH: usize = if MAX_WINDOW == WINDOW { WINDOW } else { ANY };

/// A length that is known only at run time.
pub(super) const ANY: usize = 0;

/// Metric of windows: the joints that are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Metric {
    /// All joints, weighted by size and visibility: finds poses for the regression.
    FullBody,
    /// Legs only: finds frames with the same foot contacts as the query.
    LowerBody,
}

impl Metric {
    /// Number of points that are compared, starting with the first.
    pub(super) fn points(self) -> usize {
        match self {
            Self::FullBody => POINTS,
            Self::LowerBody => LEG_POINTS,
        }
    }

    /// Share of these points in the weights of the whole body.
    pub(super) fn share(self) -> f32 {
        match self {
            Self::FullBody => 1.0,
            Self::LowerBody => point_weights()[..LEG_POINTS].iter().sum(),
        }
    }
}

/// Sums over the points of one frame, in double precision, from which windows' norms are computed.
#[derive(Clone, Copy, Debug)]
pub(super) struct FrameSums {
    squares: f64,
    /// Sums of √w · x and √w · z.
    x: f64,
    z: f64,
}

impl FrameSums {
    pub(super) fn new(frame: &FramePoints, metric: Metric) -> Self {
        let mut sums = Self { squares: 0.0, x: 0.0, z: 0.0 };
        for (i, root) in point_roots().iter().enumerate().take(metric.points()) {
            let [y, x, z] = frame.get(i).map(f64::from);
            sums.squares += y * y + x * x + z * z;
            sums.x += f64::from(*root) * x;
            sums.z += f64::from(*root) * z;
        }
        sums
    }
}

/// [`CentredWindow::norm`] of the window of these frames, except for rounding: stored windows share their frames' sums.
pub(super) fn window_norm(frames: &[FrameSums], metric: Metric) -> f32 {
    let scale = 1.0 / (frames.len() as f64 * f64::from(metric.share()));
    let sum = |of: fn(&FrameSums) -> f64| scale * frames.iter().map(of).sum::<f64>();
    let (x, z) = (sum(|f| f.x), sum(|f| f.z));
    // 1 except for the weights' rounding, which matters if the centroid is far away.
    let weights: f64 = point_roots()[..metric.points()].iter().map(|w| f64::from(*w) * f64::from(*w)).sum();
    let weights = scale * frames.len() as f64 * weights;
    (sum(|f| f.squares) - (2.0 - weights) * (x * x + z * z)).max(0.0) as f32
}

/// A window's vector in one metric: zero for joints without a weight, centred, and scaled so that its inner product
/// with stored points, which need not be centred, is that of the weighted window vectors.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct CentredWindow {
    pub(super) frames: usize,
    /// Weight of a frame, the factor by which the vector is too large.
    pub(super) scale: f32,
    pub(super) height: [HeightRow; MAX_WINDOW],
    pub(super) ground: [GroundRow; MAX_WINDOW],
    /// |y|² + |z|².
    pub(super) norm: f32,
}

impl CentredWindow {
    /// Creates the vector from the frames of a window. Sums are in double precision, because this is done only once for
    /// a query or a stored window.
    pub(super) fn new(frames: &[FramePoints], metric: Metric) -> Self {
        let (points, share) = (metric.points(), metric.share());
        let roots = point_roots().map(f64::from);
        let scale = 1.0 / (frames.len() as f64 * f64::from(share));
        let (mut cx, mut cz) = (0.0_f64, 0.0_f64);
        for frame in frames {
            for (i, root) in roots.iter().enumerate().take(points) {
                let [_, x, z] = frame.get(i).map(f64::from);
                cx += scale * root * x;
                cz += scale * root * z;
            }
        }
        let mut window = Self { frames: frames.len(), scale: scale as f32, ..Self::default() };
        let mut norm = 0.0_f64;
        for (f, frame) in frames.iter().enumerate() {
            for (i, root) in roots.iter().enumerate().take(points) {
                let [y, x, z] = frame.get(i).map(f64::from);
                let (x, z) = (x - root * cx, z - root * cz);
                norm += scale * (y * y + x * x + z * z);
                let (lane, i) = (i / 4, i % 4);
                window.height[f][lane][i] = (scale * y) as f32;
                window.ground[f][2 * lane][i] = (scale * x) as f32;
                window.ground[f][2 * lane + 1][i] = (scale * z) as f32;
            }
        }
        window.norm = norm as f32;
        window
    }

    /// D by the window's metric to the stored window with these frames and this norm; 0 if D is NaN.
    #[allow(clippy::inline_always)] // see `products`
    #[inline(always)]
    pub(super) fn distance<const S: usize>(&self, metric: Metric, frames: &[PointRow], norm: f32) -> f32 {
        let length = frames_of::<S>(self.frames);
        let (height, ground) = (&self.height[..length], &self.ground[..length]);
        let [heights, real, imaginary] = match metric {
            Metric::FullBody => products::<_, _, _, LANES, LANES>(height, ground, frames),
            Metric::LowerBody => products::<_, _, _, LEG_LANES, LANES>(height, ground, frames),
        };
        let turned = (real * real + imaginary * imaginary).sqrt();
        positive((self.norm + norm) - 2.0 * (heights + turned))
    }
}

/// Last s frames of a moving figure, prepared for comparison with stored windows.
///
/// While fewer frames have been pushed, the missing earlier ones are extrapolated at constant velocity (a single frame
/// counts as standing still).
#[derive(Clone, Debug)]
pub struct QueryWindow {
    length: usize,
    clouds: [[Vec3; JOINTS]; MAX_WINDOW],
    places: [Placement; MAX_WINDOW],
    pushed: usize,
    full: CentredWindow,
    lower: CentredWindow,
}

impl Default for QueryWindow {
    /// A window of [`WINDOW`] frames.
    fn default() -> Self {
        Self::new(WINDOW)
    }
}

impl QueryWindow {
    /// An empty window of `length` frames, clamped to 1 to [`MAX_WINDOW`].
    pub fn new(length: usize) -> Self {
        Self {
            length: length.clamp(1, MAX_WINDOW),
            clouds: [[Vec3::ZERO; JOINTS]; MAX_WINDOW],
            places: [Placement::default(); MAX_WINDOW],
            pushed: 0,
            full: CentredWindow::default(),
            lower: CentredWindow::default(),
        }
    }

    /// Discards all frames.
    pub fn clear(&mut self) {
        self.pushed = 0;
    }

    /// Number of frames pushed since the window was empty.
    pub fn frames(&self) -> usize {
        self.pushed
    }

    /// Adds a frame: its heading-free point cloud (metres) and its placement on the ground.
    pub fn push(&mut self, cloud: &[Vec3; JOINTS], at: Placement) {
        let length = frames_of::<LENGTH>(self.length);
        let (clouds, places) = (&mut self.clouds[..length], &mut self.places[..length]);
        clouds.rotate_left(1);
        places.rotate_left(1);
        clouds[length - 1] = *cloud;
        places[length - 1] = at;
        self.pushed = self.pushed.saturating_add(1);

        let frames = self.frame_points();
        self.full = CentredWindow::new(&frames[..length], Metric::FullBody);
        self.lower = CentredWindow::new(&frames[..length], Metric::LowerBody);
    }

    /// Points of the frames; the missing ones are extrapolated.
    pub(super) fn frame_points(&self) -> [FramePoints; MAX_WINDOW] {
        let length = frames_of::<LENGTH>(self.length);
        let (clouds, places) = (&self.clouds[..length], &self.places[..length]);
        // Positions relative to the newest hips keep the numbers small, wherever the figure is.
        let at = places[length - 1];
        let mut frames = [FramePoints::default(); MAX_WINDOW];
        for (points, (cloud, p)) in frames.iter_mut().zip(clouds.iter().zip(places)) {
            *points = FramePoints::new(cloud, Placement { x: p.x - at.x, z: p.z - at.z, heading: p.heading });
        }
        let first = length.saturating_sub(self.pushed);
        let next = (first + 1).min(length - 1);
        for missing in 0..first {
            frames[missing] = frames[first].extrapolated_back(&frames[next], (first - missing) as f32);
        }
        frames
    }

    /// Adds a pose of this body, and returns its placement; `heading` is the state of a stream at `rate_hz` frames per
    /// second.
    pub fn follow(&mut self, pose: &Pose, body: &Proportions, rate_hz: f32, heading: &mut HeadingFilter) -> Placement {
        let world = world_from_local(body, pose);
        let heading = heading.update(&world, 1.0 / rate_hz);
        let at = Placement { x: pose.root.x, z: pose.root.z, heading };
        self.push(&heading_free_positions(&world, heading), at);
        at
    }

    /// The window's vector in a metric.
    pub(super) fn centred(&self, metric: Metric) -> &CentredWindow {
        match metric {
            Metric::FullBody => &self.full,
            Metric::LowerBody => &self.lower,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::float_funcs::{double, sin_cos};
    use crate::search::points::JOINT_WEIGHTS;
    use proptest::prelude::*;
    use std::f32::consts::PI;

    type Frames = Vec<([Vec3; JOINTS], Placement)>;

    fn frames() -> impl Strategy<Value = Frames> {
        let point = prop::array::uniform3(-1.0f32..1.0).prop_map(Vec3::from_array);
        let cloud = prop::collection::vec(point, JOINTS).prop_map(|v| std::array::from_fn(|j| v[j]));
        let at = (-2.0f32..2.0, -2.0f32..2.0, -PI..PI).prop_map(|(x, z, heading)| Placement { x, z, heading });
        prop::collection::vec((cloud, at), WINDOW)
    }

    fn distance(metric: Metric, query: &Frames, stored: &Frames) -> f32 {
        let mut window = QueryWindow::default();
        for (cloud, at) in query {
            window.push(cloud, *at);
        }
        let points: [FramePoints; WINDOW] = std::array::from_fn(|i| FramePoints::new(&stored[i].0, stored[i].1));
        window.centred(metric).distance::<WINDOW>(
            metric,
            &points.map(|p| p.0),
            CentredWindow::new(&points, metric).norm,
        )
    }

    fn moved(frames: &Frames, by: Placement) -> Frames {
        let (sin, cos) = sin_cos(by.heading);
        frames
            .iter()
            .map(|(cloud, p)| {
                let x = by.x + cos * p.x + sin * p.z;
                let z = by.z - sin * p.x + cos * p.z;
                (*cloud, Placement { x, z, heading: p.heading + by.heading })
            })
            .collect()
    }

    /// Σ w |p − T q|² for the best shift at a given turn, directly from Eq. 1.
    fn eq1_at_turn(p: &Frames, q: &Frames, turn: f64) -> f64 {
        let (sin, cos) = double::sin_cos(turn);
        let world = |(cloud, at): &([Vec3; JOINTS], Placement), j: usize| {
            let (s, c) = double::sin_cos(at.heading.into());
            let [x, y, z] = cloud[j].to_array().map(f64::from);
            [f64::from(at.x) + c * x + s * z, y, f64::from(at.z) - s * x + c * z]
        };
        let mut differences = Vec::new();
        for (p, q) in p.iter().zip(q) {
            for (w, (role, _)) in point_weights().iter().zip(&JOINT_WEIGHTS) {
                let (a, b) = (world(p, role.index()), world(q, role.index()));
                let b = [cos * b[0] + sin * b[2], b[1], -sin * b[0] + cos * b[2]];
                differences.push((f64::from(*w) / WINDOW as f64, [a[0] - b[0], a[1] - b[1], a[2] - b[2]]));
            }
        }
        let mean = |i: usize| differences.iter().map(|(w, d)| w * d[i]).sum::<f64>();
        let (x0, z0) = (mean(0), mean(2));
        differences.iter().map(|(w, d)| w * ((d[0] - x0) * (d[0] - x0) + d[1] * d[1] + (d[2] - z0) * (d[2] - z0))).sum()
    }

    proptest! {
        #[test]
        fn distance_does_not_change_with_a_motion_over_the_ground(
            p in frames(), q in frames(), x in -9.0f32..9.0, z in -9.0f32..9.0, heading in -PI..PI,
        ) {
            let by = Placement { x, z, heading };
            for metric in [Metric::FullBody, Metric::LowerBody] {
                let d = distance(metric, &p, &q);
                let stored_moved = distance(metric, &p, &moved(&q, by));
                let query_moved = distance(metric, &moved(&p, by), &q);
                prop_assert!((stored_moved - d).abs() < 2e-4 * (1.0 + d));
                prop_assert!((query_moved - d).abs() < 2e-4 * (1.0 + d));
            }
        }

        #[test]
        fn distance_is_the_least_over_turns_and_shifts(p in frames(), q in frames()) {
            let d = f64::from(distance(Metric::FullBody, &p, &q));
            let steps = 3600;
            let least = (0..steps)
                .map(|i| eq1_at_turn(&p, &q, f64::from(i) * std::f64::consts::TAU / f64::from(steps)))
                .fold(f64::INFINITY, f64::min);
            prop_assert!((d - least).abs() < 1e-4 * (1.0 + least), "{d} {least}");
        }
    }

    #[test]
    fn a_window_is_at_distance_zero_from_itself_and_short_ones_are_extrapolated() {
        let cloud = std::array::from_fn(|j| Vec3::new(0.1 * j as f32, 1.0 - 0.05 * j as f32, 0.02 * j as f32));
        let walk: Frames =
            (0..WINDOW).map(|i| (cloud, Placement { x: 0.0, z: 0.02 * i as f32, heading: 0.3 })).collect();
        assert!(distance(Metric::FullBody, &walk, &walk) < 1e-6);
        assert!(distance(Metric::FullBody, &walk[3..].to_vec(), &walk) < 1e-6);
    }
}
