//! What is asked of a crowd ↔ flat arrays.

use crate::EngineError;
use strut_core::crowd::Vertex;

/// Longest motion that is written of one of a crowd, seconds.
const LONGEST_SECS: f32 = 600.0;

/// The vertices of a field: the number of a style, then x, z, reach (metres) and intensity for each.
///
/// # Errors
/// If there are not four numbers a style.
pub fn vertices_of_field(styles: &[u32], numbers: &[f32]) -> Result<Vec<Vertex>, EngineError> {
    let (numbers, rest) = numbers.as_chunks::<4>();
    if numbers.len() != styles.len() || !rest.is_empty() {
        return Err(EngineError::bad_input("four numbers a vertex were expected"));
    }
    let vertices = styles.iter().zip(numbers);
    Ok(vertices
        .map(|(style, &[x, z, reach, intensity])| Vertex { style: *style as usize, x, z, reach, intensity })
        .collect())
}

/// The points of a route, x and z of each.
///
/// # Errors
/// If one has no z.
pub fn points_of_route(numbers: &[f32]) -> Result<&[[f32; 2]], EngineError> {
    let (points, rest) = numbers.as_chunks::<2>();
    if rest.is_empty() { Ok(points) } else { Err(EngineError::bad_input("two numbers a point were expected")) }
}

/// Frames of a motion of so many seconds.
///
/// # Errors
/// If that is no time, or too long.
pub fn frames_of_crowd(secs: f32, rate_hz: f32) -> Result<usize, EngineError> {
    if secs > 0.0 && secs <= LONGEST_SECS {
        Ok((secs * rate_hz).ceil() as usize)
    } else {
        Err(EngineError::bad_input(format!("{secs} s were asked for; up to {LONGEST_SECS} were expected")))
    }
}
