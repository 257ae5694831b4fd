//! Tests of the built-in database.

use strut_demo::{PlannedClip, RUN_TAKES, STYLES, TABLE_1, WALK_TAKES, clips, database, full_clips};

#[test]
fn every_frame_has_its_exact_counterpart_in_every_style() {
    let db = database().unwrap();
    assert!((20_000..30_000).contains(&db.frames()), "{}", db.frames());
    assert_eq!(db.styles.len(), STYLES.len());
    assert_eq!(db.styles[usize::from(db.neutral)], "neutral");
    for row in 0..db.frames() {
        for style in 0..db.styles.len() as u16 {
            let all: Vec<f32> = db.counterparts(row, style).collect();
            assert_eq!(all.len(), 1, "one performance of the script a style");
            let (i, t) = (all[0] as usize, all[0].fract());
            let next = (i + 1).min(db.frames() - 1);
            let time =
                db.canonical_time[i] + if t > 0.0 { t * (db.canonical_time[next] - db.canonical_time[i]) } else { 0.0 };
            assert!((time - db.canonical_time[row]).abs() < 2.0, "row {row}: {time} {}", db.canonical_time[row]);
            assert_eq!(db.clips[db.clip_of_row(i)].take, db.clips[db.clip_of_row(row)].take);
        }
    }
}

#[test]
fn slow_styles_take_longer_for_the_same_script() {
    let clips = clips();
    assert_eq!(clips.len(), STYLES.len() * (WALK_TAKES.len() + RUN_TAKES.len() + 3));
    let length =
        |style: &str| -> usize { clips.iter().filter(|c| c.style == style).map(|c| c.motion.poses.len()).sum() };
    assert!(length("depressed") > length("old") && length("old") > length("neutral"));
    assert!(length("neutral") > length("childlike"));
}

#[test]
fn the_full_set_is_composed_as_table_1_of_the_paper() {
    let clips = full_clips();
    for (action, frames) in TABLE_1 {
        let counted = |c: &PlannedClip| if c.clip.action == action { c.clip.motion.poses.len() } else { 0 };
        assert_eq!(clips.iter().map(counted).sum::<usize>(), frames, "{action}");
    }
}
