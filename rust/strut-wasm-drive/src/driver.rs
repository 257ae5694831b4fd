//! Handle of a driver.

use crate::clips::Clips;
use js_sys::Float32Array;
use std::sync::Arc;
use strut_core::driving::{self, Control, DrivenFrame, DrivingClips, Move};
use strut_core::humanoid::{POSE_FLOATS, Pose};
use strut_core::math::{Vec2, Vec3};
use strut_core::pose_vector::Placement;
use strut_core::stream::{LiveFigure, Place};
use strut_wasm_common::{EngineError, write_floats};
use wasm_bindgen::prelude::wasm_bindgen;

/// Instants ahead that a frame names.
const AHEAD: usize = 3;

/// Numbers of a frame: the pose; the same with its feet planted, to be shown; the root's x, z and heading; the same of where it is asked to be after 1/3, 2/3 and 1 s; the
/// same of where the clip that plays would take it; speed over the ground, row, clip, contacts (left, right), whether another
/// row than the next one was taken, the move that plays (its number from 1 on, or 0), and how far the pose may be styled.
pub const FRAME: usize = 2 * POSE_FLOATS + 3 + 6 * AHEAD + 8;

/// Neutral motion that goes where it is asked to. For every frame of the clips' rate [`Driver::next`], then [`Driver::read`].
#[wasm_bindgen]
pub struct Driver {
    clips: Arc<DrivingClips>,
    inner: driving::Driver,
    /// What is driven with its feet planted, drawn back to where it is driven.
    ghost: LiveFigure,
    frame: Box<[f32; FRAME]>,
}

#[wasm_bindgen]
impl Driver {
    /// Stands at the origin towards +Z.
    ///
    /// # Errors
    /// If there is too little locomotion among the clips.
    #[wasm_bindgen(constructor)]
    pub fn new(clips: &Clips) -> Result<Self, EngineError> {
        let clips = Arc::new(clips.driving()?);
        let inner = driving::Driver::new(Arc::clone(&clips));
        let ghost = ghost_of(&clips);
        Ok(Self { clips, inner, ghost, frame: Box::new([0.0; FRAME]) })
    }

    /// Speeds of walking and of running, m/s.
    pub fn speeds(&self) -> Vec<f32> {
        self.inner.speeds().to_vec()
    }

    /// Rows to choose from, mirror images included.
    pub fn rows(&self) -> usize {
        self.clips.rows()
    }

    /// For each clip to choose from the name of the clip that it was made of.
    pub fn names(&self) -> Vec<String> {
        self.clips.clips().iter().map(|clip| self.clips.name(clip).into()).collect()
    }

    /// For each clip to choose from 1 where left and right are swapped.
    pub fn mirrored(&self) -> Vec<u8> {
        self.clips.clips().iter().map(|clip| u8::from(clip.mirrored)).collect()
    }

    /// Names of the moves that can be asked for.
    pub fn moves(&self) -> Vec<String> {
        self.inner.moves().map(|of| of.name().into()).collect()
    }

    /// Begins anew at a place, without a path.
    pub fn reset(&mut self, x: f32, z: f32, heading: f32) {
        self.inner.reset(Placement { x, z, heading });
        self.ghost = ghost_of(&self.clips);
    }

    /// Has the character follow a line through points, x and z each; fewer than two distinct ones end it. Points of which a
    /// number is not finite change nothing.
    #[wasm_bindgen(js_name = setPath)]
    pub fn set_path(&mut self, points: &[f32]) {
        if points.iter().all(|number| number.is_finite()) {
            let points: Vec<Vec2> = points.as_chunks::<2>().0.iter().map(|&[x, z]| Vec2::new(x, z)).collect();
            self.inner.set_path(&points);
        }
    }

    /// How far along its path the character is, metres; none where it has no path.
    pub fn progress(&self) -> Option<f32> {
        self.inner.progress()
    }

    /// Whether the path's end is reached; also where there is none.
    #[wasm_bindgen(js_name = hasArrived)]
    pub fn has_arrived(&self) -> bool {
        self.inner.has_arrived()
    }

    /// Goes on by a frame: the wish over the ground, the gait (0 stands, 1 walks, 2 runs), the heading to face, the number of a
    /// move, and where the hips of the styled character were in the last frame. What is not finite is ignored.
    #[allow(clippy::too_many_arguments)] // One call instead of an object that both sides would have to spell out.
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
    /// The present frame.
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
