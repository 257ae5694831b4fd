//! Parameters of crowds as flat arrays.

use crate::common::EngineError;
use strut_core::crowd::Vertex;

/// Longest motion of a crowd member that is written to a file, seconds.
const LONGEST_SECS: f32 = 600.0;

/// Reads the vertices of a style map: the index of each style, then x, z, radius (metres) and intensity of each.
///
/// # Errors
/// If there are not four numbers per style.
pub fn vertices_of_field(styles: &[u32], numbers: &[f32]) -> Result<Vec<Vertex>, EngineError> {
    let (numbers, rest) = numbers.as_chunks::<4>();
    if numbers.len() != styles.len() || !rest.is_empty() {
        return Err(EngineError::bad_input("four numbers per vertex were expected"));
    }
    let vertices = styles.iter().zip(numbers);
    Ok(vertices
        .map(|(style, &[x, z, reach, intensity])| Vertex { style: *style as usize, x, z, reach, intensity })
        .collect())
}

/// Reads the points of a route, x and z each.
///
/// # Errors
/// If a point has no z.
pub fn points_of_route(numbers: &[f32]) -> Result<&[[f32; 2]], EngineError> {
    let (points, rest) = numbers.as_chunks::<2>();
    if rest.is_empty() { Ok(points) } else { Err(EngineError::bad_input("two numbers per point were expected")) }
}

/// Returns the number of frames of a motion with this duration.
///
/// # Errors
/// If the duration is not finite, or too long.
pub fn frames_of_crowd(secs: f32, rate_hz: f32) -> Result<usize, EngineError> {
    if secs > 0.0 && secs <= LONGEST_SECS {
        Ok((secs * rate_hz).ceil() as usize)
    } else {
        Err(EngineError::bad_input(format!("{secs} s were requested; up to {LONGEST_SECS} were expected")))
    }
}
