//! Registration by known correspondence.

use super::example::Example;
use super::job::Job;
use super::outcome::{Counterpart, Counterparts, Method, Outcome, Registered};

/// Registers examples that all have a script. The counterparts of a frame are the frames at the same script time of the
/// same script, and canonical time is script time.
pub(super) fn register(job: &Job) -> Outcome {
    let neutral = job.examples.iter().position(|e| e.style == job.neutral).or((!job.examples.is_empty()).then_some(0));
    let length = |e: &Example| e.script.as_ref().map_or(0.0, |(_, t)| (t[t.len() - 1] - t[0]) * job.rate_hz);
    Outcome {
        method: Method::Scripts,
        reference: neutral,
        canonical_frames: neutral.map_or(0.0, |i| length(&job.examples[i])),
        clips: job.examples.iter().map(|e| Ok(registered(job, e))).collect(),
    }
}

fn registered(job: &Job, example: &Example) -> Registered {
    let (id, times) = example.script.as_ref().map_or((0, [].as_slice()), |(id, t)| (*id, t.as_slice()));
    let mut counterparts: Vec<Counterparts> = vec![[None; 8]; example.frames() * job.styles];
    for style in 0..job.styles {
        let performances = job.examples.iter().enumerate().filter_map(|(i, e)| {
            let (other_id, other_times) = e.script.as_ref()?;
            (usize::from(e.style) == style && *other_id == id).then_some((i, other_times))
        });
        for (slot, (i, other_times)) in performances.take(job.options.counterparts()).enumerate() {
            for (frame, &time) in times.iter().enumerate() {
                counterparts[frame * job.styles + style][slot] =
                    Some(Counterpart { example: i as u32, frame: frame_at(other_times, time) });
            }
        }
    }
    let last = times.len().saturating_sub(1);
    let time_step = (0..times.len())
        .map(|f| {
            let (a, b) = (f.saturating_sub(1), (f + 1).min(last));
            let canonical_frames = (times[b] - times[a]) * job.rate_hz;
            ((b - a) as f32 / job.rate_hz / canonical_frames.max(1e-6)).clamp(1e-4, 1.0)
        })
        .collect();
    Registered {
        canonical_time: times.iter().map(|t| t * job.rate_hz).collect(),
        time_step,
        counterparts,
        cycles: Vec::new(),
        faulty_cycles: Vec::new(),
        cost: None,
    }
}

/// Fractional frame at which increasing `times` reach `time`, clamped to the clip.
fn frame_at(times: &[f32], time: f32) -> f32 {
    let next = times.partition_point(|&t| t < time);
    match next {
        0 => 0.0,
        n if n == times.len() => (n - 1) as f32,
        n => (n - 1) as f32 + (time - times[n - 1]) / (times[n] - times[n - 1]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_found_between_times_and_clamped_outside() {
        let times = [1.0, 2.0, 4.0];
        for (time, frame) in [(0.0, 0.0), (1.0, 0.0), (1.5, 0.5), (2.0, 1.0), (3.0, 1.5), (9.0, 2.0)] {
            assert!((frame_at(&times, time) - frame).abs() < 1e-6, "{time}");
        }
    }
}
