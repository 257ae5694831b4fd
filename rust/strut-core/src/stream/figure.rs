//! The styled figure of a stream: the transition after a loss, the place relative to the performer, and foot planting.

use super::place::{Follower, Place};
use crate::driving::{Inertia, Moving};
use crate::humanoid::{Pose, Proportions};
use crate::kinematics::world_from_local;
use crate::math::{Quat, Vec2, Vec3};
use crate::pose_vector::heading_of;
use crate::transfer::Footplant;

/// Post-processing after the styling, wherever that runs. The output is continuous when the stream restarts.
#[derive(Clone, Debug)]
pub struct LiveFigure {
    proportions: Proportions,
    rate_hz: f32,
    place: Place,
    /// Transform from the stylizer's place of the figure to its place after the last restart.
    moved: Option<Moved>,
    follower: Follower,
    footplant: Option<Footplant>,
    planted: [bool; 2],
    /// Displacement of the root by the footplant.
    root_shift: Vec2,
    seam: Inertia,
    /// The last two output poses.
    shown: Option<[Pose; 2]>,
}

/// A rotation about the vertical through a place, then a translation to another.
#[derive(Clone, Copy, Debug)]
struct Moved {
    from: Vec3,
    turn: Quat,
    to: Vec3,
}

impl LiveFigure {
    /// Creates a figure for a body and a frame rate; `holds_feet` sets whether planted feet are held in place.
    pub fn new(proportions: &Proportions, rate_hz: f32, place: Place, holds_feet: bool) -> Self {
        Self {
            proportions: *proportions,
            rate_hz,
            place,
            moved: None,
            follower: Follower::default(),
            footplant: holds_feet.then(|| Footplant::new(*proportions)),
            planted: [false; 2],
            root_shift: Vec2::ZERO,
            seam: Inertia::default(),
            shown: None,
        }
    }

    /// Sets whether planted feet are held in place from the next frame on.
    pub fn hold_feet(&mut self, holds: bool) {
        if holds != self.footplant.is_some() {
            self.footplant = holds.then(|| Footplant::new(self.proportions));
            self.planted = [false; 2];
            self.root_shift = Vec2::ZERO;
        }
    }

    /// Which feet are held in place.
    pub fn planted(&self) -> [bool; 2] {
        self.planted
    }

    /// Returns the output pose of the next frame, `1 / rate_hz` after the last, from the styled pose, the likelihoods that
    /// its feet are planted, and the performer's pose. If the frame `begins` a stream, the stylizer was reset, and the figure
    /// continues from its present place.
    pub fn next(&mut self, styled: &Pose, contact: [f32; 2], performer: &Pose, begins: bool) -> Pose {
        let dt_secs = 1.0 / self.rate_hz;
        let before = self.shown.filter(|_| begins);
        if let Some([_, last]) = &before {
            self.go_on_from(last, styled);
        }
        let styled = self.moved.map_or(*styled, |moved| moved.applied(styled));
        match before {
            Some([earlier, last]) => {
                let from = Moving { pose: last, ..Moving::between(&earlier, &last, self.rate_hz) };
                self.seam.go_on(&from, &Moving::between(&styled, &styled, self.rate_hz));
            }
            None => self.seam.advance(dt_secs),
        }
        let mut shown = self.seam.shown(&styled);
        if self.place == Place::Follow {
            let [steps, performer] = [&shown, performer].map(|pose| Vec2::new(pose.root.x, pose.root.z));
            let seen = steps + self.follower.shift() + self.root_shift;
            let swings = !(self.planted[0] && self.planted[1]);
            let shift = self.follower.next(steps, seen, performer, swings, dt_secs);
            shown.root.x += shift.x;
            shown.root.z += shift.y;
        }
        if let Some(footplant) = &mut self.footplant {
            let unplanted = shown.root;
            self.planted = footplant.apply(&mut shown, contact, dt_secs);
            self.root_shift = Vec2::new(shown.root.x - unplanted.x, shown.root.z - unplanted.z);
        }
        self.shown = Some([self.shown.map_or(shown, |[_, last]| last), shown]);
        shown
    }

    /// Restarts with a styled pose at the place of the last output pose.
    fn go_on_from(&mut self, last: &Pose, styled: &Pose) {
        let heading = |pose: &Pose| heading_of(&world_from_local(&self.proportions, pose)).unwrap_or(0.0);
        let turn = Quat::from_rotation_y(heading(last) - heading(styled));
        let ground = |pose: &Pose| Vec3::new(pose.root.x, 0.0, pose.root.z);
        self.moved = Some(Moved { from: ground(styled), turn, to: ground(last) });
        self.follower = Follower::default();
        if let Some(footplant) = &mut self.footplant {
            footplant.reset();
        }
        self.planted = [false; 2];
        self.root_shift = Vec2::ZERO;
        self.seam = Inertia::default();
    }
}

impl Moved {
    fn applied(&self, pose: &Pose) -> Pose {
        let mut moved = Pose { root: self.turn * (pose.root - self.from) + self.to, ..*pose };
        moved.rotations[0] = (self.turn * pose.rotations[0]).normalized();
        moved
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{NEUTRAL, RATE_HZ, walk};

    fn figure(place: Place) -> LiveFigure {
        LiveFigure::new(&Proportions::default(), RATE_HZ, place, false)
    }

    #[test]
    fn a_styled_pose_is_shown_as_it_is_while_the_stream_is_whole() {
        let mut figure = figure(Place::Free);
        for pose in &walk(&NEUTRAL, 60, 0.0).poses {
            assert_eq!(figure.next(pose, [1.0; 2], pose, false), *pose);
        }
    }

    #[test]
    fn after_a_seam_the_way_leads_on_in_the_direction_that_the_figure_had() {
        let poses = walk(&NEUTRAL, 180, 0.0).poses;
        // The same walk from another place, to the left of its previous direction.
        let turn = Quat::from_rotation_y(1.3);
        let turned = |pose: &Pose| {
            let mut out = Pose { root: turn * pose.root + Vec3::new(4.0, 0.0, 2.0), ..*pose };
            out.rotations[0] = turn * pose.rotations[0];
            out
        };
        let mut figure = figure(Place::Free);
        let mut shown = Pose::default();
        for pose in &poses {
            shown = figure.next(pose, [0.0; 2], pose, false);
        }
        let (seam, straight) = (shown.root, poses[179].root - poses[0].root);
        for (i, pose) in poses.iter().map(turned).enumerate() {
            shown = figure.next(&pose, [0.0; 2], &pose, i == 0);
        }
        let way = shown.root - seam;
        let across = way.x * straight.z - way.z * straight.x;
        assert!(across.abs() < 0.1 * straight.length() * way.length(), "{way:?} {straight:?}");
        assert!((way.length() - straight.length()).abs() < 0.1 * straight.length(), "{way:?} {straight:?}");
    }
}
