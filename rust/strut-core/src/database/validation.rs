//! Checks of the data of a database.

use super::parts::{Class, DatabaseParts, PointCloud};
use crate::pose_vector::PoseRow;
use crate::registration::MAX_COUNTERPARTS;
use bytemuck::NoUninit;
use thiserror::Error;

/// Greatest number of frames of a database.
pub const MAX_FRAMES: usize = 4_000_000;
/// Shortest and longest duration of a canonical frame, seconds. Target durations are quotients of durations; with these
/// bounds none overflows.
const TIME_STEP_RANGE: [f32; 2] = [1e-5, 10.0];

/// Reason why data are not a valid database.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum DatabaseError {
    /// The number of rows of a tensor does not match the clips.
    #[error("'{tensor}' has {found} entries; the clips need {expected}")]
    Shape {
        /// Name of the tensor.
        tensor: &'static str,
        /// Entries found.
        found: usize,
        /// Entries expected.
        expected: usize,
    },
    /// The frame rate is out of range.
    #[error("the rate is {0} Hz; 1 to 1000 was expected")]
    Rate(f32),
    /// The body is invalid.
    #[error("a limb bone has no length, or an offset is not a finite number")]
    Body,
    /// There are no clips.
    #[error("it has no clips")]
    NoClips,
    /// The neutral style is not in the list of styles.
    #[error("the neutral style is number {neutral} of {styles}")]
    Neutral {
        /// Index of the neutral style.
        neutral: u16,
        /// Number of styles.
        styles: usize,
    },
    /// The number of counterparts per style is out of range.
    #[error("{0} counterparts per style; 1 to {MAX_COUNTERPARTS} were expected")]
    Counterparts(usize),
    /// The action or the style of the clip of this name is not in its list.
    #[error("clip '{0}' has an action or style that is not in the lists")]
    Labels(String),
    /// A clip does not follow the one before, has no frame, or has too many.
    #[error("clip '{clip}' must begin at frame {first_frame} and have at least one")]
    Frames {
        /// Name of the clip.
        clip: String,
        /// The first frame that was expected.
        first_frame: usize,
    },
    /// The clip of this name is not sorted by action, then style.
    #[error("clip '{0}' is out of order: clips are sorted by action, then style")]
    Order(String),
    /// A tensor contains a value that is NaN, infinite or out of range.
    #[error("'{tensor}' holds {value} at frame {frame}; {expected} was expected")]
    Value {
        /// Name of the tensor.
        tensor: &'static str,
        /// Row of the value.
        frame: usize,
        /// The invalid value.
        value: f32,
        /// Valid range.
        expected: &'static str,
    },
}

/// Checks clips and returns their classes.
pub(crate) fn validated_classes(parts: &DatabaseParts) -> Result<Vec<Class>, DatabaseError> {
    if !(parts.rate_hz.is_finite() && parts.rate_hz >= 1.0 && parts.rate_hz <= 1000.0) {
        return Err(DatabaseError::Rate(parts.rate_hz));
    }
    if !parts.proportions.is_valid() {
        return Err(DatabaseError::Body);
    }
    if parts.clips.is_empty() {
        return Err(DatabaseError::NoClips);
    }
    if usize::from(parts.neutral) >= parts.styles.len() {
        return Err(DatabaseError::Neutral { neutral: parts.neutral, styles: parts.styles.len() });
    }
    if parts.counterparts_per_style == 0 || parts.counterparts_per_style > MAX_COUNTERPARTS {
        return Err(DatabaseError::Counterparts(parts.counterparts_per_style));
    }
    let mut classes: Vec<Class> = Vec::new();
    let mut rows = 0_usize;
    for (i, clip) in parts.clips.iter().enumerate() {
        if usize::from(clip.action) >= parts.actions.len() || usize::from(clip.style) >= parts.styles.len() {
            return Err(DatabaseError::Labels(clip.name.clone()));
        }
        if clip.first_frame != rows || clip.frames == 0 || clip.frames > MAX_FRAMES - rows {
            return Err(DatabaseError::Frames { clip: clip.name.clone(), first_frame: rows });
        }
        rows += clip.frames;
        match classes.last_mut() {
            Some(c) if (c.action, c.style) == (clip.action, clip.style) => {
                c.rows.end = rows;
                c.clips.end = i + 1;
            }
            last => {
                if last.is_some_and(|c| (c.action, c.style) > (clip.action, clip.style)) {
                    return Err(DatabaseError::Order(clip.name.clone()));
                }
                classes.push(Class {
                    action: clip.action,
                    style: clip.style,
                    rows: clip.first_frame..rows,
                    clips: i..i + 1,
                });
            }
        }
    }
    Ok(classes)
}

/// Checks the shape and every value of the tensors.
pub(super) fn validate_tensors(parts: &DatabaseParts) -> Result<(), DatabaseError> {
    let n = validate_short_tensors(parts)?;
    has_length("pose", parts.pose.len(), n)?;
    has_length("point_cloud", parts.point_cloud.len(), n)?;
    validate_poses(0, &parts.pose)?;
    validate_point_clouds(0, &parts.point_cloud)
}

/// Checks all tensors except poses and point clouds. Returns the number of rows.
pub(crate) fn validate_short_tensors(parts: &DatabaseParts) -> Result<usize, DatabaseError> {
    let n = parts.clips.last().map_or(0, |c| c.first_frame + c.frames);
    has_length("canonical_time", parts.canonical_time.len(), n)?;
    has_length("time_step", parts.time_step.len(), n)?;
    has_length("contact", parts.contact.len(), n)?;
    has_length("counterpart", parts.counterpart.len(), n * parts.styles.len() * parts.counterparts_per_style)?;
    for frame in 0..n {
        let (t, w) = (parts.canonical_time[frame], parts.time_step[frame]);
        if !t.is_finite() {
            return bad("canonical_time", frame, t, "a finite number");
        }
        if !(TIME_STEP_RANGE[0]..TIME_STEP_RANGE[1]).contains(&w) {
            return bad("time_step", frame, w, "a duration between 0.00001 and 10 s");
        }
        if let Some(&c) = parts.contact[frame].iter().find(|&&c| c > 1) {
            return bad("contact", frame, f32::from(c), "0 or 1");
        }
    }
    let per_frame = parts.styles.len() * parts.counterparts_per_style;
    let last_row = (n - 1) as f32;
    for (i, &c) in parts.counterpart.iter().enumerate() {
        if c != -1.0 && !(c >= 0.0 && c <= last_row) {
            return bad("counterpart", i / per_frame, c, "a row of the database, or −1");
        }
    }
    Ok(n)
}

/// Checks the poses of the rows from `first` on.
pub(crate) fn validate_poses(first: usize, poses: &[PoseRow]) -> Result<(), DatabaseError> {
    validate_rows("pose", first, poses, 1e4, "a number below 10 000")
}

/// Checks the point clouds of the rows from `first` on.
pub(crate) fn validate_point_clouds(first: usize, clouds: &[PointCloud]) -> Result<(), DatabaseError> {
    validate_rows("point_cloud", first, clouds, 1e3, "a position within 1 km")
}

fn validate_rows<T: NoUninit>(
    tensor: &'static str,
    first: usize,
    rows: &[T],
    limit: f32,
    expected: &'static str,
) -> Result<(), DatabaseError> {
    let found = rows.iter().zip(first..).find_map(|(row, frame)| {
        first_beyond(bytemuck::cast_slice(bytemuck::bytes_of(row)), limit).map(|v| (frame, v))
    });
    found.map_or(Ok(()), |(frame, v)| bad(tensor, frame, v, expected))
}

fn has_length(tensor: &'static str, found: usize, expected: usize) -> Result<(), DatabaseError> {
    if found == expected { Ok(()) } else { Err(DatabaseError::Shape { tensor, found, expected }) }
}

fn bad<T>(tensor: &'static str, frame: usize, value: f32, expected: &'static str) -> Result<T, DatabaseError> {
    Err(DatabaseError::Value { tensor, frame, value, expected })
}

/// First value that is NaN or whose absolute value is not below `limit`.
#[inline(never)] // In WebAssembly a function is optimised once it has been called often.
fn first_beyond(values: &[f32], limit: f32) -> Option<f32> {
    let within = |v: f32| v.abs() < limit;
    // Nearly all values are valid: without an early exit the loop is vectorised.
    if values.iter().fold(true, |good, &v| good & within(v)) {
        return None;
    }
    values.iter().copied().find(|&v| !within(v))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::database::Database;
    use crate::fixtures;

    /// Quotients of durations must not overflow.
    #[test]
    fn durations_must_be_ones_that_can_be_divided_by() {
        let with = |secs: f32| {
            let mut parts = DatabaseParts::clone(&fixtures::database());
            parts.time_step[5] = secs;
            Database::new(parts)
        };
        for bad in [f32::NAN, f32::INFINITY, -1.0, 0.0, f32::MIN_POSITIVE, 1e-38, 1e-6, 10.0] {
            let error = with(bad).expect_err("it is no duration");
            assert!(matches!(error, DatabaseError::Value { tensor: "time_step", frame: 5, .. }), "{bad}: {error}");
        }
        for good in [1e-4, 1.0 / 480.0, 1.0 / 60.0, 5.0] {
            assert!(with(good).is_ok(), "{good}");
        }
    }
}
