//! A stream from received packets to sent packets, without sockets and clocks: times are arguments.

use super::figures::{Figures, Histogram};
use std::net::SocketAddr;
use std::sync::Arc;
use strut_core::humanoid::{Pose, Proportions};
use strut_core::retarget::BetweenBodies;
use strut_core::stream::{Delay, JitterBuffer, LiveFloor, LiveStylizer, Play};
use strut_core::transfer::Model;
use strut_formats::vmc::{self, Calibration, Frame, FrameReader, Message, Performer};

/// Number of successive frames with the bones of another body after which the avatar counts as changed.
const MOST_OTHERS: u32 = 3;
/// Silence of a performer after which another one is accepted, seconds.
const SILENT_SECS: f64 = 1.0;
/// Greatest number of messages that wait to be passed on; more are dropped.
const MOST_PASSED: usize = 1024;
/// Longest recording, seconds.
const MAX_RECORDED_SECS: f64 = 3600.0;

/// Settings of a session.
pub(super) struct Settings {
    pub(super) delay: Delay,
    pub(super) calibrate_secs: Option<f64>,
    pub(super) records: bool,
}

/// Poses on the database's body, one per tick.
#[derive(Default)]
pub(super) struct Recorded {
    pub(super) styled: Vec<Pose>,
    pub(super) input: Vec<Pose>,
}

/// See the module documentation.
pub(super) struct Session {
    model: Arc<Model>,
    live: LiveStylizer,
    weights: Vec<f32>,
    settings: Settings,
    source: Option<Source>,
    buffer: JitterBuffer,
    /// Messages for the next packets.
    passed: Vec<Message>,
    messages: Vec<Message>,
    recorded: Recorded,
    /// Time at which the last tick's frame could have been displayed.
    due_secs: Option<f64>,
    /// Number of ticks with a performer.
    frames_out: u64,
    now_secs: f64,
    latency: Histogram,
    computing: Histogram,
    packets_refused: u64,
    messages_dropped: u64,
    packets_of_others: u64,
}

/// The active performer.
struct Source {
    address: SocketAddr,
    heard_secs: f64,
    reader: FrameReader,
    /// Whether the performer sends times; then a frame without a time has lost it.
    sends_times: bool,
    calibration: Option<(Calibration, f64)>,
    body: Option<Body>,
}

/// The performer's body, and the conversion between it and the database's.
struct Body {
    performer: Performer,
    /// Conversions to the database's body and back.
    there: BetweenBodies,
    back: BetweenBodies,
    floor: LiveFloor,
    /// Height of the ground under the last frame, metres.
    floor_metres: f32,
    /// Number of successive frames with another body.
    others: u32,
    /// The last frame.
    last: Frame,
}

impl Session {
    /// Creates a session without packets.
    pub(super) fn new(model: Arc<Model>, live: LiveStylizer, weights: Vec<f32>, settings: Settings) -> Self {
        Self {
            model,
            live,
            weights,
            source: None,
            buffer: JitterBuffer::new(settings.delay),
            settings,
            passed: Vec::new(),
            messages: Vec::new(),
            recorded: Recorded::default(),
            due_secs: None,
            frames_out: 0,
            now_secs: 0.0,
            latency: Histogram::default(),
            computing: Histogram::default(),
            packets_refused: 0,
            messages_dropped: 0,
            packets_of_others: 0,
        }
    }

    /// Returns the frame rate, frames per second.
    pub(super) fn rate_hz(&self) -> f32 {
        self.model.catalogue().rate_hz
    }

    /// Returns the database's body.
    pub(super) fn proportions(&self) -> Proportions {
        self.model.catalogue().proportions
    }

    /// Returns the recordings.
    pub(super) fn recorded(&self) -> &Recorded {
        &self.recorded
    }

    /// Processes a packet with its arrival time, seconds. Of two performers the first one is used until it is silent.
    pub(super) fn receive(&mut self, bytes: &[u8], from: SocketAddr, arrived_secs: f64) {
        let is_other = |source: &Source| source.address != from;
        if self.source.as_ref().is_some_and(|s| is_other(s) && arrived_secs - s.heard_secs < SILENT_SECS) {
            self.packets_of_others += 1;
            return;
        }
        let mut messages = std::mem::take(&mut self.messages);
        match vmc::decode(bytes, &mut messages) {
            Ok(dropped) => self.messages_dropped += dropped as u64,
            Err(_) => self.packets_refused += 1,
        }
        if !messages.is_empty() {
            if self.source.as_ref().is_none_or(is_other) {
                self.source = Some(Source::new(from, self.settings.calibrate_secs.is_some()));
            }
            if let Some(source) = &mut self.source {
                source.heard_secs = arrived_secs;
            }
        }
        self.end_in_silence(arrived_secs);
        for message in messages.drain(..) {
            let frame = self.source.as_mut().and_then(|source| source.reader.push(&message, arrived_secs));
            self.take(frame.as_ref());
            match message {
                Message::Style(name, weight) => self.set_style(&name, weight),
                Message::Other(_) if self.passed.len() < MOST_PASSED => self.passed.push(message),
                _ => {}
            }
        }
        self.messages = messages;
    }

    /// Returns the packets to send at a tick, seconds.
    pub(super) fn tick(&mut self, now_secs: f64) -> Vec<Vec<u8>> {
        self.now_secs = now_secs;
        self.end_in_silence(now_secs);
        let mut out = Vec::new();
        let body = self.source.as_ref().and_then(|source| source.body.as_ref());
        let played = self.buffer.at(now_secs).filter(|played| played.play != Play::Lost);
        self.due_secs = None;
        if let (Some(played), Some(body)) = (played, body) {
            let styled = self.live.push(&played.pose, played.begins);
            let mut theirs = body.back.pose(&styled);
            theirs.root.y += body.floor_metres;
            let frame = body.performer.frame(&theirs, &body.last);
            out.extend(frame.messages());
            self.due_secs = Some(played.due_secs);
            self.frames_out += 1;
            if self.settings.records && self.has_room() {
                self.recorded.styled.push(styled);
                self.recorded.input.push(played.pose);
            }
        }
        out.append(&mut self.passed);
        out.extend([Message::Loaded(self.due_secs.is_some()), Message::Time(now_secs)]);
        vmc::encode(&out)
    }

    /// Records when the computation of a tick's packets began and when they were sent, seconds.
    pub(super) fn sent(&mut self, begun_secs: f64, sent_secs: f64) {
        if let Some(due_secs) = self.due_secs {
            self.latency.count(sent_secs - due_secs);
            self.computing.count(sent_secs - begun_secs);
        }
    }

    /// Returns the statistics of the stream.
    pub(super) fn figures(&self) -> Figures {
        let stats = self.buffer.stats();
        let percent = |part: u64, of: u64| 100.0 * part as f64 / of.max(1) as f64;
        let heard_secs = self.frames_out as f64 / f64::from(self.rate_hz());
        Figures {
            secs: self.now_secs,
            frames_in: stats.taken,
            hz: if heard_secs > 0.0 { stats.taken as f64 / heard_secs } else { 0.0 },
            frames_out: self.frames_out,
            late_percent: percent(stats.late, stats.taken),
            lost_percent: percent(stats.missing, stats.taken + stats.missing),
            frames_partial: self.source.as_ref().map_or(0, |source| source.reader.partial()),
            losses: stats.losses,
            packets_refused: self.packets_refused,
            messages_dropped: self.messages_dropped,
            packets_of_others: self.packets_of_others,
            buffer_ms: 1000.0 * self.buffer.delay_secs(),
            latency_ms: self.latency.spread(),
            computing_ms: self.computing.spread(),
        }
    }

    fn has_room(&self) -> bool {
        (self.recorded.styled.len() as f64) < MAX_RECORDED_SECS * f64::from(self.rate_hz())
    }

    fn end_in_silence(&mut self, now_secs: f64) {
        let frame = self.source.as_mut().and_then(|source| source.reader.silence(now_secs));
        self.take(frame.as_ref());
    }

    /// Adds a frame to the buffer, on the database's body.
    fn take(&mut self, frame: Option<&Frame>) {
        let (Some(frame), Some(source)) = (frame, &mut self.source) else { return };
        source.sends_times |= frame.sent_secs.is_some();
        if source.sends_times && frame.sent_secs.is_none() {
            return;
        }
        let Some(body) = source.body_of(frame, self.settings.calibrate_secs, &self.model.catalogue().proportions)
        else {
            return;
        };
        let sent_secs = frame.sent_secs.unwrap_or(frame.arrived_secs);
        let mut pose = body.performer.pose(frame);
        body.floor_metres = body.floor.under(&pose, sent_secs, Performer::has_root(frame));
        pose.root.y -= body.floor_metres;
        body.last = *frame;
        let pose = body.there.pose(&pose);
        self.buffer.push(sent_secs, frame.arrived_secs, &pose);
    }

    fn set_style(&mut self, name: &str, weight: f32) {
        let Some(style) = self.model.catalogue().style_index(name) else {
            self.messages_dropped += 1;
            return;
        };
        let before = std::mem::replace(&mut self.weights[usize::from(style)], weight);
        if before != weight && self.live.set_styles(&self.weights).is_err() {
            self.weights[usize::from(style)] = before;
            self.messages_dropped += 1;
        }
    }
}

impl Source {
    fn new(address: SocketAddr, calibrates: bool) -> Self {
        Self {
            address,
            heard_secs: 0.0,
            reader: FrameReader::default(),
            sends_times: false,
            calibration: calibrates.then(|| (Calibration::default(), f64::INFINITY)),
            body: None,
        }
    }

    /// Returns the body, from the first frame after the calibration on. It is replaced when the avatar changes.
    fn body_of(&mut self, frame: &Frame, calibrate_secs: Option<f64>, of_database: &Proportions) -> Option<&mut Body> {
        if let Some(body) = &mut self.body {
            body.others = if body.performer.has_body_of(frame) { 0 } else { body.others + 1 };
            if body.others >= MOST_OTHERS {
                self.body = None;
            }
        }
        if self.body.is_none() {
            if let Some((calibration, until_secs)) = &mut self.calibration {
                if until_secs.is_infinite() {
                    *until_secs = frame.arrived_secs + calibrate_secs.unwrap_or(0.0);
                }
                if frame.arrived_secs < *until_secs {
                    calibration.push(frame);
                    return None;
                }
            }
            let performer = Performer::new(frame, self.calibration.as_ref().map(|(calibration, _)| calibration));
            let theirs = *performer.proportions();
            let there = BetweenBodies::new(&theirs, of_database);
            let back = BetweenBodies::new(of_database, &theirs);
            let floor = LiveFloor::new(&theirs);
            self.body = Some(Body { performer, there, back, floor, floor_metres: 0.0, others: 0, last: *frame });
        }
        self.body.as_mut()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::OnceLock;
    use strut_core::humanoid::{HumanoidMotion, Role};
    use strut_core::math::{Quat, Vec3};
    use strut_core::stream::Place;
    use strut_core::transfer::{Options, Stylizer};
    use strut_formats::vmc::RootPlace;

    const PERIOD_SECS: f64 = 1.0 / 60.0;
    const LATEST_SECS: f64 = 0.008;

    fn model() -> Arc<Model> {
        static MODEL: OnceLock<Arc<Model>> = OnceLock::new();
        let walks = || strut_demo::walk_database(&strut_demo::database().unwrap()).unwrap();
        Arc::clone(MODEL.get_or_init(|| Arc::new(Model::new(walks()))))
    }

    /// Returns the lateness of a frame: 0, except for every third frame.
    fn lateness_secs(i: usize) -> f64 {
        [0.0, 0.0, LATEST_SECS][i % 3]
    }

    fn session(options: Options, share: f32, records: bool) -> Session {
        let model = model();
        let mut live = LiveStylizer::new(Stylizer::new(Arc::clone(&model), options).unwrap(), Place::Follow).unwrap();
        live.set_style_share(share);
        let weights = vec![0.0; model.catalogue().styles.len()];
        let settings = Settings { delay: Delay::Fixed(PERIOD_SECS + LATEST_SECS), calibrate_secs: None, records };
        Session::new(model, live, weights, settings)
    }

    fn walk() -> HumanoidMotion {
        strut_demo::input_clips().remove(0).motion.resampled(60.0).unwrap()
    }

    fn address(port: u16) -> SocketAddr {
        SocketAddr::from(([127, 0, 0, 1], port))
    }

    fn packets(performer: &Performer, pose: &Pose, like: &Frame, secs: f64) -> Vec<Vec<u8>> {
        let mut messages: Vec<Message> = performer.frame(pose, like).messages().collect();
        messages.extend([Message::Loaded(true), Message::Time(secs)]);
        vmc::encode(&messages)
    }

    /// Returns the frame in packets, if they have one.
    fn frame_of(packets: &[Vec<u8>]) -> Option<Frame> {
        let (mut messages, mut frame) = (Vec::new(), Frame::default());
        for packet in packets {
            vmc::decode(packet, &mut messages).unwrap();
        }
        for message in &messages {
            match message {
                Message::Bone(bone, place) => frame.bones[bone.index()] = Some(*place),
                Message::Root(root) => frame.root = *root,
                _ => {}
            }
        }
        messages.contains(&Message::Loaded(true)).then_some(frame)
    }

    /// Tested through packets, buffer, both bodies and back.
    #[test]
    fn the_neutral_style_without_a_share_gives_the_input() {
        let mut session = session(Options { footplant: false, ..Options::DEFAULT }, 0.0, false);
        let motion = walk();
        let performer = Performer::of_body(&motion.proportions);
        let stands = vmc::Place { position: Vec3::new(0.4, 0.0, -0.2), rotation: Quat::from_rotation_y(0.7) };
        let like = Frame { root: RootPlace { place: stands, scale_and_offset: None }, ..Frame::default() };
        let (mut metres, mut degrees, mut compared) = (0.0_f32, 0.0_f32, 0);
        for (i, pose) in motion.poses.iter().take(600).enumerate() {
            let secs = i as f64 * PERIOD_SECS;
            for packet in packets(&performer, pose, &like, secs) {
                session.receive(&packet, address(1), secs + lateness_secs(i));
            }
            let Some(frame) = frame_of(&session.tick(secs + LATEST_SECS)) else { continue };
            let (out, expected) = (performer.pose(&frame), motion.poses[i - 1]);
            metres = metres.max(out.root.distance(expected.root));
            let turns = out.rotations.iter().zip(&expected.rotations).map(|(a, b)| a.inv_mul(*b).angle().to_degrees());
            degrees = turns.fold(degrees, f32::max);
            compared += 1;
        }
        assert!(compared > 590 && metres < 5e-4 && degrees < 0.1, "{compared} frames: {metres} m, {degrees}°");
    }

    /// Sends frames to a session, and returns the resulting poses on the performer's body.
    fn perform(session: &mut Session, performer: &Performer, poses: &[Pose], from_secs: f64) -> Vec<Pose> {
        let tick = |(i, pose): (usize, &Pose)| {
            let secs = from_secs + i as f64 * PERIOD_SECS;
            for packet in packets(performer, pose, &Frame::default(), secs) {
                session.receive(&packet, address(1), secs);
            }
            frame_of(&session.tick(secs + LATEST_SECS)).map(|frame| performer.pose(&frame))
        };
        poses.iter().enumerate().filter_map(tick).collect()
    }

    #[test]
    fn a_performer_on_another_ground_or_without_a_root_is_styled_as_on_the_ground() {
        let motion = walk();
        let performer = Performer::of_body(&motion.proportions);
        let of = |poses: Vec<Pose>| {
            let mut session = session(Options { footplant: false, ..Options::DEFAULT }, 1.0, false);
            perform(&mut session, &performer, &poses, 0.0)
        };
        let poses = &motion.poses[..300];
        let on_ground = of(poses.to_vec());
        let below = of(poses.iter().map(|pose| Pose { root: pose.root - Vec3::Y * 0.93, ..*pose }).collect());
        let rootless = of(poses.iter().map(|pose| Pose { root: Vec3::ZERO, ..*pose }).collect());
        assert!(on_ground.len() > 290 && below.len() == on_ground.len() && rootless.len() == on_ground.len());
        // After a second the ground is known; the knee shows whether the body crouches.
        let knee = |pose: &Pose| pose.rotations[Role::LeftLowerLeg.index()].angle().to_degrees();
        for (i, clean) in on_ground.iter().enumerate().skip(70) {
            assert!((below[i].root.y + 0.93 - clean.root.y).abs() < 0.03, "{i}: {} {}", below[i].root.y, clean.root.y);
            assert!((knee(&below[i]) - knee(clean)).abs() < 6.0, "{i}: {} {}", knee(&below[i]), knee(clean));
            assert!((knee(&rootless[i]) - knee(clean)).abs() < 25.0, "{i}: {} {}", knee(&rootless[i]), knee(clean));
        }
    }

    #[test]
    fn another_avatar_of_the_same_performer_is_bound_anew() {
        let motion = walk();
        let child = Proportions { offsets: motion.proportions.offsets.map(|offset| offset * 0.7) };
        let mut session = session(Options::DEFAULT, 1.0, false);
        let body_of = |session: &Session| {
            *session.source.as_ref().and_then(|source| source.body.as_ref()).unwrap().performer.proportions()
        };
        perform(&mut session, &Performer::of_body(&motion.proportions), &motion.poses[..60], 0.0);
        let grown_up = body_of(&session);
        let poses: Vec<Pose> = motion.poses[60..120].iter().map(|p| Pose { root: p.root * 0.7, ..*p }).collect();
        perform(&mut session, &Performer::of_body(&child), &poses, 60.0 * PERIOD_SECS);
        let ratio = body_of(&session).offsets[0].y / grown_up.offsets[0].y;
        assert!((ratio - 0.7).abs() < 0.01, "{ratio}");
    }

    #[test]
    fn the_first_of_two_senders_is_used_until_it_is_silent() {
        let mut session = session(Options::DEFAULT, 1.0, true);
        let motion = walk();
        let performer = Performer::of_body(&motion.proportions);
        let mut heard = Vec::new();
        for (i, pose) in motion.poses.iter().cycle().take(300).enumerate() {
            let secs = i as f64 * PERIOD_SECS;
            // The second performer is 5 m from the first, which stops after a second.
            let beside = Pose { root: pose.root + Vec3::X * 5.0, ..*pose };
            for (port, pose, sends) in [(1, pose, i < 60), (2, &beside, true)] {
                for packet in packets(&performer, pose, &Frame::default(), secs) {
                    if sends {
                        session.receive(&packet, address(port), secs);
                    }
                }
            }
            session.tick(secs);
            heard.push(session.source.as_ref().map(|source| source.address.port()));
        }
        assert!(heard[..115].iter().all(|port| *port == Some(1)) && heard[125..].iter().all(|port| *port == Some(2)));
        let figures = session.figures();
        assert!(figures.losses == 1 && figures.packets_of_others > 100, "{figures:?}");
        // The styled figure does not jump.
        let farthest = |poses: &[Pose]| poses.windows(2).map(|w| w[0].root.distance(w[1].root)).fold(0.0, f32::max);
        let recorded = session.recorded();
        assert!(farthest(&recorded.input) > 4.0 && farthest(&recorded.styled) < 0.06, "{}", farthest(&recorded.styled));
    }

    #[test]
    fn styles_change_by_message_and_what_is_not_understood_is_passed_on() {
        let mut session = session(Options::DEFAULT, 1.0, false);
        let style = session.model.catalogue().styles.iter().position(|s| s != "neutral").unwrap();
        let name = session.model.catalogue().styles[style].clone();
        let other = Message::Other(vmc::OscMessage { addr: "/VMC/Ext/Blend/Apply".into(), args: Vec::new() });
        let messages = [Message::Style(name, 0.5), Message::Style("none".into(), 1.0), other.clone()];
        for packet in vmc::encode(&messages) {
            session.receive(&packet, address(1), 0.0);
        }
        session.receive(b"no packet", address(1), 0.0);
        assert_eq!(session.weights[style], 0.5);
        let mut out = Vec::new();
        for packet in session.tick(0.1) {
            vmc::decode(&packet, &mut out).unwrap();
        }
        assert_eq!(out, [other, Message::Loaded(false), Message::Time(f64::from(0.1_f32))]);
        let figures = session.figures();
        assert_eq!((figures.messages_dropped, figures.packets_refused), (1, 1));
    }
}
