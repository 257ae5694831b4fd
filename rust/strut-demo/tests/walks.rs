//! Walks synthesised from the built-in styles.

use std::sync::Arc;
use strut_core::hsmm::{LabelledClip, Options, RATE_HZ, RuntimeWalkModel, Track, WALK, Walker, train, walk_of};
use strut_core::humanoid::Proportions;
use strut_core::parallel::Sequential;
use strut_demo::{STYLES, clips};

/// Number of frames of each walk.
const FRAMES: usize = 20 * RATE_HZ as usize;
/// Greatest rotation of a joint from one frame to the next, and from its mean rotation, where the exponential map wraps
/// at π; radians. The measured values were 0.35 and 1.25.
const MAX_STEP: f32 = 0.45;
const MAX_ANGLE: f32 = 1.6;

#[test]
fn no_joint_wraps_in_a_walk_of_any_style() {
    let tracks: Vec<(String, Track)> = clips()
        .into_iter()
        .filter(|clip| clip.action == WALK)
        .filter_map(|clip| Some((clip.style, walk_of(&clip.motion).ok()?.0)))
        .collect();
    let labelled: Vec<LabelledClip> = tracks.iter().map(|(style, track)| LabelledClip { style, track }).collect();
    let model = train(&Proportions::default(), &labelled, Options::default(), &Sequential).unwrap();
    assert_eq!(model.styles.len(), STYLES.len());
    let runtime = Arc::new(RuntimeWalkModel::new(&model));
    for style in 0..model.styles.len() {
        for weight in [-0.5, 0.5, 1.0, 1.5] {
            let mut weights = vec![0.0; model.styles.len()];
            weights[style] = weight;
            let mut walker = Walker::new(Arc::clone(&runtime));
            walker.set_styles(&weights).unwrap();
            let (mut fastest, mut farthest) = (0.0_f32, 0.0_f32);
            let mut last = walker.advance().rotations;
            for _ in 0..FRAMES {
                let rotations = walker.advance().rotations;
                for (j, (a, b)) in last.iter().zip(&rotations).enumerate() {
                    fastest = fastest.max(a.inv_mul(*b).angle());
                    if j > 0 {
                        farthest = farthest.max(model.reference[j].inv_mul(*b).angle());
                    }
                }
                last = rotations;
            }
            let name = &model.styles[style];
            assert!(fastest < MAX_STEP && farthest < MAX_ANGLE, "{weight} {name}: {fastest} and {farthest} rad");
        }
    }
}
