//! Header of a set, before its columns.
//!
//! Numbers are in LEB128, floats four bytes, little-endian. A text is the number of its bytes followed by UTF-8, a list
//! the number of its entries followed by these. JSON is not used, because its parser would be a fifth of the code that
//! styles the first frames of a page.
//!
//! | Content | Type |
//! | --- | --- |
//! | frames per second | float |
//! | offset of each joint from its parent in the T-pose, x y z in metres | floats |
//! | centre of each joint's exponential map, x y z w | floats |
//! | names of the actions, of the styles | two lists of texts |
//! | the neutral style | number |
//! | clips: name, action, style, take, frames, source, licence | list; names, sources and licences are texts |
//! | counterparts a style | number |
//! | inputs: name, frames | list |
//! | length of the columns, bytes | number |

use super::super::metadata::MAX_OFFSET_CM;
use super::super::read::{frames_of, unit_chart};
use super::super::{MAX_CLIPS, StrutdbError};
use super::numbers::{Reader, write_number};
use crate::container::ContainerError;
use strut_core::database::{Clip, Database, MAX_COUNTERPARTS};
use strut_core::humanoid::{JOINTS, Proportions};
use strut_core::math::{Quat, Vec3};
use strut_core::pose_vector::PoseChart;

pub(super) struct Header {
    pub(super) rate_hz: f32,
    pub(super) proportions: Proportions,
    pub(super) chart: PoseChart,
    pub(super) actions: Vec<String>,
    pub(super) styles: Vec<String>,
    pub(super) neutral: u16,
    /// Their actions and styles may be out of range; [`Database::new`] checks them.
    pub(super) clips: Vec<Clip>,
    pub(super) counterparts_per_style: usize,
    /// Motions on the database's humanoid and at its rate, in order.
    pub(super) inputs: Vec<InputInfo>,
    /// Length of the columns after the header, bytes.
    pub(super) bytes: usize,
}

#[derive(Clone)]
pub(super) struct InputInfo {
    pub(super) name: String,
    pub(super) frames: usize,
}

/// Encodes the header of a database and motions whose columns take `bytes`.
pub(super) fn write(db: &Database, inputs: &[InputInfo], bytes: usize) -> Vec<u8> {
    let mut header = Vec::new();
    write_floats(&mut header, [db.rate_hz]);
    write_floats(&mut header, db.proportions.offsets.iter().flat_map(Vec3::to_array));
    write_floats(&mut header, db.chart.means.iter().copied().flat_map(Quat::to_array));
    for names in [&db.actions, &db.styles] {
        write_number(&mut header, names.len() as u32);
        for name in names {
            write_text(&mut header, name);
        }
    }
    write_number(&mut header, db.neutral.into());
    write_number(&mut header, db.clips.len() as u32);
    for clip in &db.clips {
        write_text(&mut header, &clip.name);
        for number in [clip.action.into(), clip.style.into(), clip.take, clip.frames as u32] {
            write_number(&mut header, number);
        }
        write_text(&mut header, &clip.source);
        write_text(&mut header, &clip.licence);
    }
    write_number(&mut header, db.counterparts_per_style as u32);
    write_number(&mut header, inputs.len() as u32);
    for input in inputs {
        write_text(&mut header, &input.name);
        write_number(&mut header, input.frames as u32);
    }
    write_number(&mut header, bytes as u32);
    header
}

fn write_floats(header: &mut Vec<u8>, floats: impl IntoIterator<Item = f32>) {
    header.extend(floats.into_iter().flat_map(f32::to_le_bytes));
}

fn write_text(header: &mut Vec<u8>, text: &str) {
    write_number(header, text.len() as u32);
    header.extend(text.bytes());
}

/// Reads a header. The reader then is at the start of the columns.
///
/// # Errors
/// [`StrutdbError`] if the header is cut off or invalid.
pub(super) fn read(from: &mut Reader<'_>) -> Result<Header, StrutdbError> {
    let rate_hz = float(from)?;
    let proportions = proportions(from)?;
    let chart = (0..4 * JOINTS).map(|_| float(from)).collect::<Result<Vec<f32>, _>>()?;
    let chart = unit_chart(&chart)?;
    let [actions, styles] = [list(from, text)?, list(from, text)?];
    let neutral = index(from)?;
    let mut clips = list(from, clip)?;
    if clips.len() > MAX_CLIPS {
        return Err(StrutdbError::Layout("clips"));
    }
    frames_of(&clips)?;
    let mut row = 0;
    for clip in &mut clips {
        clip.first_frame = row;
        row += clip.frames;
    }
    let counterparts_per_style = from.number()? as usize;
    if counterparts_per_style > MAX_COUNTERPARTS {
        return Err(StrutdbError::Layout("counterparts"));
    }
    let inputs = list(from, |from| Ok(InputInfo { name: text(from)?, frames: from.number()? as usize }))?;
    let bytes = from.number()? as usize;
    Ok(Header { rate_hz, proportions, chart, actions, styles, neutral, clips, counterparts_per_style, inputs, bytes })
}

fn clip(from: &mut Reader<'_>) -> Result<Clip, StrutdbError> {
    Ok(Clip {
        name: text(from)?,
        action: index(from)?,
        style: index(from)?,
        take: from.number()?,
        first_frame: 0,
        frames: from.number()? as usize,
        source: text(from)?,
        licence: text(from)?,
    })
}

fn proportions(from: &mut Reader<'_>) -> Result<Proportions, StrutdbError> {
    let mut proportions = Proportions::default();
    for offset in &mut proportions.offsets {
        *offset = Vec3::new(float(from)?, float(from)?, float(from)?);
        if !offset.to_array().iter().all(|v| v.abs() <= MAX_OFFSET_CM as f32 / 100.0) {
            return Err(StrutdbError::Layout("joints"));
        }
    }
    Ok(proportions)
}

fn list<T>(
    from: &mut Reader<'_>,
    entry: impl Fn(&mut Reader<'_>) -> Result<T, StrutdbError>,
) -> Result<Vec<T>, StrutdbError> {
    let count = from.number()? as usize;
    from.expect(count)?;
    (0..count).map(|_| entry(from)).collect()
}

fn text(from: &mut Reader<'_>) -> Result<String, StrutdbError> {
    let length = from.number()? as usize;
    let text = String::from_utf8(from.bytes(length)?.to_vec());
    text.map_err(|_| StrutdbError::NotPacked)
}

fn index(from: &mut Reader<'_>) -> Result<u16, StrutdbError> {
    u16::try_from(from.number()?).map_err(|_| StrutdbError::NotPacked)
}

fn float(from: &mut Reader<'_>) -> Result<f32, ContainerError> {
    Ok(f32::from_le_bytes(from.array()?))
}
