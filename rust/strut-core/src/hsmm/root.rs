//! The path of the root (`docs/methods/hsmm.md` §11): the model determines the supporting foot.

use super::model::Side;
use crate::root_path::Support;

pub(super) use crate::root_path::RootPath;

impl From<Side> for Support {
    /// The foot that does not swing.
    fn from(swinging: Side) -> Self {
        Self::On(swinging.other() as usize)
    }
}
