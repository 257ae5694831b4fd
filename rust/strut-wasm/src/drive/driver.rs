//! Handle of a driver.

use crate::common::{EngineError, write_floats};
use crate::drive::clips::Clips;
use js_sys::Float32Array;
use std::sync::Arc;
use strut_core::driving::{self, Control, DrivenFrame, DrivingClips, Move};
use strut_core::humanoid::{POSE_FLOATS, Pose};
use strut_core::math::{Vec2, Vec3};
use strut_core::pose_vector::Placement;
use strut_core::stream::{LiveFigure, Place};
use wasm_bindgen::prelude::wasm_bindgen;

/// Number of predicted instants in a frame.
const AHEAD: usize = 3;

/// Number of floats of a frame: the pose; the pose with footplant, for display; the root's x, z and heading; the
/// requested root after 1/3, 2/3 and 1 s; the root of the present clip at these instants; ground speed, row, clip,
/// contacts (left, right), whether the row was reached by a transition, the present action (its number from 1, or 0),
/// and how far the pose may be styled.
pub const FRAME: usize = 2 * POSE_FLOATS + 3 + 6 * AHEAD + 8;

/// Neutral motion that follows the controls. For each frame at the clips' rate call [`Driver::next`], then
/// [`Driver::read`].
#[wasm_bindgen]
pub struct Driver {
    clips: Arc<DrivingClips>,
    inner: driving::Driver,
    /// The driven motion with footplant, pulled back to the driven root.
    ghost: LiveFigure,
    frame: Box<[f32; FRAME]>,
}

#[wasm_bindgen]
impl Driver {
    /// Creates a driver that stands at the origin and faces +Z.
    ///
    /// # Errors
    /// If there is too little locomotion in the clips.
    #[wasm_bindgen(constructor)]
    pub fn new(clips: &Clips) -> Result<Self, EngineError> {
        let clips = Arc::new(clips.driving()?);
        let inner = driving::Driver::new(Arc::clone(&clips));
        let ghost = ghost_of(&clips);
        Ok(Self { clips, inner, ghost, frame: Box::new([0.0; FRAME]) })
    }

    /// Returns the speeds of walking and of running, m/s.
    pub fn speeds(&self) -> Vec<f32> {
        self.inner.speeds().to_vec()
    }

    /// Returns the number of candidate rows, mirror images included.
    pub fn rows(&self) -> usize {
        self.clips.rows()
    }

    /// Returns the name of the source clip of each candidate clip.
    pub fn names(&self) -> Vec<String> {
        self.clips.clips().iter().map(|clip| self.clips.name(clip).into()).collect()
    }

    /// Returns 1 for each candidate clip in which left and right are swapped, otherwise 0.
    pub fn mirrored(&self) -> Vec<u8> {
        self.clips.clips().iter().map(|clip| u8::from(clip.mirrored)).collect()
    }

    /// Returns the names of the available actions.
    pub fn moves(&self) -> Vec<String> {
        self.inner.moves().map(|of| of.name().into()).collect()
    }

    /// Restarts at a place, without a path.
    pub fn reset(&mut self, x: f32, z: f32, heading: f32) {
        self.inner.reset(Placement { x, z, heading });
        self.ghost = ghost_of(&self.clips);
    }

    /// Makes the character follow a line through points, x and z each. Fewer than two distinct points end it. A point
    /// that is not finite changes nothing.
    #[wasm_bindgen(js_name = setPath)]
    pub fn set_path(&mut self, points: &[f32]) {
        if points.iter().all(|number| number.is_finite()) {
            let points: Vec<Vec2> = points.as_chunks::<2>().0.iter().map(|&[x, z]| Vec2::new(x, z)).collect();
            self.inner.set_path(&points);
        }
    }

    /// Returns the distance along the path, metres; `None` without a path.
    pub fn progress(&self) -> Option<f32> {
        self.inner.progress()
    }

    /// Returns whether the end of the path is reached, or there is no path.
    #[wasm_bindgen(js_name = hasArrived)]
    pub fn has_arrived(&self) -> bool {
        self.inner.has_arrived()
    }

    /// Advances by one frame with these controls: the desired velocity on the ground, the gait (0 stands, 1 walks, 2
    /// runs), the heading to face, the number of an action, and the position of the styled character's hips in the last
    /// frame. Values that are not finite are ignored.
    #[allow(clippy::too_many_arguments)] // One call instead of an object that both sides would have to define.
    pub fn next(
        &mut self,
        wish_x: f32,
        wish_z: f32,
        gait: f32,
        face: Option<f32>,
        action: Option<u8>,
        styled_x: Option<f32>,
        styled_z: Option<f32>,
    ) {
        let action = action.and_then(|number| Move::ALL.get(usize::from(number)).copied());
        let control = Control { wish: Vec2::new(wish_x, wish_z), gait, face, action };
        let styled = styled_x.zip(styled_z).map(|(x, z)| Vec3::new(x, 0.0, z));
        let frame = self.inner.next(&control, styled);
        let planted = self.ghost.next(&frame.pose, frame.contacts.map(f32::from), &frame.pose, false);
        write(&self.clips, frame, &planted, &mut self.frame);
    }

    /// Writes the [`FRAME`] numbers of the present frame.
    ///
    /// # Errors
    /// If the array has another length.
    pub fn read(&self, into: &Float32Array) -> Result<(), EngineError> {
        write_floats(&*self.frame, into)
    }
}

impl Driver {
    /// Returns the numbers of the present frame.
    pub fn frame(&self) -> &[f32; FRAME] {
        &self.frame
    }
}

fn ghost_of(clips: &DrivingClips) -> LiveFigure {
    LiveFigure::new(&clips.proportions, clips.rate_hz, Place::Follow, true)
}

fn write(clips: &DrivingClips, frame: &DrivenFrame, planted: &Pose, out: &mut [f32; FRAME]) {
    let Some((pose, rest)) = out.split_first_chunk_mut::<POSE_FLOATS>() else { return };
    frame.pose.write_to(pose);
    let Some((pose, rest)) = rest.split_first_chunk_mut::<POSE_FLOATS>() else { return };
    planted.write_to(pose);
    let place = |&(place, heading): &(Vec2, f32)| [place.x, place.y, heading];
    let Placement { x, z, heading } = frame.root;
    let clip = clips.clip_of(frame.row);
    let [left, right] = frame.contacts.map(|planted| f32::from(u8::from(planted)));
    let last = [frame.speed, frame.row as f32, clip as f32, left, right, f32::from(u8::from(frame.switched))];
    let action =
        Move::ALL.iter().zip(1_u8..).find(|(of, _)| Some(**of) == frame.action).map_or(0, |(_, number)| number);
    let numbers = [x, z, heading]
        .into_iter()
        .chain(frame.asked.iter().flat_map(place))
        .chain(frame.ahead.iter().flat_map(place))
        .chain(last)
        .chain([f32::from(action), frame.style_share]);
    for (out, number) in rest.iter_mut().zip(numbers) {
        *out = number;
    }
}
