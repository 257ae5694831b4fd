//! Styles a BVH file: `cargo run --release -p strut-motion-formats --example stylize_bvh -- DATABASE STYLE IN.bvh OUT.bvh`.

use std::error::Error;
use std::ops::ControlFlow;
use std::sync::Arc;
use strut_core::retarget::to_humanoid;
use strut_core::transfer::{ClipInput, NoClock, stylize_clip};
use strut_core::{Model, Options, Stylizer};
use strut_formats::corpus::Clip;
use strut_formats::{bvh, strutdb};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [database, style, input, output] = &arguments[..] else {
        return Err("usage: stylize_bvh DATABASE STYLE IN.bvh OUT.bvh".into());
    };
    let bytes = std::fs::read(database)?;
    let model = Arc::new(Model::of(strutdb::read_catalogue(&bytes, None)?));
    let catalogue = model.catalogue();

    let mut weights = vec![0.0; catalogue.styles.len()];
    let style = catalogue.style_index(style).ok_or_else(|| format!("the database has no style '{style}'"))?;
    weights[usize::from(style)] = 1.0;
    let mut stylizer = Stylizer::new(Arc::clone(&model), Options::DEFAULT)?;
    stylizer.set_styles(&weights)?;

    // The file's skeleton is bound to the humanoid, and its motion converted to the database's body and rate.
    let clip = Clip::parse(&std::fs::read(input)?)?;
    let motion = to_humanoid(&clip.motion, &clip.binding, &catalogue.proportions);
    let motion = ClipInput::new(motion, catalogue.rate_hz)?.motion;
    let styled = stylize_clip(&stylizer, &motion.poses, &mut NoClock, |_, _| ControlFlow::Continue(()))
        .ok_or("styling was stopped")?;

    // The result on the file's skeleton and at its rate.
    let styled = styled.on_skeleton(catalogue.rate_hz, &clip.motion, &clip.binding);
    std::fs::write(output, bvh::write(&clip.file.with_motion(&styled)?))?;
    Ok(())
}
