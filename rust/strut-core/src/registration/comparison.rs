//! Compares ranges of frames of an action's clips as registration does, for display.

use super::example::Example;
use super::features::{DIMS, Feature, squared_distance};
use super::gait::{self, Segment, SegmentKind};
use super::imw::Imw;
use super::job::Job;
use super::matching::Warper;
use super::options::{Options, WarpMethod};
use super::warp::Ends;
use crate::parallel::Sequential;
use std::ops::{Range, RangeInclusive};

/// Features and gait cycles of an action's clips.
#[derive(Clone, Debug)]
pub struct Comparison {
    features: Vec<Vec<Feature>>,
    segments: Vec<Vec<Segment>>,
    rate_hz: f32,
}

/// A range of frames of a clip: the index of the example, and its frames.
pub type Stretch = (usize, RangeInclusive<usize>);

/// Comparison of two ranges, a and b.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared {
    /// cᵢⱼ: squared feature distance of every frame of a and every frame of b, row after row of a.
    pub costs: Vec<f32>,
    /// τ: for every frame of a the fractional frame of b, relative to the start of its range; `None` if the slope limit
    /// allows no warp.
    pub warp: Option<Vec<f32>>,
    /// For IMW, the scales α of all features for every frame of a, then their offsets β.
    pub affine: Vec<[[f32; DIMS]; 2]>,
}

impl Comparison {
    /// Computes the features of all clips of an action, sorted by style. Takes a second for some minutes of motion.
    pub fn new(examples: &[Example], styles: usize, neutral: u16, rate_hz: f32) -> Self {
        let options = Options::default();
        let job = Job { examples, styles, neutral, rate_hz, options: &options };
        let cyclic = gait::is_locomotion(examples, rate_hz);
        let cuts = if cyclic { gait::cut(examples, styles, rate_hz) } else { job.uncut() };
        let features = job.features(&vec![None; examples.len()], &cuts, cyclic, &Sequential);
        Self { features, segments: cuts.into_iter().map(|(segments, _)| segments).collect(), rate_hz }
    }

    /// Gait cycles of a clip, or the range that is compared if it has none; empty if the clip does not exist.
    pub fn cycles(&self, clip: usize) -> impl Iterator<Item = Range<usize>> + '_ {
        let whole = |s: &&Segment| matches!(s.kind, SegmentKind::Cycle | SegmentKind::Clip);
        self.segments.get(clip).into_iter().flatten().filter(whole).map(|s| s.frames.clone())
    }

    /// Compares two ranges; `None` if one is empty or does not exist.
    pub fn compare(&self, a: &Stretch, b: &Stretch, by: WarpMethod) -> Option<Compared> {
        let frames = |(clip, frames): &Stretch| self.features.get(*clip)?.get(frames.clone()).filter(|f| !f.is_empty());
        let (a, b) = (frames(a)?, frames(b)?);
        let costs = a.iter().flat_map(|x| b.iter().map(|y| squared_distance(x, y))).collect();
        let mut warper = Warper::new(&Options { warp: by, ..Options::default() }, self.rate_hz);
        let warp = warper.warp(a, b, Ends::default());
        let affine = match (&warp, by) {
            (Some(warp), WarpMethod::Imw) => Imw::new(self.rate_hz).affine(a, b, warp),
            _ => Vec::new(),
        };
        Some(Compared { costs, warp: warp.map(|warp| warp.at), affine })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{BENT, Gait, NEUTRAL, RATE_HZ, walk};
    use crate::humanoid::Proportions;
    use crate::kinematics::world_from_local;
    use crate::pose_vector::{HeadingFilter, Placement, PoseChart, point_cloud};

    fn example(style: u16, gait: &Gait) -> Example {
        let (walk, body) = (walk(gait, 300, 0.1), Proportions::default());
        let mut example = Example { style, pose: vec![], point_cloud: vec![], contact: vec![], script: None };
        let (mut filter, mut before) = (HeadingFilter::default(), None);
        for (pose, contact) in walk.poses.iter().zip(&walk.contact) {
            let heading = filter.update(&world_from_local(&body, pose), 1.0 / RATE_HZ);
            example.pose.push(PoseChart::default().encode(pose, heading, before, 1.0 / RATE_HZ));
            example.point_cloud.push(point_cloud(&body, pose, heading));
            example.contact.push(contact.map(|c| c == 1));
            before = Some(Placement { x: pose.root.x, z: pose.root.z, heading });
        }
        example
    }

    #[test]
    fn a_cycle_is_warped_to_itself_and_by_least_cost_to_another_style() {
        let comparison = Comparison::new(&[example(0, &NEUTRAL), example(1, &BENT)], 2, 0, RATE_HZ);
        let stretch = |clip: usize| {
            let cycle = comparison.cycles(clip).nth(1).unwrap();
            (clip, cycle.start..=cycle.end)
        };
        let (a, b) = (stretch(0), stretch(1));
        let same = comparison.compare(&a, &a, WarpMethod::Dtw).unwrap();
        assert!(same.warp.unwrap().iter().enumerate().all(|(i, at)| (at - i as f32).abs() < 1e-3));
        let (n, m) = (a.1.clone().count(), b.1.clone().count());
        let cost_along = |by: WarpMethod| {
            let Compared { costs, warp, affine } = comparison.compare(&a, &b, by).unwrap();
            assert_eq!((costs.len(), affine.len()), (n * m, if by == WarpMethod::Imw { n } else { 0 }));
            let warp = warp.unwrap();
            assert_eq!((warp[0], warp[n - 1], warp.len()), (0.0, (m - 1) as f32, n));
            warp.iter().enumerate().map(|(i, at)| costs[i * m + at.round() as usize]).sum::<f32>()
        };
        assert!(cost_along(WarpMethod::Dtw) < cost_along(WarpMethod::Linear));
        cost_along(WarpMethod::Imw);
        assert_eq!(comparison.compare(&(9, 0..=3), &b, WarpMethod::Dtw), None);
        assert_eq!(comparison.compare(&(0, 0..=1 << 20), &b, WarpMethod::Dtw), None);
    }
}
