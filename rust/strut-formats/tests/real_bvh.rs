//! Real motion capture, where it is present: every clip is read and comes back from a motion unchanged.

use std::path::{Path, PathBuf};
use strut_formats::bvh;

/// The folder of real clips: `$STRUT_MOCAP`, else `shared/data` beside the repository.
fn mocap_folder() -> Option<PathBuf> {
    let beside = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let folder = std::env::var_os("STRUT_MOCAP").map_or(beside, PathBuf::from);
    folder.is_dir().then_some(folder)
}

fn clips(folder: &Path) -> Vec<PathBuf> {
    let entries = |folder: &Path| -> Vec<PathBuf> {
        std::fs::read_dir(folder).map(|d| d.filter_map(|e| Some(e.ok()?.path())).collect()).unwrap_or_default()
    };
    let mut found: Vec<PathBuf> = entries(folder).iter().filter(|p| p.is_dir()).flat_map(|p| entries(p)).collect();
    found.retain(|p| p.extension().is_some_and(|e| e == "bvh"));
    found.sort();
    found
}

#[test]
fn every_real_clip_survives_the_way_to_a_motion_and_back() {
    let Some(folder) = mocap_folder() else {
        println!("skipped: no real motion capture; set STRUT_MOCAP to its folder");
        return;
    };
    let clips = clips(&folder);
    assert!(!clips.is_empty(), "no .bvh in {}", folder.display());
    for path in clips {
        let file = bvh::parse(&std::fs::read(&path).unwrap()).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let motion = file.to_motion().unwrap();
        let written = file.with_motion(&motion).unwrap();
        assert_eq!(bvh::parse(bvh::write(&written).as_bytes()).as_ref(), Ok(&written), "{}", path.display());
        let back = written.to_motion().unwrap();
        let turned = motion.rotations.iter().zip(&back.rotations).map(|(a, b)| a.inv_mul(*b).angle());
        let moved = motion.translations.iter().zip(&back.translations).map(|(a, b)| (*a - *b).length());
        let (turned, moved) = (turned.fold(0.0, f32::max), moved.fold(0.0, f32::max));
        assert!(turned < 1e-5 && moved < 1e-4, "{}: {turned} rad, {moved} units", path.display());
    }
}
