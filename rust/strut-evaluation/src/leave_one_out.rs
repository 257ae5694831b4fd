//! Leave-one-out cross-validation over takes (`docs/methods/mar.md` §12).
//!
//! Fold k removes take k of every style and action from the database. Take k of the source style is styled and compared
//! with take k of the target style: training and test data never share a take.

use super::quality::{Quality, Styled, quality};
use super::truth::{Aligned, Alignment, Errors, align, root_free};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use strut_core::database::Database;
use strut_core::database::build::{self, Build, BuildError, BuildOptions, SourceClip};
use strut_core::humanoid::HumanoidMotion;
use strut_core::incremental::IncrementalJob;
use strut_core::math::random::SplitMix64;
use strut_core::parallel::Sequential;
use strut_core::pose_vector::point_cloud;
use strut_core::transfer::StyledFrame;

/// Options of the cross-validation.
#[derive(Clone, Copy, Debug)]
pub struct LeaveOneOut<'a> {
    /// All clips.
    pub clips: &'a [SourceClip],
    /// Style of the inputs, which is the neutral style of the databases.
    pub source: &'a str,
    /// Actions to predict; empty for all.
    pub actions: &'a [String],
    /// Actions of the databases; empty for the actions to predict.
    pub database_actions: &'a [String],
    /// Styles to predict; empty for all but the source.
    pub targets: &'a [String],
    /// Maximum number of takes in a database of each (action, style) other than the source style's, chosen at random; 0
    /// for all.
    pub target_takes: usize,
    /// Options of the databases; the neutral style is the source.
    pub build: &'a BuildOptions,
}

/// A performance that is held out, and its ground truth.
#[derive(Clone, Debug)]
pub struct Trial {
    /// Name of the action.
    pub action: String,
    /// Name of the target style.
    pub target: String,
    /// Number of the take.
    pub take: u32,
    /// The source take at the database's rate.
    pub input: HumanoidMotion,
    /// Frames that are compared: whole gait cycles, or all of a clip without cycles.
    pub segments: Vec<Range<usize>>,
    /// The target style's take at the database's rate.
    pub target_take: HumanoidMotion,
    /// The target style's take, aligned with the input frame by frame.
    pub truth: Aligned,
    /// Errors of the unchanged input: the upper bound.
    pub unchanged: Errors,
    /// Errors of the target style's other takes: the lower bound.
    pub floor: Option<Floor>,
}

/// Errors of other real takes of the target style relative to the one that is held out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floor {
    /// Errors of the best take.
    pub best_take: Errors,
    /// Errors of the mean of the first three takes (of all, if there are fewer).
    pub mean_of_takes: Errors,
}

/// Results of a method in a trial.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measurement {
    /// Errors of the prediction, before feet are planted.
    pub errors: Errors,
    /// Errors of the finished output.
    pub finished_errors: Errors,
    /// Measures that need no ground truth.
    pub quality: Quality,
}

/// Number of takes that are averaged for the second lower bound.
const TAKES_OF_MEAN: usize = 3;

impl<'a> LeaveOneOut<'a> {
    fn predicted(&self, action: &str) -> bool {
        self.actions.is_empty() || self.actions.iter().any(|a| a == action)
    }

    fn in_database(&self, action: &str) -> bool {
        if self.database_actions.is_empty() {
            self.predicted(action)
        } else {
            self.database_actions.iter().any(|a| a == action)
        }
    }

    /// Takes of the source style for the actions to predict, in order.
    pub fn takes(&self) -> Vec<u32> {
        let source = self.clips.iter().filter(|c| c.style == self.source && self.predicted(&c.action));
        source.map(|c| c.take).collect::<BTreeSet<_>>().into_iter().collect()
    }

    /// The target styles, in order.
    pub fn targets(&self) -> Vec<&'a str> {
        let wanted = |s: &&str| *s != self.source && (self.targets.is_empty() || self.targets.iter().any(|t| t == s));
        let predicted = self.clips.iter().filter(|c| self.predicted(&c.action));
        predicted.map(|c| c.style.as_str()).filter(wanted).collect::<BTreeSet<_>>().into_iter().collect()
    }

    /// Database that contains no clip of a take. Each `draw` is another random choice of the takes that are kept.
    ///
    /// Performances change with their number, so that the first takes of a style are similar to each other and to the
    /// neighbouring folds. Therefore the takes are chosen at random. The choice of more takes contains that of fewer
    /// takes with the same `draw`.
    ///
    /// # Errors
    /// If no clips are left for a database.
    pub fn database_without(&self, take: u32, draw: u32) -> Result<Database, BuildError> {
        let options = BuildOptions { neutral: Some(self.source.to_owned()), ..self.build.clone() };
        Build::new(self.kept(take, draw), &options)?.finish(&Sequential).map(|(db, _)| db)
    }

    /// Clips of [`LeaveOneOut::database_without`], by take.
    fn kept(&self, take: u32, draw: u32) -> Vec<&SourceClip> {
        let mut clips: Vec<&SourceClip> =
            self.clips.iter().filter(|c| c.take != take && self.in_database(&c.action)).collect();
        clips.sort_by_key(|c| c.take);
        let mut takes: BTreeMap<(&str, &str), Vec<u32>> = BTreeMap::new();
        for clip in &clips {
            takes.entry((&clip.action, &clip.style)).or_default().push(clip.take);
        }
        let mut random = SplitMix64::new(u64::from(take) << 32 | u64::from(draw));
        for ((_, style), takes) in &mut takes {
            if self.target_takes > 0 && *style != self.source {
                random.shuffle(takes);
                takes.truncate(self.target_takes);
            }
        }
        clips.retain(|c| takes[&(c.action.as_str(), c.style.as_str())].contains(&c.take));
        clips
    }

    /// Trials in the fold of a take: one for each action and target style. A take that cannot be registered has none.
    pub fn trials(&self, take: u32) -> Vec<Trial> {
        let actions: BTreeSet<&str> =
            self.clips.iter().map(|c| c.action.as_str()).filter(|a| self.predicted(a)).collect();
        actions
            .into_iter()
            .flat_map(|action| self.targets().into_iter().filter_map(move |target| self.trial(action, target, take)))
            .collect()
    }

    fn trial(&self, action: &str, target: &str, take: u32) -> Option<Trial> {
        let of = |style: &str| -> Vec<&SourceClip> {
            let mut clips: Vec<&SourceClip> =
                self.clips.iter().filter(|c| c.action == action && c.style == style).collect();
            clips.sort_by_key(|c| c.take);
            clips
        };
        let at_rate = |c: &SourceClip| c.motion.resampled(self.build.rate_hz).ok();
        let input = at_rate(of(self.source).into_iter().find(|c| c.take == take)?)?;
        let takes = of(target);
        let held_out = takes.iter().position(|c| c.take == take)?;
        let motions: Vec<HumanoidMotion> = takes.iter().map(|c| at_rate(c)).collect::<Option<_>>()?;
        let Alignment { segments, others: aligned } = align(&input, &motions.iter().collect::<Vec<_>>())?;
        let truth = aligned[held_out].clone()?;
        let errors = |a: &Aligned| a.errors(&truth, &segments, input.rate_hz);
        let others: Vec<&Aligned> =
            aligned.iter().enumerate().filter(|(i, _)| *i != held_out).filter_map(|(_, a)| a.as_ref()).collect();
        let best = others.iter().map(|a| errors(a)).min_by(|a, b| a.pose.total_cmp(&b.pose));
        let mean = Aligned::mean(&others[..others.len().min(TAKES_OF_MEAN)]);
        Some(Trial {
            unchanged: errors(&Aligned::unchanged(&input)),
            floor: best.zip(mean).map(|(best_take, mean)| Floor { best_take, mean_of_takes: errors(&mean) }),
            action: action.to_owned(),
            target: target.to_owned(),
            take,
            input,
            segments,
            target_take: motions[held_out].clone(),
            truth,
        })
    }
}

impl Trial {
    /// Measures the output of [`super::quality::style`].
    pub fn measure(&self, styled: &Styled) -> Measurement {
        let errors = |frames| self.aligned(frames).errors(&self.truth, &self.segments, self.input.rate_hz);
        Measurement {
            errors: errors(&styled.predicted),
            finished_errors: errors(&styled.finished.frames),
            quality: quality(&self.input, styled),
        }
    }

    /// Styled frames, one for each input frame, as a performance that is aligned with the input.
    pub fn aligned(&self, frames: &[StyledFrame]) -> Aligned {
        // The heading of the output is that of the input.
        let headings = build::headings(&self.input);
        let points = |(f, h): (&StyledFrame, f32)| root_free(&point_cloud(&self.input.proportions, &f.pose, h));
        Aligned {
            points: frames.iter().zip(headings).map(points).collect(),
            time_secs: frames.iter().map(|f| f.time_out_secs).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use strut_core::humanoid::Proportions;

    /// Eight takes of walking in two styles.
    fn clips() -> Vec<SourceClip> {
        let motion = HumanoidMotion { proportions: Proportions::default(), rate_hz: 60.0, poses: Vec::new() };
        let clip = |style: &str, take| SourceClip {
            name: format!("walk_{style}_{take}"),
            action: "walk".to_owned(),
            style: style.to_owned(),
            take,
            motion: motion.clone(),
            source: String::new(),
            licence: String::new(),
            script: None,
        };
        (1..=8).flat_map(|take| [clip("neutral", take), clip("old", take)]).collect()
    }

    /// Numbers of the "old" takes that are kept.
    fn old_takes(clips: &[SourceClip], target_takes: usize, draw: u32) -> Vec<u32> {
        let build = BuildOptions::default();
        let (actions, targets) = (["walk".to_owned()], []);
        let protocol = LeaveOneOut {
            clips,
            source: "neutral",
            actions: &actions,
            database_actions: &[],
            targets: &targets,
            target_takes,
            build: &build,
        };
        let kept = protocol.kept(3, draw);
        assert_eq!(kept.iter().filter(|c| c.style == "neutral").count(), 7);
        kept.iter().filter(|c| c.style == "old").map(|c| c.take).collect()
    }

    #[test]
    fn fewer_takes_are_chosen_by_chance_and_again_by_the_same_draw() {
        let clips = clips();
        assert_eq!(old_takes(&clips, 0, 0), [1, 2, 4, 5, 6, 7, 8]);
        let draws: BTreeSet<Vec<u32>> = (0..20).map(|draw| old_takes(&clips, 2, draw)).collect();
        assert!(draws.len() > 5, "{draws:?}");
        for draw in 0..20 {
            let [one, two] = [1, 2].map(|n| old_takes(&clips, n, draw));
            assert_eq!((one.len(), two.len()), (1, 2));
            assert!(two.contains(&one[0]) && !two.contains(&3), "{one:?} {two:?}");
            assert_eq!(two, old_takes(&clips, 2, draw));
        }
    }
}
