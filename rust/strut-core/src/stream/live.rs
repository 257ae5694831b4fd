//! Styling of a stream: the stylizer and the figure that it drives.

use super::figure::LiveFigure;
use super::place::Place;
use crate::humanoid::Pose;
use crate::transfer::{Options, OptionsError, StyleError, Stylizer};

/// Styles the frames of a [`super::JitterBuffer`] at the database's rate. The output is continuous when the stream restarts.
#[derive(Clone, Debug)]
pub struct LiveStylizer {
    /// Its footplant is off; the figure plants the feet after the correction of its place.
    stylizer: Stylizer,
    figure: LiveFigure,
}

impl LiveStylizer {
    /// Uses the model, the styles and the options of a stylizer, except for its timing: output frames have the duration of
    /// input frames, as both are live.
    ///
    /// # Errors
    /// See [`Stylizer::set_options`].
    pub fn new(mut stylizer: Stylizer, place: Place) -> Result<Self, OptionsError> {
        let options = *stylizer.options();
        stylizer.set_options(Options { timing: false, footplant: false, ..options })?;
        stylizer.reset(None);
        let catalogue = stylizer.model().catalogue();
        let figure = LiveFigure::new(&catalogue.proportions, catalogue.rate_hz, place, options.footplant);
        Ok(Self { stylizer, figure })
    }

    /// Sets the styles of the whole body.
    ///
    /// # Errors
    /// See [`Stylizer::set_styles`].
    pub fn set_styles(&mut self, weights: &[f32]) -> Result<(), StyleError> {
        self.stylizer.set_styles(weights)
    }

    /// Sets the share of the style in the output: see [`Stylizer::set_style_share`].
    pub fn set_style_share(&mut self, share: f32) {
        self.stylizer.set_style_share(share);
    }

    /// Which feet are held in place.
    pub fn planted(&self) -> [bool; 2] {
        self.figure.planted()
    }

    /// Styles the performer's next pose, on the database's proportions and one frame of its rate after the last. A pose that
    /// `begins` a stream is discontinuous with those before: the figure continues from its present place.
    pub fn push(&mut self, pose: &Pose, begins: bool) -> Pose {
        if begins {
            self.stylizer.reset(None);
        }
        let frame = self.stylizer.push(pose);
        self.figure.next(&frame.pose, frame.contact_out, pose, begins)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{BENT, Gait, NEUTRAL, RATE_HZ, database, walk};
    use crate::math::Vec3;
    use crate::metrics::foot_skate;
    use crate::transfer::Model;
    use std::sync::Arc;

    fn live(options: Options, weights: [f32; 2], place: Place) -> LiveStylizer {
        let mut stylizer = Stylizer::new(Arc::new(Model::new(database())), options).unwrap();
        stylizer.set_styles(&weights).unwrap();
        LiveStylizer::new(stylizer, place).unwrap()
    }

    /// Largest difference of two poses: metres, and degrees of any joint.
    fn difference(a: &Pose, b: &Pose) -> (f32, f32) {
        let turns = a.rotations.iter().zip(&b.rotations).map(|(a, b)| a.inv_mul(*b).angle().to_degrees());
        (a.root.distance(b.root), turns.fold(0.0, f32::max))
    }

    #[test]
    fn with_no_share_of_the_style_the_output_is_the_input() {
        let mut live = live(Options { footplant: false, ..Options::DEFAULT }, [1.0, 0.0], Place::Follow);
        live.set_style_share(0.0);
        let gait = Gait { turn: 0.3, ..NEUTRAL };
        let (mut metres, mut degrees) = (0.0_f32, 0.0_f32);
        for pose in &walk(&gait, 1200, 0.0).poses {
            let (m, d) = difference(&live.push(pose, false), pose);
            metres = metres.max(m);
            degrees = degrees.max(d);
        }
        assert!(metres < 5e-4 && degrees < 0.1, "{metres} m, {degrees}°");
    }

    #[test]
    fn a_style_with_shorter_strides_stays_with_the_performer() {
        let poses = walk(&NEUTRAL, 900, 0.0).poses;
        let run = |place| {
            let mut live = live(Options::DEFAULT, [0.0, 1.0], place);
            let mut out: Vec<Pose> = poses.iter().map(|pose| live.push(pose, false)).collect();
            (out.pop().unwrap().root.distance(poses[899].root), out)
        };
        let ((followed, poses_out), (free, _)) = (run(Place::Follow), run(Place::Free));
        assert!(followed < 0.75 * free, "{followed} {free} m");
        let motion =
            crate::humanoid::HumanoidMotion { proportions: database().proportions, rate_hz: RATE_HZ, poses: poses_out };
        let skate = foot_skate(&motion, &crate::contact::label(&motion));
        assert!(skate < 0.02, "{skate} m/s");
    }

    #[test]
    fn the_figure_goes_on_where_it_was_when_the_performer_is_back_elsewhere() {
        let mut live = live(Options::DEFAULT, [0.0, 1.0], Place::Follow);
        let fastest = |a: &Pose, b: &Pose| {
            let (metres, degrees) = difference(a, b);
            (metres * RATE_HZ, degrees * RATE_HZ)
        };
        let mut last: Option<Pose> = None;
        let mut unbroken = (0.0_f32, 0.0_f32);
        for pose in &walk(&NEUTRAL, 200, 0.0).poses {
            let shown = live.push(pose, false);
            if let Some(before) = last.replace(shown) {
                let (m, d) = fastest(&before, &shown);
                unbroken = (unbroken.0.max(m), unbroken.1.max(d));
            }
        }
        for (i, pose) in walk(&BENT, 120, 0.4).poses.iter().enumerate() {
            let elsewhere = Pose { root: pose.root + Vec3::new(2.0, 0.0, -1.0), ..*pose };
            let shown = live.push(&elsewhere, i == 0);
            let (m, d) = fastest(&last.replace(shown).unwrap(), &shown);
            assert!(m < unbroken.0 + 0.5 && d < 2.0 * unbroken.1, "frame {i}: {m} m/s, {d}°/s; before {unbroken:?}");
        }
    }
}
