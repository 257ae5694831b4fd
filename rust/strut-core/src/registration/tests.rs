//! Tests that dynamic time warping and iterative motion warping recover known warps of a moving body.

use super::matching::Warper;
use super::warp::{Ends, Warp};
use super::*;
use crate::fixtures::{Gait, NEUTRAL, RATE_HZ, walk};
use crate::humanoid::{Pose, Proportions};
use crate::math::float_funcs::{exp, sin};
use crate::parallel::Sequential;
use crate::pose_vector::{ROW, point_cloud};
use proptest::prelude::*;
use std::f32::consts::TAU;
use std::ops::Range;

/// An example in place, from poses and foot contacts.
fn example(style: u16, frames: impl Iterator<Item = (Pose, [bool; 2])>) -> Example {
    let proportions = Proportions::default();
    let (poses, contact): (Vec<Pose>, Vec<[bool; 2]>) = frames.unzip();
    Example {
        style,
        pose: vec![[0.0; ROW]; poses.len()],
        point_cloud: poses.iter().map(|p| point_cloud(&proportions, p, 0.0)).collect(),
        contact,
        script: None,
    }
}

/// Warp of one example to another of another style; each is one segment.
fn warp_of(a: &Example, b: &Example, warp: WarpMethod) -> Warp {
    let whole = [0..a.frames(), 0..b.frames()];
    let features = features::of_examples(&[a, b], &whole, 2, RATE_HZ, true, &Sequential);
    let options = Options { warp, ..Options::default() };
    Warper::new(&options, RATE_HZ).warp(&features[0], &features[1], Ends::default()).unwrap()
}

/// A time warp of `n` frames to `m` with fixed ends: slopes from 0.45 to 1.8.
#[derive(Clone, Copy, Debug)]
struct Planted {
    n: usize,
    m: usize,
    bend: f32,
}

impl Planted {
    /// Part of the motion that is done at frame `i` of a, 0 to 1.
    fn part(&self, i: usize) -> f32 {
        let t = i as f32 / (self.n - 1) as f32;
        t + self.bend * sin(TAU * t)
    }

    /// Mean and greatest difference of a warp from this one, frames of b.
    fn error(&self, warp: &Warp) -> (f32, f32) {
        let apart = |(i, at): (usize, &f32)| (at - self.part(i) * (self.m - 1) as f32).abs();
        let apart: Vec<f32> = warp.at.iter().enumerate().map(apart).collect();
        (apart.iter().sum::<f32>() / self.n as f32, apart.iter().copied().fold(0.0, f32::max))
    }
}

/// A cycle and a half of walking, in a and in b. `style` is the gait in b at the part 0 to 1 of the motion.
fn walks(planted: &Planted, style: impl Fn(f32) -> Gait) -> (Example, Example) {
    let frame = |gait: &Gait, part: f32| {
        let step = walk(gait, 1, 0.1 + 1.5 * part);
        (step.poses[0], step.contact[0].map(|c| c == 1))
    };
    let part_of_b = |j: usize| j as f32 / (planted.m - 1) as f32;
    let b = (0..planted.m).map(|j| frame(&style(part_of_b(j)), part_of_b(j)));
    (example(0, (0..planted.n).map(|i| frame(&NEUTRAL, planted.part(i)))), example(1, b))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn a_warp_planted_on_a_walk_is_recovered_by_both(bend in -0.07f32..0.07, stretch in 0.8f32..1.25) {
        let planted = Planted { n: 96, m: (96.0 * stretch) as usize, bend };
        let (a, b) = walks(&planted, |_| NEUTRAL);
        for method in [WarpMethod::Dtw, WarpMethod::Imw] {
            let (mean, greatest) = planted.error(&warp_of(&a, &b, method));
            prop_assert!(mean <= 1.0 && greatest <= 3.0, "{:?}: {} and {} frames", method, mean, greatest);
        }
    }

    /// Joint angles increase and decrease, and the trunk leans, over the motion.
    #[test]
    fn a_warp_planted_under_a_changing_style_is_recovered_by_both(
        bend in -0.07f32..0.07, stretch in 0.8f32..1.25, gain in -0.4f32..0.6, lean in -0.2f32..0.5,
    ) {
        let planted = Planted { n: 96, m: (96.0 * stretch) as usize, bend };
        let styled = |part: f32| {
            let swell = sin(0.5 * TAU * part);
            let scale = 1.0 + gain * swell;
            let Gait { swing, knee, arms, .. } = NEUTRAL;
            Gait { swing: scale * swing, knee: scale * knee, arms: scale * arms, lean: lean * swell, ..NEUTRAL }
        };
        let (a, b) = walks(&planted, styled);
        for method in [WarpMethod::Dtw, WarpMethod::Imw] {
            let (mean, greatest) = planted.error(&warp_of(&a, &b, method));
            prop_assert!(mean <= 1.5 && greatest <= 5.0, "{:?}: {} and {} frames", method, mean, greatest);
        }
    }
}

/// A lunge with a strike of an arm at half time, after drawing back; `size` depends on the style.
fn blow(size: f32, part: f32) -> (Pose, [bool; 2]) {
    let bump = |at: f32, width: f32| exp(-0.5 * ((part - at) / width) * ((part - at) / width));
    let angle = size * (1.5 * bump(0.55, 0.09) - 0.6 * bump(0.3, 0.07));
    let lunge = Gait { swing: 0.3 * angle, lean: 0.3 * angle, arms: angle, ..NEUTRAL };
    (walk(&lunge, 1, 0.2).poses[0], [true, true])
}

/// One clip contains the whole action, the other starts late and ends early: its strike corresponds to the strike.
#[test]
fn a_blow_falls_on_the_blow_of_a_clip_that_shows_more() {
    let (all, cut) = (0.0..1.0, 0.25..0.66);
    let clip = |style: u16, of: &Range<f32>, frames: usize, size: f32| {
        let part = |f: usize| of.start + (of.end - of.start) * f as f32 / (frames - 1) as f32;
        example(style, (0..frames).map(|f| blow(size, part(f))))
    };
    let examples = [clip(0, &all, 160, 1.0), clip(1, &cut, 120, 1.3)];
    for warp in [WarpMethod::Dtw, WarpMethod::Imw] {
        let options = Options { warp, ..Options::default() };
        let job = Job { examples: &examples, styles: 2, neutral: 0, rate_hz: RATE_HZ, options: &options };
        let outcome = job.run(&Sequential);
        assert_eq!(outcome.method, Method::WholeClips);
        let counterparts = &outcome.clips[1].as_ref().unwrap().counterparts;
        // From drawing back to the end of the strike.
        for frame in 25..90 {
            let planted = (cut.start + (cut.end - cut.start) * frame as f32 / 119.0) * 159.0;
            let at = counterparts[2 * frame][0].unwrap().frame;
            assert!((at - planted).abs() <= 4.0, "{warp:?}: frame {frame} falls on {at}; {planted} was planted");
        }
    }
}
