//! Conversion between messages and frames: groups the messages of a frame.

use super::bone::{BONES, Bone};
use super::message::Message;
use super::place::{Place, RootPlace};
use strut_core::humanoid::Role;

/// A frame without a time ends after this time without messages, seconds.
const SILENCE_SECS: f64 = 0.004;
/// A bone that has not been sent for this time returns to its rest rotation, seconds …
const HELD_SECS: f64 = 1.0;
/// … within this time, seconds.
const RETURN_SECS: f64 = 0.2;

/// A frame of a sender.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frame {
    /// Position of the model.
    pub root: RootPlace,
    /// Each bone relative to its parent, by [`Bone::index`]; `None` if it was never sent.
    pub bones: [Option<Place>; BONES],
    /// Bones that are missing in this frame; they keep their last transform.
    pub held: [bool; BONES],
    /// Interpolation factor from each bone's last transform to rest, 0–1. A bone that is no longer sent is held and
    /// then returns to rest.
    pub rest_shares: [f32; BONES],
    /// The sender's time, seconds, if it was sent.
    pub sent_secs: Option<f64>,
    /// Arrival time of the last message, seconds.
    pub arrived_secs: f64,
}

impl Frame {
    /// World transform of each bone. A bone that is not sent has its parent's transform.
    pub fn world(&self) -> [Place; BONES] {
        let mut world = [self.root.place; BONES];
        for bone in Bone::all() {
            let parent = bone.parent().map_or(self.root.place, |parent| world[parent.index()]);
            world[bone.index()] = self.bones[bone.index()].map_or(parent, |place| parent.compose(&place));
        }
        world
    }

    /// Messages of the frame, without its time.
    pub fn messages(&self) -> impl Iterator<Item = Message> {
        let bones = Bone::all().filter_map(|bone| Some(Message::Bone(bone, self.bones[bone.index()]?)));
        std::iter::once(Message::Root(self.root)).chain(bones)
    }
}

/// Groups messages into frames. A frame ends with its time, with the hips of the next one or, if the previous frame did
/// not end with its time, after a short silence.
///
/// A frame without a bone that the previous frame had is dropped: one of its packets was lost, or it is the first
/// frame, of which only the end was received.
#[derive(Clone, Debug, Default)]
pub struct FrameReader {
    frame: Frame,
    /// Bones received for the current frame (a bit each), and for the previous one.
    has: u32,
    had: Option<u32>,
    /// Time at which each bone was last received, seconds.
    heard_secs: [f64; BONES],
    /// Position of the model in the next frame, if it was received before this frame ended.
    next_root: Option<RootPlace>,
    /// A time that was received before the bones of its frame, or after the frame ended.
    time: Option<f64>,
    /// Whether the last frame ended with its time.
    ended_with_time: bool,
    paused: bool,
    partial: u64,
}

impl FrameReader {
    /// Processes a message. Returns the frame that ends with it.
    pub fn push(&mut self, message: &Message, arrived_secs: f64) -> Option<Frame> {
        match message {
            Message::Bone(bone, place) => {
                let is_next = *bone == Bone::Of(Role::Hips) && self.has & bit(*bone) != 0;
                let ended = if is_next { self.end(false) } else { None };
                self.frame.bones[bone.index()] = Some(*place);
                self.has |= bit(*bone);
                self.heard_secs[bone.index()] = arrived_secs;
                self.frame.arrived_secs = arrived_secs;
                ended
            }
            Message::Root(root) => {
                // The root is sent before the bones of its frame.
                if self.has == 0 || self.ended_with_time {
                    self.frame.root = *root;
                } else {
                    self.next_root = Some(*root);
                }
                None
            }
            Message::Time(secs) => {
                self.time = Some(*secs);
                if self.has == 0 { None } else { self.end(true) }
            }
            Message::Loaded(loaded) => {
                self.paused = !loaded;
                None
            }
            Message::Style(..) | Message::Other(_) => None,
        }
    }

    /// Time at which the current frame ends if no more messages arrive, seconds.
    fn ends_secs(&self) -> Option<f64> {
        (self.has != 0 && !self.ended_with_time).then_some(self.frame.arrived_secs + SILENCE_SECS)
    }

    /// Returns the current frame if it has ended by silence.
    pub fn silence(&mut self, now_secs: f64) -> Option<Frame> {
        if self.ends_secs().is_some_and(|end| now_secs >= end) { self.end(false) } else { None }
    }

    /// Number of frames dropped because they were incomplete.
    pub fn partial(&self) -> u64 {
        self.partial
    }

    fn end(&mut self, with_time: bool) -> Option<Frame> {
        let ended = self.whole(with_time);
        if let Some(root) = self.next_root.take() {
            self.frame.root = root;
        }
        ended
    }

    /// Ends the frame, and returns it if it is complete.
    fn whole(&mut self, with_time: bool) -> Option<Frame> {
        self.ended_with_time = with_time;
        let has = std::mem::take(&mut self.has);
        let had = self.had.replace(has);
        let sent_secs = self.time.take();
        if self.paused {
            return None;
        }
        let is_whole = had.is_some_and(|had| had & !has == 0) && has & bit(Bone::Of(Role::Hips)) != 0;
        if !is_whole {
            // Whether the first frame is complete cannot be known.
            self.partial += u64::from(had.is_some());
            return None;
        }
        let rest_shares = self.heard_secs.map(|heard_secs| {
            let returning_secs = self.frame.arrived_secs - heard_secs - HELD_SECS;
            (returning_secs / RETURN_SECS).clamp(0.0, 1.0) as f32
        });
        let held = std::array::from_fn(|i| self.frame.bones[i].is_some() && has & (1 << i) == 0);
        Some(Frame { held, rest_shares, sent_secs, ..self.frame })
    }
}

fn bit(bone: Bone) -> u32 {
    1 << bone.index()
}
