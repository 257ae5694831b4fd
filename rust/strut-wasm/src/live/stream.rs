//! Handle of a live stream.

use crate::common::{EngineError, proportions_of, write_floats};
use crate::live::sender::{Sender, pose_of};
use js_sys::Float32Array;
use strut_core::humanoid::{POSE_FLOATS, Pose, Proportions};
use strut_core::stream::{Arrival, Delay, JitterBuffer, LiveFigure, LiveFloor, Place, Play, Played};
use wasm_bindgen::prelude::wasm_bindgen;

/// A performer's frames as they arrive, and the figure that is displayed. For each frame at the database's rate call
/// [`Stream::advance`]; the engine styles its pose, and [`Stream::show`] then sets the displayed pose. Times are
/// seconds.
#[wasm_bindgen]
pub struct Stream {
    body: Proportions,
    sender: Sender,
    floor: LiveFloor,
    buffer: JitterBuffer,
    figure: LiveFigure,
    played: Option<Played>,
    shown: Pose,
    refused: u32,
}

#[wasm_bindgen]
impl Stream {
    /// Creates a stream of poses on the body of a database (21 × xyz, metres), displayed at its rate. `delay_secs` is
    /// the delay of frames; without it the delay follows the jitter. `follows` sets whether the figure is pulled to the
    /// performer's position.
    ///
    /// # Errors
    /// If the offsets are not 63 numbers.
    #[wasm_bindgen(constructor)]
    pub fn new(proportions: &[f32], rate_hz: f32, delay_secs: Option<f64>, follows: bool) -> Result<Self, EngineError> {
        let body = proportions_of(proportions)?;
        let place = if follows { Place::Follow } else { Place::Free };
        Ok(Self {
            sender: Sender::Poses,
            floor: LiveFloor::new(&body),
            buffer: JitterBuffer::new(delay_secs.map_or(Delay::Auto, Delay::Fixed)),
            figure: LiveFigure::new(&body, rate_hz, place, true),
            body,
            played: None,
            shown: Pose::default(),
            refused: 0,
        })
    }

    /// Sets the format of frames to poses on the body of the database: 87 numbers.
    #[wasm_bindgen(js_name = takePoses)]
    pub fn take_poses(&mut self) {
        self.sender = Sender::Poses;
    }

    /// Sets the format of frames to a skeleton: the position of joint 0, then the local rotation xyzw of every joint.
    ///
    /// `parents`: index of each joint's parent, which precedes it; −1 for joint 0. `offsets`: from the parent, xyz, in
    /// the pose in which all rotations are the identity. Without `metres_per_unit` the unit follows from the size of
    /// the body.
    ///
    /// # Errors
    /// If the numbers are no valid skeleton, or the skeleton is not a body; the former skeleton is then kept.
    #[wasm_bindgen(js_name = takeJoints)]
    pub fn take_joints(
        &mut self,
        names: Vec<String>,
        parents: &[i32],
        offsets: &[f32],
        metres_per_unit: Option<f32>,
    ) -> Result<(), EngineError> {
        self.sender = Sender::of_joints(names, parents, offsets, metres_per_unit, &self.body)?;
        self.floor = LiveFloor::new(&self.body);
        Ok(())
    }

    /// Sets the format of frames to the channels of a BVH file with this header.
    ///
    /// # Errors
    /// If it is no BVH header; the former skeleton is then kept.
    #[wasm_bindgen(js_name = takeBvh)]
    pub fn take_bvh(&mut self, header: &str) -> Result<(), EngineError> {
        self.sender = Sender::of_bvh(header)?;
        self.floor = LiveFloor::new(&self.body);
        Ok(())
    }

    /// Sets the format of frames to landmarks of a camera image, 33 × (x, y, z, visibility), mirrored or not.
    #[wasm_bindgen(js_name = takeLandmarks)]
    pub fn take_landmarks(&mut self, mirrored: bool) {
        self.sender = Sender::of_camera(mirrored, &self.body);
    }

    /// Returns the number of floats per frame.
    #[wasm_bindgen(js_name = frameFloats)]
    pub fn frame_floats(&self) -> usize {
        self.sender.floats()
    }

    /// Adds a frame with its sending time, on any clock, and its arrival time. Returns whether it is used. Invalid
    /// poses are counted and have no effect.
    ///
    /// # Errors
    /// If the first frame of a BVH file shows that the skeleton is not a body.
    pub fn push(&mut self, sent_secs: f64, arrived_secs: f64, numbers: &[f32]) -> Result<bool, EngineError> {
        let Some(mut pose) = self.sender.pose(sent_secs, numbers, &self.body)? else {
            self.refused += 1;
            return Ok(false);
        };
        if let Some(has_root) = self.sender.has_root() {
            pose.root.y -= self.floor.under(&pose, sent_secs, has_root);
        }
        Ok(self.buffer.push(sent_secs, arrived_secs, &pose) != Arrival::Dropped)
    }

    /// Advances to a time, one frame at the database's rate after the last. Returns the source of the performer's pose:
    /// 0 none yet, 1 interpolated frames, 2 short extrapolation, 3 the last frame, held, 4 none: the performer is lost.
    pub fn advance(&mut self, now_secs: f64) -> u8 {
        self.played = self.buffer.at(now_secs);
        self.played.map_or(0, |played| match played.play {
            Play::Interpolated => 1,
            Play::Extrapolated => 2,
            Play::Held => 3,
            Play::Lost => 4,
        })
    }

    /// Returns whether the present frame does not continue the one before. The engine's stream must then be reset.
    pub fn begins(&self) -> bool {
        self.played.is_some_and(|played| played.begins)
    }

    /// Returns the earliest time at which the present frame could have been displayed; NaN without a frame.
    #[wasm_bindgen(js_name = dueSecs)]
    pub fn due_secs(&self) -> f64 {
        self.played.map_or(f64::NAN, |played| played.due_secs)
    }

    /// Writes the performer's pose.
    ///
    /// # Errors
    /// If the array has another length than a pose.
    pub fn performer(&self, into: &Float32Array) -> Result<(), EngineError> {
        let mut floats = [0.0; POSE_FLOATS];
        self.played.map_or(Pose::default(), |played| played.pose).write_to(&mut floats);
        write_floats(&floats, into)
    }

    /// Sets whether planted feet are held in place from the next frame on.
    #[wasm_bindgen(js_name = holdFeet)]
    pub fn hold_feet(&mut self, holds: bool) {
        self.figure.hold_feet(holds);
    }

    /// Computes the displayed pose from a styled pose, its foot contacts and the performer's pose. Call it in the order
    /// of the frames; `begins` is the value of [`Stream::begins`] of that frame.
    ///
    /// # Errors
    /// If the arrays are not valid poses.
    pub fn show(
        &mut self,
        styled: &[f32],
        left: bool,
        right: bool,
        performer: &[f32],
        begins: bool,
    ) -> Result<(), EngineError> {
        let pose = |floats: &[f32]| floats.try_into().ok().and_then(pose_of);
        let (Some(styled), Some(performer)) = (pose(styled), pose(performer)) else {
            return Err(EngineError::bad_input(format!("a pose of {POSE_FLOATS} finite numbers was expected")));
        };
        let contact = [left, right].map(|planted| f32::from(u8::from(planted)));
        self.shown = self.figure.next(&styled, contact, &performer, begins);
        Ok(())
    }

    /// Writes the displayed pose.
    ///
    /// # Errors
    /// If the array has another length than a pose.
    pub fn shown(&self, into: &Float32Array) -> Result<(), EngineError> {
        let mut floats = [0.0; POSE_FLOATS];
        self.shown.write_to(&mut floats);
        write_floats(&floats, into)
    }

    /// Returns which feet are held in place, left and right.
    pub fn planted(&self) -> Vec<u8> {
        self.figure.planted().map(u8::from).to_vec()
    }

    /// Returns statistics of the stream: delay and frame period, seconds; numbers of frames that were taken, late,
    /// dropped and missing; number of losses; number of invalid frames.
    pub fn stats(&self) -> Vec<f64> {
        let stats = self.buffer.stats();
        let counts = [stats.taken, stats.late, stats.dropped, stats.missing, stats.losses, self.refused.into()];
        [self.buffer.delay_secs(), self.buffer.period_secs()].into_iter().chain(counts.map(|n| n as f64)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use strut_core::humanoid::{HumanoidMotion, JOINTS};
    use strut_core::math::{Quat, Vec3};
    use strut_formats::bvh::{self, Bvh};

    const RATE_HZ: f32 = 60.0;

    fn stream() -> Stream {
        let body = crate::common::offsets_of(&Proportions::default());
        Stream::new(&body, RATE_HZ, Some(0.02), true).unwrap()
    }

    /// Returns a pose on the ground with the hips at x and the left upper arm turned.
    fn pose(x: f32) -> Pose {
        let mut pose = Pose { root: Vec3::new(x, Proportions::default().offsets[0].y, 0.0), ..Pose::default() };
        pose.rotations[6] = Quat::from_rotation_y(0.4);
        pose
    }

    fn floats(pose: &Pose) -> [f32; POSE_FLOATS] {
        let mut floats = [0.0; POSE_FLOATS];
        pose.write_to(&mut floats);
        floats
    }

    /// Returns the performer's pose after frames of a tenth of a second.
    fn performed(stream: &mut Stream, frames: &[Vec<f32>]) -> Pose {
        for (i, frame) in frames.iter().enumerate() {
            let secs = i as f64 * 0.1;
            assert!(stream.push(secs, secs, frame).unwrap(), "frame {i}");
        }
        assert_eq!(stream.advance((frames.len() - 1) as f64 * 0.1 + 0.02), 1);
        stream.played.unwrap().pose
    }

    #[test]
    fn poses_are_played_as_they_were_sent() {
        let mut stream = stream();
        let frames: Vec<Vec<f32>> = [0.0, 0.5, 1.0].map(|x| floats(&pose(x)).to_vec()).into();
        let played = performed(&mut stream, &frames);
        assert!(played.root.distance(pose(1.0).root) < 1e-6, "{played:?}");
    }

    #[test]
    fn a_bvh_file_and_its_joints_give_the_pose_that_was_written() {
        let motion = HumanoidMotion {
            proportions: Proportions::default(),
            rate_hz: RATE_HZ,
            poses: [0.0, 0.5, 1.0].map(pose).into(),
        };
        let file = Bvh::from_humanoid(&motion).unwrap();
        let text = bvh::write_text(&file);
        let rows: Vec<Vec<f32>> = (0..3).map(|f| file.row(f).iter().map(|v| *v as f32).collect()).collect();
        let mut by_channels = stream();
        by_channels.take_bvh(&text[..text.find("Frame Time").unwrap()]).unwrap();
        assert_eq!(by_channels.frame_floats(), rows[0].len());
        let channels = performed(&mut by_channels, &rows);

        let skeleton = file.to_motion().unwrap();
        let joints = skeleton.skeleton.joints();
        let names = joints.iter().map(|j| j.name.clone()).collect();
        let parents: Vec<i32> = joints.iter().map(|j| j.parent.map_or(-1, |p| p as i32)).collect();
        let offsets: Vec<f32> = joints.iter().flat_map(|j| j.offset.to_array()).collect();
        let mut by_joints = stream();
        by_joints.take_joints(names, &parents, &offsets, None).unwrap();
        let frames: Vec<Vec<f32>> = (0..3)
            .map(|f| {
                let rotations = skeleton.rotations_at(f).iter().flat_map(|q| q.to_array());
                skeleton.translations_at(f)[0].to_array().into_iter().chain(rotations).collect()
            })
            .collect();
        let turns = performed(&mut by_joints, &frames);
        for (name, found) in [("channels", channels), ("joints", turns)] {
            let expected = pose(1.0);
            // The height of the hips above the soles is estimated from the ankles.
            assert!((found.root - expected.root).abs().max_element() < 0.02, "{name}: {found:?}");
            assert!((found.root.x - expected.root.x).abs() < 1e-3, "{name}: {found:?}");
            for j in 0..JOINTS {
                let angle = found.rotations[j].inv_mul(expected.rotations[j]).angle().to_degrees();
                assert!(angle < 0.1, "{name}: joint {j} is off by {angle}°");
            }
        }
    }

    #[test]
    fn what_is_no_pose_is_counted_and_has_no_effect() {
        let mut stream = stream();
        assert!(stream.push(0.0, 0.0, &floats(&pose(0.0))).unwrap());
        for (at, value) in [(0, f32::NAN), (1, f32::INFINITY), (2, 1e8), (6, 9.0), (6, 0.1)] {
            let mut numbers = floats(&pose(0.0));
            numbers[at] = value;
            assert!(!stream.push(0.1, 0.1, &numbers).unwrap(), "{at}: {value}");
        }
        assert!(!stream.push(0.1, 0.1, &[0.0; 5]).unwrap());
        assert!(!stream.push(f64::NAN, 0.1, &floats(&pose(0.0))).unwrap());
        assert_eq!(stream.stats()[2..], [1.0, 0.0, 1.0, 0.0, 0.0, 6.0]);
    }

    #[test]
    fn a_skeleton_that_is_none_leaves_the_one_before() {
        let mut stream = stream();
        let names = |count: usize| (0..count).map(|i| format!("joint {i}")).collect::<Vec<_>>();
        assert!(stream.take_joints(names(2), &[-1, 0], &[0.0; 5], None).is_err());
        assert!(stream.take_joints(names(2), &[-1, 0], &[0.0; 6], Some(f32::NAN)).is_err());
        assert!(stream.take_joints(names(2), &[-1, 0], &[0.0; 6], Some(1.0)).is_err());
        assert!(stream.take_joints(names(2), &[1, 0], &[0.0; 6], None).is_err());
        assert!(stream.take_bvh("HIERARCHY\nROOT hips {").is_err());
        assert_eq!(stream.frame_floats(), POSE_FLOATS);
    }

    #[test]
    fn a_mirrored_picture_exchanges_left_and_right() {
        let performed = |mirrored: bool| {
            let mut stream = stream();
            stream.take_landmarks(mirrored);
            // The line of hips and shoulders, the left arm up.
            let mut points = vec![0.0; stream.frame_floats()];
            let at = |i: usize, x: f32, y: f32| [(4 * i, x), (4 * i + 1, y), (4 * i + 3, 1.0)];
            let body = [(11, 0.2, -0.5), (12, -0.2, -0.5), (23, 0.1, 0.0), (24, -0.1, 0.0)];
            let arm = [(13, 0.2, -0.8), (15, 0.2, -1.1)];
            for (i, value) in body.iter().chain(&arm).flat_map(|&(i, x, y)| at(i, x, y)) {
                points[i] = value;
            }
            performed(&mut stream, &[points.clone(), points])
        };
        let (seen, mirrored) = (performed(false), performed(true));
        assert!(seen.rotations[6].angle() > 1.0 && seen.rotations[10].angle() < 0.1, "{seen:?}");
        assert_eq!(mirrored, seen.mirrored());
    }

    #[test]
    fn what_is_shown_goes_on_where_it_was_when_the_stream_begins_anew() {
        let mut stream = stream();
        let show = |stream: &mut Stream, x: f32, begins: bool| {
            let numbers = floats(&pose(x));
            stream.show(&numbers, false, false, &numbers, begins).unwrap();
            stream.shown.root.x
        };
        show(&mut stream, 0.0, true);
        let before = show(&mut stream, 0.0, false);
        assert!((show(&mut stream, 5.0, true) - before).abs() < 0.01);
        assert!(stream.show(&[0.0; 3], false, false, &[0.0; 3], false).is_err());
    }
}
