use super::*;
use crate::math::Vec3;
use proptest::prelude::*;

const PERIOD_SECS: f64 = 1.0 / 60.0;

fn at_x(x: f64) -> Pose {
    Pose { root: Vec3::new(x as f32, 0.9, 0.0), ..Pose::default() }
}

/// Frames of a body that moves at 1 m/s, sent at 60 Hz by another clock, with a transit time per frame.
fn sent(frames: std::ops::Range<usize>, transit: impl Fn(usize) -> f64) -> Vec<(f64, f64, Pose)> {
    let frame = |i: usize| {
        let secs = i as f64 * PERIOD_SECS;
        (1000.0 + secs, 5.0 + secs + transit(i), at_x(secs))
    };
    frames.map(frame).collect()
}

/// Pushes frames as they arrive and plays every 1/60 s between two times.
fn played(buffer: &mut JitterBuffer, mut frames: Vec<(f64, f64, Pose)>, from: f64, to: f64) -> Vec<Option<Played>> {
    frames.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut frames = frames.into_iter().peekable();
    let ticks = ((to - from) / PERIOD_SECS) as usize;
    (0..ticks)
        .map(|tick| {
            let now = from + tick as f64 * PERIOD_SECS;
            while let Some((sent, arrived, pose)) = frames.next_if(|frame| frame.1 <= now) {
                buffer.push(sent, arrived, &pose);
            }
            buffer.at(now)
        })
        .collect()
}

#[test]
fn an_even_stream_is_shown_a_period_later() {
    let mut buffer = JitterBuffer::new(Delay::Auto);
    let shown = played(&mut buffer, sent(0..300, |_| 0.01), 5.0, 9.0);
    assert!((buffer.delay_secs() - PERIOD_SECS).abs() < 1e-6, "{}", buffer.delay_secs());
    for (tick, played) in shown.iter().enumerate().skip(10) {
        let Played { pose, play, begins, .. } = played.unwrap();
        assert!(play == Play::Interpolated && !begins);
        let expected = (tick as f64 - 1.0) * PERIOD_SECS - 0.01;
        assert!((f64::from(pose.root.x) - expected).abs() < 1e-4, "{tick}: {} {expected}", pose.root.x);
    }
    assert_eq!(buffer.stats(), BufferStats { taken: buffer.stats().taken, ..BufferStats::default() });
}

#[test]
fn the_delay_rises_at_once_and_falls_slowly() {
    let mut buffer = JitterBuffer::new(Delay::Auto);
    // A tenth of the frames is 40 ms late for a while.
    let late = |i: usize| if (120..240).contains(&i) && i.is_multiple_of(10) { 0.05 } else { 0.01 };
    played(&mut buffer, sent(0..130, late), 5.0, 5.0 + 130.0 * PERIOD_SECS);
    let before = buffer.delay_secs();
    assert!((before - PERIOD_SECS).abs() < 2e-3, "{before}");
    let now = 5.0 + 240.0 * PERIOD_SECS;
    played(&mut buffer, sent(130..240, late), 5.0 + 130.0 * PERIOD_SECS, now);
    let risen = buffer.delay_secs();
    assert!((risen - PERIOD_SECS - 0.04).abs() < 2e-3, "{risen}");
    played(&mut buffer, sent(240..840, late), now, now + 6.0);
    // After a second fewer than a twentieth of the last two seconds' frames were late; then the delay falls by 5 ms per
    // second.
    let fallen = buffer.delay_secs();
    assert!((risen - fallen - 0.025).abs() < 1e-3, "{risen} {fallen}");
}

#[test]
fn motion_goes_on_for_a_moment_and_then_holds_until_it_is_lost() {
    let mut buffer = JitterBuffer::new(Delay::Fixed(0.02));
    let shown = played(&mut buffer, sent(0..60, |_| 0.0), 5.0, 7.0);
    let newest = 59.0 * PERIOD_SECS;
    for (tick, played) in shown.iter().enumerate().skip(5) {
        let Played { pose, play, .. } = played.unwrap();
        let head = tick as f64 * PERIOD_SECS - 0.02;
        let expected = head.min(newest + 0.05);
        assert!((f64::from(pose.root.x) - expected).abs() < 1e-3, "{tick}: {} {expected}", pose.root.x);
        let expected = match head - newest {
            b if b <= 0.0 => Play::Interpolated,
            b if b <= 0.05 => Play::Extrapolated,
            b if b <= 0.5 => Play::Held,
            _ => Play::Lost,
        };
        assert_eq!(play, expected, "{tick}");
    }
}

#[test]
fn a_sender_that_is_back_or_sets_its_clock_begins_anew() {
    let mut buffer = JitterBuffer::new(Delay::Auto);
    let mut shown = played(&mut buffer, sent(0..60, |_| 0.0), 5.0, 7.0);
    assert_eq!(shown.last().unwrap().unwrap().play, Play::Lost);
    // The stream returns after a second, on the same clock; then on a clock that is 500 s behind.
    shown.extend(played(&mut buffer, sent(120..180, |_| 0.0), 7.0, 8.0));
    let behind = sent(180..240, |_| 0.0).into_iter().map(|(sent, arrived, pose)| (sent - 500.0, arrived, pose));
    shown.extend(played(&mut buffer, behind.collect(), 8.0, 9.0));
    let begins: Vec<usize> = (0..shown.len()).filter(|&i| shown[i].is_some_and(|played| played.begins)).collect();
    assert_eq!(begins.len(), 3, "{begins:?}");
    assert_eq!(buffer.stats().losses, 2);
    let last = shown.last().unwrap().unwrap();
    assert!(last.play == Play::Interpolated && (f64::from(last.pose.root.x) - 4.0).abs() < 0.06, "{last:?}");
}

#[test]
fn a_wrong_time_does_not_begin_a_stream_but_several_that_agree_do() {
    let wrong = |frames: &mut Vec<(f64, f64, Pose)>, at: usize, secs: f64| frames[at].0 += secs;
    let mut buffer = JitterBuffer::new(Delay::Auto);
    let mut frames = sent(0..240, |_| 0.0);
    // A time of 0, as of a clock that was not read; a time next week; two in a row that disagree; two that agree.
    for (at, secs) in [(60, -1001.0), (90, 6e5), (120, -50.0), (121, 70.0), (150, 300.0), (151, 300.0)] {
        wrong(&mut frames, at, secs);
    }
    let shown = played(&mut buffer, frames, 5.0, 9.0);
    let begins = |shown: &[Option<Played>]| shown.iter().flatten().filter(|played| played.begins).count();
    let stats = buffer.stats();
    assert_eq!((begins(&shown), stats.losses, stats.dropped, stats.taken), (1, 0, 6, 234));
    assert!(
        shown[10..235].iter().flatten().all(|played| matches!(played.play, Play::Interpolated | Play::Extrapolated))
    );

    // After a reset of the clock, the third frame begins a stream.
    let mut frames = sent(240..300, |_| 0.0);
    for frame in &mut frames {
        frame.0 -= 900.0;
    }
    let shown = played(&mut buffer, frames, 9.0, 10.0);
    let stats = buffer.stats();
    assert_eq!((begins(&shown), stats.losses, stats.dropped), (1, 1, 8));
    assert_eq!(shown.last().unwrap().unwrap().play, Play::Interpolated);
}

#[test]
fn what_is_lost_late_or_twice_there_is_counted() {
    let mut buffer = JitterBuffer::new(Delay::Fixed(0.02));
    let mut frames = sent(0..200, |i| if i == 150 { 0.06 } else { 0.0 });
    let repeated = frames[50];
    frames.extend((0..20).map(|i| (repeated.0 + 1e-3 * f64::from(i), repeated.1 + 1e-3 * f64::from(i), repeated.2)));
    frames.retain(|frame| (frame.0 - 1000.0 - 100.0 * PERIOD_SECS).abs() > 1e-6);
    frames.push((f64::NAN, 7.0, Pose::default()));
    played(&mut buffer, frames, 5.0, 8.5);
    // Of the 20 extra frames, three are far enough from all others; one time is not a number.
    let expected = BufferStats { taken: 199 + 3, late: 1, dropped: 17 + 1, missing: 1, losses: 0 };
    assert_eq!(buffer.stats(), expected);
}

#[test]
fn hours_of_frames_take_no_more_memory() {
    let mut buffer = JitterBuffer::new(Delay::Auto);
    let pose = Pose::default();
    for i in 0..240 * 60 {
        let secs = f64::from(i) / 240.0;
        buffer.push(secs, secs, &pose);
        // No call of `at`: the receiver is busy.
    }
    assert!(buffer.frames.len() <= MOST_FRAMES && buffer.frames.capacity() < 2 * MOST_FRAMES);
    assert!(buffer.arrivals.len() <= MOST_ARRIVALS && buffer.arrivals.capacity() < 2 * MOST_ARRIVALS);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn frames_in_any_order_give_the_same_poses(order in Just((0..12).collect::<Vec<usize>>()).prop_shuffle()) {
        let frames = sent(0..12, |_| 0.0);
        let mut sorted = JitterBuffer::new(Delay::Fixed(0.2));
        let mut shuffled = JitterBuffer::new(Delay::Fixed(0.2));
        for (i, &at) in order.iter().enumerate() {
            // The offset of the clocks is known from the first frame on.
            let arrival = |frame: (f64, f64, Pose)| frame.0 - 995.0 + if i == 0 { 0.0 } else { 1e-3 };
            sorted.push(frames[i].0, arrival(frames[i]), &frames[i].2);
            shuffled.push(frames[at].0, arrival(frames[at]), &frames[at].2);
        }
        for tick in 0..12 {
            let now = 5.2 + f64::from(tick) * PERIOD_SECS;
            prop_assert_eq!(sorted.at(now).map(|p| p.pose), shuffled.at(now).map(|p| p.pose));
        }
    }

    #[test]
    fn any_times_are_survived_and_motion_never_goes_back(
        times in prop::collection::vec((any::<f64>(), any::<f64>(), 0.0f64..20.0), 0..200),
        fixed in any::<f64>(),
    ) {
        let mut buffer = JitterBuffer::new(Delay::Fixed(fixed));
        let mut last = None;
        for (sent, arrived, sane) in times {
            buffer.push(sent, arrived, &at_x(1.0));
            buffer.push(sane, sane + 0.01, &at_x(2.0));
            if let Some(played) = buffer.at(sane) {
                prop_assert!(played.pose.is_finite());
                prop_assert!(played.begins || last.is_none_or(|last| played.sent_secs >= last));
                last = Some(played.sent_secs);
            }
        }
    }
}
