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

/// Methods that the handles of crowds have in common, for a struct whose field `crowd` is a crowd. The module imports
/// `EngineError` and `wasm_bindgen`.
#[cfg(any(feature = "crowd", feature = "performers"))]
macro_rules! crowd_handle {
    ($handle:ident) => {
        #[wasm_bindgen]
        impl $handle {
            /// Advances by one frame.
            pub fn tick(&mut self) {
                self.crowd.tick();
            }

            /// Writes the joints of all agents, 21 × (x y z 0, rotation x y z w) in the world, and their style weights,
            /// one byte per agent and style.
            ///
            /// # Errors
            /// If an array has another length.
            pub fn read(&self, joints: &js_sys::Float32Array, weights: &js_sys::Uint8Array) -> Result<(), EngineError> {
                if weights.length() as usize != self.crowd.weights().len() {
                    return Err(EngineError::bad_input("one weight per agent and style was expected"));
                }
                weights.copy_from(self.crowd.weights());
                crate::common::write_floats(self.crowd.world(), joints)
            }

            /// Returns the radius of the ground, metres.
            pub fn radius(&self) -> f32 {
                self.crowd.radius()
            }

            /// Sets the number of agents.
            ///
            /// # Errors
            /// If there are too few or too many.
            #[wasm_bindgen(js_name = setCount)]
            pub fn set_count(&mut self, count: usize) -> Result<(), EngineError> {
                self.crowd.set_count(count).map_err(EngineError::bad_input)
            }

            /// Sets the style map, which applies from each agent's next step on: the index of each style, then x, z,
            /// radius (metres) and intensity of each.
            ///
            /// # Errors
            /// If there are too many vertices, or one is invalid; nothing changes then.
            #[wasm_bindgen(js_name = setField)]
            pub fn set_field(&mut self, styles: &[u32], numbers: &[f32]) -> Result<(), EngineError> {
                self.crowd
                    .set_field(&crate::common::vertices_of_field(styles, numbers)?)
                    .map_err(EngineError::bad_input)
            }

            /// Sets the route that all agents follow, x and z of its points; an empty one removes it.
            ///
            /// # Errors
            /// If there is one point, or too many, or one is invalid; nothing changes then.
            #[wasm_bindgen(js_name = setRoute)]
            pub fn set_route(&mut self, numbers: &[f32]) -> Result<(), EngineError> {
                self.crowd.set_route(crate::common::points_of_route(numbers)?).map_err(EngineError::bad_input)
            }

            /// Sets the bone offsets of the written joints, 21 × xyz in metres, in place of the agents' own.
            ///
            /// # Errors
            /// If there are not 63 numbers, or one is invalid; nothing changes then.
            #[wasm_bindgen(js_name = setBones)]
            pub fn set_bones(&mut self, offsets: &[f32]) -> Result<(), EngineError> {
                let bones = crate::common::proportions_of(offsets)?;
                self.crowd.set_bones(bones).map_err(EngineError::bad_input)
            }
        }
    };
}
#[cfg(any(feature = "crowd", feature = "performers"))]
pub(crate) use crowd_handle;
