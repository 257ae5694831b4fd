//! Adds a clip to a database as a new style.

use super::prepare::{encode, headings};
use super::report::Refusal;
use super::source::{MIN_CLIP_FRAMES, SourceClip};
use crate::database::{Class, Clip, Database, DatabaseError, DatabaseParts};
use crate::parallel::ParallelMap;
use crate::registration::{self, Addition, Counterparts, Example, Job, MAX_COUNTERPARTS, time_steps};
use std::fmt;
use thiserror::Error;

/// A clip fits an action if its warps cost less than this (squared feature distance per frame). With the built-in database
/// recorded walks cost 75 to 166 and runs 118 to 189, a jump of three strides 215, walking backwards 325 to 355.
const MAX_COST: f32 = 200.0;

/// Minimum length of a clip, seconds. A shorter part of a walk would fit part of any non-cyclic action.
const MIN_SECS: f32 = 1.0;

/// A database with a new style.
#[derive(Clone, Debug)]
pub struct AddedStyle {
    /// The database with the clip as its last style.
    pub database: Database,
    /// Action that the clip shows.
    pub action: u16,
    /// Mean cost of its warps to the clips of the action (squared feature distance per frame).
    pub cost: f32,
    /// Warning if the action was given and the clip moves too differently from the clips of that action.
    pub doubt: Option<Doubt>,
}

/// Warning that a clip is unlike the clips of the action that was given for it.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("its motion differs so much from the clips of '{given}' that the style may look wrong{better}")]
pub struct Doubt {
    /// The given action.
    pub given: String,
    /// Action that the clip fits better.
    pub better: Better,
}

/// Action that a clip fits better than the given one, if there is one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Better(pub Option<String>);

impl fmt::Display for Better {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.as_ref().map_or(Ok(()), |action| write!(f, "; it fits '{action}'"))
    }
}

/// Reason why a clip cannot become a style of a database.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum AddStyleError {
    /// The database already has a style of this name.
    #[error("the database already has a style '{0}'; another name was expected")]
    Exists(String),
    /// The clip is invalid.
    #[error(transparent)]
    Clip(#[from] Refusal),
    /// The clip is too short to show an action.
    #[error("it lasts {0:.1} s; a complete action of at least {MIN_SECS:.1} s was expected")]
    Brief(f32),
    /// The clip fits none of the actions. Contains the reason for the nearest action.
    #[error("it fits none of the database's actions ({actions}): {reason}")]
    NoAction {
        /// Names of the actions.
        actions: String,
        /// Reason why the clip was rejected for the nearest action: an action of the same kind if there is one, and
        /// among several the one for which most checks passed.
        reason: Refusal,
    },
    /// The clip cannot be registered with the clips of the given action.
    #[error("it does not fit '{given}': {reason}{better}")]
    NotGiven {
        /// The given action.
        given: String,
        /// Reason of the rejection.
        reason: Refusal,
        /// Action that the clip fits.
        better: Better,
    },
    /// The clip is unlike all actions of the database.
    #[error("it fits none of the database's actions ({actions}): its motion differs too much from all of them")]
    Unlike {
        /// Names of the actions.
        actions: String,
    },
    /// The resulting database is too large, or contains values out of range.
    #[error("the database would be invalid with this clip: {0}")]
    Database(#[from] DatabaseError),
}

/// Adds a clip as a new style. It is registered with the clips of the action that it fits best, which takes the time of
/// one clip; the correspondence of all others is kept. The clip's `action` and `script` are ignored; its motion has the
/// database's proportions.
///
/// # Errors
/// See [`AddStyleError`].
pub fn add_style(
    db: &Database,
    clip: &SourceClip,
    options: &registration::Options,
    executor: &impl ParallelMap,
) -> Result<AddedStyle, AddStyleError> {
    add_style_of(db, clip, None, options, executor)
}

/// [`add_style`] for a clip whose action is known, an index of the database's; `None` selects the one that fits best. A
/// clip that moves too differently from those of the given action is registered nevertheless, with a [`Doubt`].
///
/// # Errors
/// See [`AddStyleError`].
pub fn add_style_of(
    db: &Database,
    clip: &SourceClip,
    action: Option<u16>,
    options: &registration::Options,
    executor: &impl ParallelMap,
) -> Result<AddedStyle, AddStyleError> {
    if db.style_index(&clip.style).is_some() {
        return Err(AddStyleError::Exists(clip.style.clone()));
    }
    let example = example_of(db, clip)?;
    let secs = example.frames() as f32 / db.rate_hz;
    if secs < MIN_SECS {
        return Err(AddStyleError::Brief(secs));
    }
    let options =
        registration::Options { counterparts: db.counterparts_per_style.min(MAX_COUNTERPARTS), ..options.clone() };
    let (best, refusal) = best_of(db, &example, &options, executor, |of| action.is_none_or(|known| known == of));
    let actions = || db.actions.join(", ");
    let better = |than: u16| {
        let (best, _) = best_of(db, &example, &options, executor, |of| of != than);
        Better(
            best.filter(|(_, found)| found.cost <= MAX_COST).map(|(better, _)| db.actions[usize::from(better)].clone()),
        )
    };
    match best {
        Some((_, found)) if action.is_none() && found.cost > MAX_COST => {
            Err(AddStyleError::Unlike { actions: actions() })
        }
        Some((action, found)) => {
            let cost = found.cost;
            let doubt = (cost > MAX_COST)
                .then(|| Doubt { given: db.actions[usize::from(action)].clone(), better: better(action) });
            let database = Database::new(joined(db, clip, action, &example, &found))?;
            Ok(AddedStyle { database, action, cost, doubt })
        }
        None => match (refusal, action) {
            (Some(reason), Some(given)) => Err(AddStyleError::NotGiven {
                given: db.actions[usize::from(given)].clone(),
                reason: reason.into(),
                better: better(given),
            }),
            (Some(reason), None) => Err(AddStyleError::NoAction { actions: actions(), reason: reason.into() }),
            (None, _) => Err(AddStyleError::Unlike { actions: actions() }),
        },
    }
}

/// Action that a clip fits best among those selected, and its registration there; and the reason of the nearest action
/// that rejects it, if one does.
fn best_of(
    db: &Database,
    example: &Example,
    options: &registration::Options,
    executor: &impl ParallelMap,
    among: impl Fn(u16) -> bool,
) -> (Option<(u16, Addition)>, Option<registration::Refusal>) {
    let mut best: Option<(u16, Addition)> = None;
    let mut refusal = None;
    for action in (0..db.actions.len() as u16).filter(|of| among(*of)) {
        let mut examples: Vec<Example> = clips_of(db, action).map(|i| existing(db, &db.clips[i])).collect();
        // Without a neutral clip of the action there is no canonical timeline.
        if !db.clips.iter().any(|c| c.action == action && c.style == db.neutral) {
            continue;
        }
        examples.push(example.clone());
        let (styles, rate_hz) = (db.styles.len() + 1, db.rate_hz);
        let job = Job { examples: &examples, styles, neutral: db.neutral, rate_hz, options };
        match job.run_last(executor) {
            Ok(found) if best.as_ref().is_none_or(|(_, least)| found.cost < least.cost) => best = Some((action, found)),
            Ok(_) => {}
            Err(reason) => {
                refusal = Some(refusal.filter(|kept| nearness(kept) >= nearness(&reason)).unwrap_or(reason));
            }
        }
    }
    (best, refusal)
}

/// Number of checks of [`Job::run_last`] that a clip passed before it was rejected for an action.
fn nearness(refusal: &registration::Refusal) -> u8 {
    use registration::Refusal as R;
    match refusal {
        R::Gait => 0,
        R::NoGait | R::NoHeelStrikes => 1,
        R::TurnsTheOtherWay { .. } => 2,
        R::NoWarp => 3,
    }
}

/// The clip in the form that registration reads, in the database's chart.
fn example_of(db: &Database, clip: &SourceClip) -> Result<Example, Refusal> {
    let motion = &clip.motion;
    if !(motion.rate_hz.is_finite() && motion.rate_hz > 0.0) {
        return Err(Refusal::Rate(motion.rate_hz));
    }
    if motion.proportions != db.proportions {
        return Err(Refusal::Proportions);
    }
    if let Some(frame) = motion.poses.iter().position(|p| !p.is_finite()) {
        return Err(Refusal::NotFinite(frame));
    }
    let motion = motion.resampled(db.rate_hz)?;
    if motion.poses.len() < MIN_CLIP_FRAMES {
        return Err(Refusal::TooShort(motion.poses.len()));
    }
    Ok(encode(&motion, &headings(&motion), db.styles.len() as u16, &db.chart))
}

/// Clips of an action, as indices.
fn clips_of(db: &Database, action: u16) -> impl Iterator<Item = usize> + '_ {
    db.classes().iter().filter(move |c| c.action == action).flat_map(|c: &Class| c.clips.clone())
}

/// A clip of the database in the form that registration reads.
fn existing(db: &Database, clip: &Clip) -> Example {
    let rows = clip.rows();
    Example {
        style: clip.style,
        pose: db.pose[rows.clone()].to_vec(),
        point_cloud: db.point_cloud[rows.clone()].to_vec(),
        contact: db.contact[rows].iter().map(|c| c.map(|planted| planted == 1)).collect(),
        script: None,
    }
}

/// Parts of the database with the clip inserted after those of its action, and its style after the others.
fn joined(db: &Database, clip: &SourceClip, action: u16, example: &Example, found: &Addition) -> DatabaseParts {
    let of_action: Vec<usize> = clips_of(db, action).collect();
    let at = of_action.last().map_or(0, |&i| i + 1);
    let first_row = db.clips.get(at).map_or(db.frames(), |c| c.first_frame);
    let added = example.frames();
    let moved = |row: f32| if row >= first_row as f32 { row + added as f32 } else { row };
    let placed = |counterparts: &Counterparts| -> Vec<f32> {
        let row = |(example, frame): (u32, f32)| {
            let (first, frames) = match of_action.get(example as usize) {
                Some(&i) => (db.clips[i].first_frame, db.clips[i].frames),
                None => (first_row, added),
            };
            (first as f32 + frame).min((first + frames - 1) as f32)
        };
        let slots = counterparts.iter().take(db.counterparts_per_style);
        slots.map(|c| c.map_or(-1.0, |c| row((c.example, c.frame)))).collect()
    };
    let (styles, slots) = (db.styles.len(), db.counterparts_per_style);
    let none = vec![-1.0; slots];
    let mut of_row: Vec<Vec<f32>> = vec![none; db.frames()];
    for (&i, frames) in of_action.iter().zip(&found.of_others) {
        db.clips[i].rows().zip(frames).for_each(|(row, counterparts)| of_row[row] = placed(counterparts));
    }
    let mut counterpart: Vec<f32> = Vec::with_capacity((db.frames() + added) * (styles + 1) * slots);
    let own = || found.counterparts.iter().flat_map(placed);
    for (row, new) in of_row.iter().enumerate() {
        if row == first_row {
            counterpart.extend(own());
        }
        counterpart.extend(db.counterpart[row * styles * slots..(row + 1) * styles * slots].iter().map(|&c| moved(c)));
        counterpart.extend(new);
    }
    if first_row == db.frames() {
        counterpart.extend(own());
    }

    let neutral: Vec<Vec<f32>> =
        found.counterparts.chunks(styles + 1).map(|frame| placed(&frame[usize::from(db.neutral)])).collect();
    let mut parts = (**db).clone();
    insert(&mut parts.pose, first_row, &example.pose);
    insert(&mut parts.point_cloud, first_row, &example.point_cloud);
    insert(&mut parts.contact, first_row, &example.contact.iter().map(|c| c.map(u8::from)).collect::<Vec<_>>());
    insert(&mut parts.canonical_time, first_row, &canonical_times(db, &neutral));
    insert(&mut parts.time_step, first_row, &durations(db, &neutral));
    parts.counterpart = counterpart;
    parts.styles.push(clip.style.clone());
    parts.clips[at..].iter_mut().for_each(|c| c.first_frame += added);
    parts.clips.insert(
        at,
        Clip {
            name: clip.name.clone(),
            action,
            style: styles as u16,
            take: clip.take,
            first_frame: first_row,
            frames: added,
            source: clip.source.clone(),
            licence: clip.licence.clone(),
        },
    );
    parts
}

fn insert<T: Clone>(all: &mut Vec<T>, at: usize, new: &[T]) {
    all.splice(at..at, new.iter().cloned());
}

/// Canonical times of the clip's frames: those of their neutral counterparts. A frame without counterpart repeats the
/// last time.
fn canonical_times(db: &Database, neutral: &[Vec<f32>]) -> Vec<f32> {
    let at =
        |frame: &Vec<f32>| frame.iter().find(|row| **row >= 0.0).map(|row| db.canonical_time[row.round() as usize]);
    let mut last = 0.0;
    let held = |frame: &Vec<f32>| {
        last = at(frame).unwrap_or(last);
        last
    };
    neutral.iter().map(held).collect()
}

/// Seconds of the clip per canonical frame, from its pace through the neutral rows and the pace of those through
/// canonical time. Where counterparts change between two frames, the previous pace is kept.
fn durations(db: &Database, neutral: &[Vec<f32>]) -> Vec<f32> {
    /// Fastest plausible pace through the rows of another clip, frames per frame.
    const FASTEST: f32 = 10.0;
    let frames_at = |row: f32| 1.0 / (db.time_step[row.round() as usize] * db.rate_hz);
    let mut pace = 1.0;
    let mut time = 0.0;
    let mut canonical = vec![time];
    for (before, after) in neutral.iter().zip(&neutral[1..]) {
        let moves = before.iter().zip(after).filter(|(a, b)| **a >= 0.0 && (0.0..FASTEST).contains(&(*b - *a)));
        let (sum, count) = moves.fold((0.0, 0.0), |(sum, count), (a, b)| (sum + (b - a) * frames_at(*a), count + 1.0));
        if count > 0.0 {
            pace = sum / count;
        }
        time += pace;
        canonical.push(time);
    }
    time_steps(&canonical, db.rate_hz)
}
