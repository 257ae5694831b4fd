//! `strut live --send`: sends a file as a performer does.

use super::output::Output;
use super::stop;
use crate::print::print;
use std::path::Path;
use std::thread;
use std::time::{Duration, Instant};
use strut_core::retarget::to_humanoid;
use strut_formats::vmc::{self, Frame, Message, Performer};
use strut_tasks::clip::read_clip;
use strut_tasks::{Outcome, TaskError};

/// Greatest frame rate.
const MAX_RATE_HZ: f32 = 60.0;

/// Sends the motion of a file in real time, once, or looped for a number of seconds.
pub(super) fn send(file: &Path, output: &mut Output, secs: Option<f64>) -> Outcome {
    let clip = read_clip(file)?;
    let mut motion = to_humanoid(&clip.motion, &clip.binding, &clip.binding.proportions);
    if motion.rate_hz > MAX_RATE_HZ {
        motion = motion.resampled(MAX_RATE_HZ).map_err(|reason| TaskError::in_file(file, reason))?;
    }
    let performer = Performer::of_body(&motion.proportions);
    let stopped = stop::on_signals()?;
    let rate_hz = f64::from(motion.rate_hz);
    let frames = secs.map_or(motion.poses.len(), |secs| (secs * rate_hz) as usize);
    print(&format!("sending {} to {output}, {rate_hz:.0} frames a second\n", file.display()));
    let start = Instant::now();
    for (i, pose) in motion.poses.iter().cycle().take(frames).enumerate() {
        let now_secs = i as f64 / rate_hz;
        thread::sleep(Duration::from_secs_f64(now_secs).saturating_sub(start.elapsed()));
        if stopped() {
            break;
        }
        let mut messages: Vec<Message> = performer.frame(pose, &Frame::default()).messages().collect();
        messages.extend([Message::Loaded(true), Message::Time(now_secs)]);
        for packet in vmc::encode(&messages) {
            output.send(&packet);
        }
    }
    Ok(())
}
