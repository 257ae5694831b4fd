//! Splitting styles whose takes differ too much (`docs/methods/hsmm.md` §6: styles with two takes).

use super::features::{Track, reference};
use super::model::{SIDES, STATES, Side, StyleMeans};
use super::statistics::{Sample, Statistics, states};
use super::training::LabelledClip;
use crate::humanoid::JOINTS;
use crate::math::{Quat, Vec3, exp_map};

/// Mean angle between the joints above which two takes are different expressions of a style, degrees.
const APART: f64 = 6.0;

/// Returns the style name of every clip: its own, with a letter if the takes of its style are different expressions, as in
/// `proud A` and `proud B`. Takes are clustered by the mean distance of their mean steps; one without steps of a foot
/// joins the first.
pub fn landmarks(clips: &[LabelledClip<'_>]) -> Vec<String> {
    let tracks: Vec<_> = clips.iter().map(|clip| clip.track).collect();
    let reference = reference(&tracks);
    let steps: Vec<Option<StyleMeans>> = tracks.iter().map(|track| mean_steps(track, &reference)).collect();
    let mut names: Vec<String> = clips.iter().map(|clip| clip.style.to_owned()).collect();
    for (first, clip) in clips.iter().enumerate() {
        if clips[..first].iter().any(|before| before.style == clip.style) {
            continue;
        }
        let takes: Vec<usize> = (first..clips.len()).filter(|&i| clips[i].style == clip.style).collect();
        let groups = grouped(&takes, &steps);
        if groups.len() > 1 {
            for (group, takes) in groups.iter().enumerate() {
                for &take in takes {
                    names[take] = landmark(clip.style, group);
                }
            }
        }
    }
    names
}

/// Returns the indices of a model's styles of a name: the style itself, or all its landmarks.
pub fn styles_named(styles: &[String], name: &str) -> Vec<usize> {
    let of = |is: &dyn Fn(&str) -> bool| (0..styles.len()).filter(|&i| is(&styles[i])).collect();
    let same: Vec<usize> = of(&|style| style == name);
    if same.is_empty() { of(&|style| (0..styles.len()).any(|group| landmark(name, group) == style)) } else { same }
}

/// The name of a group of takes: A to Z, then AA to ZZ, and so on.
fn landmark(style: &str, group: usize) -> String {
    let letter = char::from(b'A' + (group % 26) as u8);
    format!("{style} {}", letter.to_string().repeat(group / 26 + 1))
}

/// The mean poses of a clip's steps, each cut into equal parts; `None` if a foot has no steps.
fn mean_steps(track: &Track, reference: &[Quat; JOINTS]) -> Option<StyleMeans> {
    let sample = Sample::new(0, track, reference);
    let has = |side: Side| sample.steps.iter().any(|step| step.side == side);
    (has(Side::Left) && has(Side::Right)).then(|| Statistics::aligned(&[&sample], None).means())
}

/// Mean angle between the joints of the mean steps of two clips, degrees.
fn distance(a: &StyleMeans, b: &StyleMeans) -> f64 {
    let rotation = |of: &StyleMeans, side: usize, state: usize, j: usize| {
        let row = &of.means[side][state][0];
        exp_map::exp(Vec3::new(row[3 * j] as f32, row[3 * j + 1] as f32, row[3 * j + 2] as f32))
    };
    let angles = states().flat_map(|(side, state)| {
        (0..JOINTS).map(move |j| rotation(a, side, state, j).inv_mul(rotation(b, side, state, j)).angle().to_degrees())
    });
    angles.map(f64::from).sum::<f64>() / (SIDES * STATES * JOINTS) as f64
}

/// Clusters takes by the mean distance of all pairs; the cluster of the first take comes first.
fn grouped(takes: &[usize], means: &[Option<StyleMeans>]) -> Vec<Vec<usize>> {
    let (known, others): (Vec<usize>, Vec<usize>) = takes.iter().partition(|&&take| means[take].is_some());
    let between = |a: usize, b: usize| match (&means[a], &means[b]) {
        (Some(a), Some(b)) => distance(a, b),
        _ => 0.0,
    };
    let distances: Vec<Vec<f64>> = known.iter().map(|&a| known.iter().map(|&b| between(a, b)).collect()).collect();
    let mut groups: Vec<Vec<usize>> = (0..known.len()).map(|i| vec![i]).collect();
    loop {
        let mean = |a: &[usize], b: &[usize]| {
            let sum: f64 = a.iter().flat_map(|&i| b.iter().map(move |&j| (i, j))).map(|(i, j)| distances[i][j]).sum();
            sum / (a.len() * b.len()) as f64
        };
        let pairs = (0..groups.len()).flat_map(|b| (0..b).map(move |a| (a, b)));
        let nearest = pairs.map(|(a, b)| (mean(&groups[a], &groups[b]), a, b)).min_by(|x, y| x.0.total_cmp(&y.0));
        let Some((_, a, b)) = nearest.filter(|(distance, ..)| *distance <= APART) else { break };
        let joined = groups.remove(b);
        groups[a].extend(joined);
    }
    groups.sort_by_key(|group| group.iter().min().copied());
    let mut groups: Vec<Vec<usize>> = groups.into_iter().map(|g| g.into_iter().map(|i| known[i]).collect()).collect();
    match groups.first_mut() {
        Some(first) => first.extend(others),
        None => groups.push(others),
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_found_with_their_landmarks() {
        let styles = ["old", "proud A", "proud B", "proud Z0"].map(str::to_owned);
        assert_eq!(styles_named(&styles, "old"), [0]);
        assert_eq!(styles_named(&styles, "proud"), [1, 2]);
        assert_eq!(styles_named(&styles, "proud B"), [2]);
        assert!(styles_named(&styles, "prou").is_empty());
        assert_eq!(landmark("proud", 27), "proud BB");
    }
}
