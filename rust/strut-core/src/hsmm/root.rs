//! Where the body goes (specification, §11): the walk says which foot supports it.

use super::model::Side;
use crate::root_path::Support;

pub(super) use crate::root_path::RootPath;

impl From<Side> for Support {
    /// The foot that does not swing.
    fn from(swinging: Side) -> Self {
        Self::On(swinging.other() as usize)
    }
}
