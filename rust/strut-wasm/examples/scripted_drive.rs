//! Drives and styles by a script, natively: `scripted_drive DB.strutdb TAKES SCRIPT OUT`. See
//! `tests/parity/drive.test.ts`.
//!
//! Each line of the script is a frame, `x z gait face action weight…`, or a path, `path x z …`, that holds from the
//! next frame on. `-` stands for no heading or no action; there is one weight per style. The output has the driver's
//! numbers and the styled pose of each frame, little-endian.

use std::error::Error;
use std::path::Path;
use std::sync::Arc;
use strut_core::humanoid::POSE_FLOATS;
use strut_core::transfer::{Model, Options, Stylizer};
use strut_formats::strutdb::{self, packed};
use strut_wasm::drive::{ClipSource, Clips, Driver};

fn main() -> Result<(), Box<dyn Error>> {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let [db, takes, script, out] = args.as_slice() else {
        return Err("scripted_drive DB.strutdb TAKES SCRIPT OUT".into());
    };
    let model = Arc::new(Model::of(strutdb::read_catalogue(&std::fs::read(db)?, None)?));
    let mut driver = driver_over(&model, &Model::new(packed::read_database(&std::fs::read(takes)?)?))?;
    let mut stylizer = Stylizer::new(Arc::clone(&model), Options::DEFAULT)?;
    let mut bytes = Vec::new();
    let mut hips: Option<[f32; 2]> = None;
    for line in std::fs::read_to_string(script)?.lines() {
        if let Some(points) = line.strip_prefix("path") {
            driver.set_path(&numbers(points)?);
            continue;
        }
        let words: Vec<&str> = line.split_whitespace().collect();
        let [x, z, gait, face, action, weights @ ..] = words.as_slice() else {
            return Err(format!("'{line}' is no frame").into());
        };
        let face = if *face == "-" { None } else { Some(face.parse()?) };
        let action = if *action == "-" { None } else { Some(action.parse()?) };
        driver.next(x.parse()?, z.parse()?, gait.parse()?, face, action, hips.map(|h| h[0]), hips.map(|h| h[1]));
        let frame = *driver.frame();
        stylizer.set_styles(&numbers(&weights.join(" "))?)?;
        stylizer.set_style_share(frame[frame.len() - 1]);
        let (pose, _) = frame.split_first_chunk::<POSE_FLOATS>().ok_or("a frame begins with a pose")?;
        let styled = stylizer.push(&strut_core::humanoid::Pose::read_from(pose)).pose;
        hips = Some([styled.root.x, styled.root.z]);
        let mut floats = [0.0; POSE_FLOATS];
        styled.write_to(&mut floats);
        bytes.extend(frame.iter().chain(&floats).flat_map(|number| number.to_le_bytes()));
    }
    std::fs::write(Path::new(out), bytes)?;
    Ok(())
}

fn driver_over(model: &Model, takes: &Model) -> Result<Driver, Box<dyn Error>> {
    let offsets = |of: &Model| strut_wasm::common::offsets_of(&of.catalogue().proportions);
    let said = |error: strut_wasm::common::EngineError| error.message();
    let mut clips = Clips::new(&offsets(model), model.catalogue().rate_hz).map_err(said)?;
    for of in [model, takes] {
        let catalogue = of.catalogue();
        for (number, clip) in catalogue.clips.iter().enumerate().filter(|(_, clip)| clip.style == catalogue.neutral) {
            let poses = strut_wasm::common::floats_of(catalogue.poses_of_clip(number).iter());
            let contacts: Vec<u8> = clip.rows().flat_map(|row| catalogue.contact(row)).collect();
            let (name, action) = (clip.name.clone(), catalogue.actions[usize::from(clip.action)].clone());
            let among = if std::ptr::eq(of, model) { ClipSource::Own } else { ClipSource::Takes };
            clips.add(among, name, action, &poses, &contacts, &offsets(of), catalogue.rate_hz).map_err(said)?;
        }
    }
    Ok(Driver::new(&clips).map_err(said)?)
}

fn numbers(text: &str) -> Result<Vec<f32>, std::num::ParseFloatError> {
    text.split_whitespace().map(str::parse).collect()
}
