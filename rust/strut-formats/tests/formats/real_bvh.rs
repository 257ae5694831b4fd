//! Real motion capture, if it is present: every clip is read and is unchanged after the conversion to a motion and back.

use crate::mocap;
use strut_formats::bvh;

#[test]
fn every_real_clip_survives_the_way_to_a_motion_and_back() {
    let Some(clips) = mocap::clips() else { return };
    for path in clips {
        let file = bvh::parse(&std::fs::read(&path).unwrap()).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let motion = file.to_motion().unwrap();
        let written = file.with_motion(&motion).unwrap();
        assert_eq!(bvh::parse(&bvh::write(&written)).as_ref(), Ok(&written), "{}", path.display());
        let back = written.to_motion().unwrap();
        let turned = motion.rotations.iter().zip(&back.rotations).map(|(a, b)| a.inv_mul(*b).angle());
        let moved = motion.translations.iter().zip(&back.translations).map(|(a, b)| (*a - *b).length());
        let (turned, moved) = (turned.fold(0.0, f32::max), moved.fold(0.0, f32::max));
        assert!(turned < 1e-5 && moved < 1e-4, "{}: {turned} rad, {moved} units", path.display());
    }
}
