//! Messages ↔ frames: which messages belong together.

use super::bone::{BONES, Bone};
use super::message::Message;
use super::place::{Place, RootPlace};
use strut_core::humanoid::Role;

/// A frame without a time ends when nothing more of it has come for so long, seconds.
const SILENCE_SECS: f64 = 0.004;
/// A bone that is not sent for so long returns to rest, seconds …
const HELD_SECS: f64 = 1.0;
/// … and takes so long for it, seconds.
const RETURN_SECS: f64 = 0.2;

/// A frame of a performer.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frame {
    /// Where the model stands.
    pub root: RootPlace,
    /// Each bone relative to its parent by [`Bone::index`]; `None` if it was never sent.
    pub bones: [Option<Place>; BONES],
    /// Bones that this frame did not bring: they are as they were last sent.
    pub held: [bool; BONES],
    /// How far each bone is at rest, 0–1: one that is not sent any more is held where it was, and returns after a while.
    pub rest_shares: [f32; BONES],
    /// The sender's time, seconds, if it is sent.
    pub sent_secs: Option<f64>,
    /// When its last message arrived, seconds.
    pub arrived_secs: f64,
}

impl Frame {
    /// Each bone in the world; a bone that is not sent is where its parent is.
    pub fn world(&self) -> [Place; BONES] {
        let mut world = [self.root.place; BONES];
        for bone in Bone::all() {
            let parent = bone.parent().map_or(self.root.place, |parent| world[parent.index()]);
            world[bone.index()] = self.bones[bone.index()].map_or(parent, |place| parent.then(&place));
        }
        world
    }

    /// The messages of the frame, without its time.
    pub fn messages(&self) -> impl Iterator<Item = Message> {
        let bones = Bone::all().filter_map(|bone| Some(Message::Bone(bone, self.bones[bone.index()]?)));
        std::iter::once(Message::Root(self.root)).chain(bones)
    }
}

/// Puts messages together to frames. A time ends a frame, as do the hips of the next one and, where the frame before did not
/// end with its time, a moment of silence.
///
/// A frame that lacks a bone which the frame before had is dropped: a packet of it was lost, or it is the first of which
/// only the end was heard.
#[derive(Clone, Debug, Default)]
pub struct FrameReader {
    frame: Frame,
    /// Bones of the frame that goes on, and of the one before.
    has: u32,
    had: Option<u32>,
    /// When each bone last came, seconds.
    heard_secs: [f64; BONES],
    /// Where the model stands in the next frame, if that came before this one ended.
    next_root: Option<RootPlace>,
    /// A time that came before the bones of its frame, or after it had ended.
    time: Option<f64>,
    /// Whether the last frame ended with its time.
    ended_with_time: bool,
    paused: bool,
    partial: u64,
}

impl FrameReader {
    /// Takes a message; gives the frame that ends with it.
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
                // It comes before the bones of its frame.
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

    /// When the frame that goes on ends if nothing more comes, seconds.
    fn ends_secs(&self) -> Option<f64> {
        (self.has != 0 && !self.ended_with_time).then_some(self.frame.arrived_secs + SILENCE_SECS)
    }

    /// The frame that has ended by now in silence.
    pub fn silence(&mut self, now_secs: f64) -> Option<Frame> {
        if self.ends_secs().is_some_and(|end| now_secs >= end) { self.end(false) } else { None }
    }

    /// Frames dropped because they were not whole.
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

    /// The frame that ends, if it is whole.
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
            // Of the first frame nobody knows whether it is.
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
