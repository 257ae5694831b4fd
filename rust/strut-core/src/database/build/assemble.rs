//! Assembles the tensors of a database from registered clips.

use super::options::BuildOptions;
use super::prepare::Labels;
use super::source::SourceClip;
use crate::database::{Clip, DatabaseParts};
use crate::pose_vector::PoseChart;
use crate::registration::{self, Counterpart, Example, Registered};
use std::borrow::Borrow;

/// A clip that is part of the database.
pub(super) struct Kept {
    /// Index into the sorted source clips.
    source: usize,
    example: Example,
    /// Correspondence; counterparts refer to kept clips.
    registered: Registered,
}

/// Appends the registered clips of one action; `indices` are their indices among the source clips.
pub(super) fn keep(
    kept: &mut Vec<Kept>,
    indices: Vec<usize>,
    examples: Vec<Example>,
    outcomes: Vec<Result<Registered, registration::Refusal>>,
) {
    let mut next = kept.len() as u32;
    let number_of_example: Vec<Option<u32>> = outcomes
        .iter()
        .map(|o| {
            o.is_ok().then(|| {
                next += 1;
                next - 1
            })
        })
        .collect();
    for ((source, example), outcome) in indices.into_iter().zip(examples).zip(outcomes) {
        let Ok(mut registered) = outcome else { continue };
        for c in registered.counterparts.iter_mut().flatten() {
            *c = c.and_then(|c| number_of_example[c.example as usize].map(|example| Counterpart { example, ..c }));
        }
        kept.push(Kept { source, example, registered });
    }
}

/// Parts of the database. Labels without clips are dropped.
pub(super) fn parts<C: Borrow<SourceClip>>(
    clips: &[C],
    kept: &[Kept],
    labels: Labels,
    chart: &PoseChart,
    options: &BuildOptions,
) -> DatabaseParts {
    let source = |k: &Kept| clips[k.source].borrow();
    let used = |name: &String, of: fn(&SourceClip) -> &String| kept.iter().any(|k| of(source(k)) == name);
    let actions: Vec<String> = labels.actions.iter().filter(|a| used(a, |c| &c.action)).cloned().collect();
    let kept_styles: Vec<usize> = (0..labels.styles.len()).filter(|&s| used(&labels.styles[s], |c| &c.style)).collect();
    let styles: Vec<String> = kept_styles.iter().map(|&s| labels.styles[s].clone()).collect();
    let neutral = kept_styles.iter().position(|&s| s == usize::from(labels.neutral)).unwrap_or(0) as u16;

    let mut first_frame = 0;
    let first_rows: Vec<usize> = kept
        .iter()
        .map(|k| {
            first_frame += k.example.frames();
            first_frame - k.example.frames()
        })
        .collect();
    let mut parts = DatabaseParts {
        rate_hz: options.rate_hz,
        proportions: source(&kept[0]).motion.proportions,
        chart: *chart,
        clips: Vec::with_capacity(kept.len()),
        pose: Vec::with_capacity(first_frame),
        point_cloud: Vec::with_capacity(first_frame),
        canonical_time: Vec::with_capacity(first_frame),
        time_step: Vec::with_capacity(first_frame),
        contact: Vec::with_capacity(first_frame),
        counterparts_per_style: options.registration.counterparts(),
        counterpart: Vec::with_capacity(first_frame * styles.len() * options.registration.counterparts()),
        actions,
        styles,
        neutral,
    };
    for (k, &first_row) in kept.iter().zip(&first_rows) {
        let clip = source(k);
        parts.clips.push(Clip {
            name: clip.name.clone(),
            action: parts.actions.iter().position(|a| *a == clip.action).unwrap_or(0) as u16,
            style: parts.styles.iter().position(|s| *s == clip.style).unwrap_or(0) as u16,
            take: clip.take,
            first_frame: first_row,
            frames: k.example.frames(),
            source: clip.source.clone(),
            licence: clip.licence.clone(),
        });
        parts.pose.extend_from_slice(&k.example.pose);
        parts.point_cloud.extend_from_slice(&k.example.point_cloud);
        parts.canonical_time.extend_from_slice(&k.registered.canonical_time);
        parts.time_step.extend_from_slice(&k.registered.time_step);
        parts.contact.extend(k.example.contact.iter().map(|c| c.map(u8::from)));
        for frame in k.registered.counterparts.chunks(labels.styles.len()) {
            for &style in &kept_styles {
                parts.counterpart.extend(frame[style].iter().take(parts.counterparts_per_style).map(|c| {
                    c.map_or(-1.0, |c| {
                        let target = &kept[c.example as usize].example;
                        let row = first_rows[c.example as usize] as f32;
                        // The sum is rounded to f32 and could exceed the end of the clip.
                        (row + c.frame).min(row + (target.frames() - 1) as f32)
                    })
                }));
            }
        }
    }
    parts
}
