//! Matches a segment with the best pieces of other clips.

use super::dtw::Dtw;
use super::features::{Feature, squared_distance};
use super::imw::Imw;
use super::options::{Options, WarpMethod};
use super::warp::{Ends, Warp};
use crate::math::sort_by_number;

/// Warps are smoothed over this time, seconds. This removes steps of single frames but keeps the timing of footsteps.
const SMOOTHING_SECS: f32 = 0.03;
/// Time around a heel strike within which counterparts change from one cycle to the next, seconds.
const CHANGE_SECS: f32 = 0.1;
/// Longer sequences are warped with a stride: the tables grow with the product of the lengths.
const MAX_TABLE_SIDE: usize = 1024;
/// Number of instants at which segments are compared in linear time.
const LINEAR_SAMPLES: usize = 12;

/// Whole clips are warped from start to end, but one may have been cut shorter than the other: a frame without
/// counterpart costs more than the usual distance of frames with one (about 20).
pub(super) const WHOLE_CLIP: Ends = Ends { open_begin: 0, open_end: 0, skip: Some(30.0) };

/// A range of an example's features to which a segment may be warped, or which is to be warped.
#[derive(Clone, Debug)]
pub(super) struct Piece<'a> {
    /// Index of the example.
    pub(super) example: usize,
    /// Features of the whole example.
    pub(super) all: &'a [Feature],
    /// First and last frame of the piece, inclusive.
    pub(super) first: usize,
    pub(super) last: usize,
    /// Ends that may be open.
    pub(super) ends: Ends,
}

impl<'a> Piece<'a> {
    fn features(&self) -> &'a [Feature] {
        &self.all[self.first..=self.last]
    }
}

/// A warp of every frame of a segment to another example.
#[derive(Clone, Debug)]
pub(super) struct Match {
    /// Index of the example.
    pub(super) example: usize,
    /// Frames of the example; the cost is a squared feature distance per frame.
    pub(super) warp: Warp,
}

/// Warps by the method of the options; the tables are reused.
pub(super) struct Warper {
    method: WarpMethod,
    sigma_frames: f32,
    reach: usize,
    dtw: Dtw,
    imw: Imw,
}

impl Warper {
    pub(super) fn new(options: &Options, rate_hz: f32) -> Self {
        Self {
            method: options.warp,
            sigma_frames: SMOOTHING_SECS * rate_hz,
            reach: (CHANGE_SECS * rate_hz).round() as usize,
            dtw: Dtw::default(),
            imw: Imw::new(rate_hz),
        }
    }

    /// Number of frames around a border between segments within which the change between their matches may occur.
    pub(super) fn reach(&self) -> usize {
        self.reach
    }

    /// Smoothed warp of a segment to other frames; `None` if the slope limit allows no warp. Linear time skips no frames.
    pub(super) fn warp(&mut self, a: &[Feature], b: &[Feature], ends: Ends) -> Option<Warp> {
        let stride = a.len().max(b.len()).div_ceil(MAX_TABLE_SIDE);
        if stride <= 1 {
            return Some(self.warp_all(a, b, ends)?.smoothed(self.sigma_frames));
        }
        let (thin_a, thin_b) = (thinned(a, stride), thinned(b, stride));
        let thin = self.warp_all(&thin_a, &thin_b, ends)?;
        // Linear between the kept frames; the last frames of a and b are always kept.
        let scale_b = (b.len() - 1) as f32 / (thin_b.len() - 1).max(1) as f32;
        let scale_a = (thin_a.len() - 1) as f32 / (a.len() - 1).max(1) as f32;
        let at = (0..a.len()).map(|i| {
            let x = i as f32 * scale_a;
            let k = (x as usize).min(thin.at.len().saturating_sub(2));
            let next = thin.at[(k + 1).min(thin.at.len() - 1)];
            (thin.at[k] + (next - thin.at[k]) * (x - k as f32)) * scale_b
        });
        Some(Warp { at: at.collect(), cost: thin.cost }.smoothed(self.sigma_frames * stride as f32))
    }

    fn warp_all(&mut self, a: &[Feature], b: &[Feature], ends: Ends) -> Option<Warp> {
        match self.method {
            WarpMethod::Dtw => self.dtw.warp(a.len(), b.len(), ends, |i, j| squared_distance(&a[i], &b[j])),
            WarpMethod::Imw => self.imw.warp(&mut self.dtw, a, b, ends),
            WarpMethod::Linear => {
                let (first, last) = linear_span(a.len(), b.len(), ends)?;
                Some(Warp::linear(a.len(), first, last, linear_cost(a, b, first, last)))
            }
        }
    }

    /// Matches of least cost among the pieces, best first, at most `count`. The pieces are first ranked in linear time,
    /// and the best `candidates` are warped.
    pub(super) fn best(&mut self, a: &Piece, pieces: &[Piece], candidates: usize, count: usize) -> Vec<Match> {
        let features = a.features();
        let mut ranked: Vec<(f32, &Piece)> = pieces
            .iter()
            .filter_map(|p| {
                let (first, last) = linear_span(features.len(), p.features().len(), p.ends)?;
                Some((linear_cost(features, p.features(), first, last), p))
            })
            .collect();
        sort_by_number(&mut ranked, |(cost, _)| *cost);
        let mut matches: Vec<Match> = ranked
            .iter()
            .take(candidates.max(count))
            .filter_map(|(_, piece)| {
                let mut warp = self.warp(features, piece.features(), piece.ends)?;
                for at in &mut warp.at {
                    *at += piece.first as f32;
                }
                Some(Match { example: piece.example, warp })
            })
            .collect();
        sort_by_number(&mut matches, |m| m.warp.cost);
        // One match of each clip comes before a second of any clip: the mean of different clips is better.
        let mut ranked: Vec<(usize, Match)> = Vec::with_capacity(matches.len());
        for m in matches {
            ranked.push((ranked.iter().filter(|(_, o)| o.example == m.example).count(), m));
        }
        sort_by_number(&mut ranked, |(rank, _)| *rank as f32);
        ranked.into_iter().take(count).map(|(_, m)| m).collect()
    }
}

/// Mean squared distance of two segments in linear time.
pub(super) fn linear_distance(a: &[Feature], b: &[Feature]) -> f32 {
    linear_cost(a, b, 0.0, (b.len() - 1) as f32)
}

/// Every `stride`-th feature, evenly distributed so that the first and the last are kept.
fn thinned(features: &[Feature], stride: usize) -> Vec<Feature> {
    let count = features.len().div_ceil(stride).max(2).min(features.len());
    let last = features.len() - 1;
    (0..count).map(|k| features[k * last / (count - 1).max(1)]).collect()
}

/// Positions of the first and the last of `n` frames on `m` frames in linear time: on their ends; with an open end at
/// the same pace; with both ends open in the middle.
fn linear_span(n: usize, m: usize, ends: Ends) -> Option<(f32, f32)> {
    let last = m.checked_sub(1)? as f32;
    let length = (n.checked_sub(1)? as f32).min(last);
    Some(match (ends.open_begin > 0, ends.open_end > 0) {
        (false, false) => (0.0, last),
        (true, false) => (last - length, last),
        (false, true) => (0.0, length),
        (true, true) => (0.5 * (last - length), 0.5 * (last + length)),
    })
}

/// Mean squared distance at a few instants in linear time.
fn linear_cost(a: &[Feature], b: &[Feature], first: f32, last: f32) -> f32 {
    let sum: f32 = (0..LINEAR_SAMPLES)
        .map(|k| {
            let t = k as f32 / (LINEAR_SAMPLES - 1) as f32;
            let i = (t * (a.len() - 1) as f32).round() as usize;
            let j = (first + (last - first) * t).round() as usize;
            squared_distance(&a[i], &b[j])
        })
        .sum();
    sum / LINEAR_SAMPLES as f32
}
