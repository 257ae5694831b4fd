//! No memory is allocated in a frame whose targets have been read before. The path runs from a file's skeleton to the
//! humanoid, unlabelled, towards three styles and another for an arm, with feet held, and back to the file's skeleton.

use std::sync::Arc;
use strut_core::math::{Quat, Vec3};
use strut_core::retarget::{Binding, FromHumanoid, ToHumanoid};
use strut_core::transfer::{BodyPart, Model, Options, Stylizer};
use strut_demo::benchmark;
use strut_formats::bvh::Bvh;

/// Number of frames until every list has reached its greatest length.
const WARM_UP: usize = 30;

#[test]
fn nothing_is_allocated_from_file_to_file() {
    let model = Arc::new(Model::new(benchmark::database(benchmark::LEAST_FRAMES).unwrap()));
    let db = model.catalogue();
    for (query, action) in benchmark::queries().iter().take(4).zip([None, None, None, Some(0)]) {
        let file = Bvh::from_humanoid(&query.motion).unwrap().to_motion().unwrap();
        let binding = Binding::detect(&file).unwrap();
        let allocations = || {
            let mut read = ToHumanoid::new(&binding, &db.proportions);
            let mut write = FromHumanoid::new(&binding, &db.proportions, &file);
            let options = Options { action, ..Options::DEFAULT };
            assert!(options.footplant && options.timing && options.input_style.is_none());
            let mut stylizer = Stylizer::new(Arc::clone(&model), options).unwrap();
            stylizer.set_styles(&[0.0, 0.4, 0.4, 0.4, 0.0, 0.0, 0.0, 0.0]).unwrap();
            stylizer.set_part_styles(BodyPart::LeftArm, Some(&[0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0])).unwrap();

            let (mut translations, mut rotations): (Vec<Vec3>, Vec<Quat>) =
                (file.translations_at(0).to_vec(), file.rotations_at(0).to_vec());
            let mut planted = 0;
            let mut style = |frame: usize| {
                let styled = stylizer.push(&read.frame(file.translations_at(frame), file.rotations_at(frame)));
                planted += usize::from(styled.planted[0] || styled.planted[1]);
                write.frame(&styled.pose, &mut translations, &mut rotations);
            };
            (0..WARM_UP).for_each(&mut style);
            let counted = allocation_counter::measure(|| (WARM_UP..file.frames()).for_each(&mut style));
            assert!(planted > 30, "feet are held in {planted} frames");
            counted.count_total
        };
        // The model keeps the targets that are computed when they are first read: one allocation for 16 rows of a style.
        let tables = 4 * db.frames().div_ceil(16) as u64;
        assert!(allocations() <= tables);
        assert_eq!(allocations(), 0);
    }
}
