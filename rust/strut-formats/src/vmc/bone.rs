//! Bones with Unity's names.

use crate::bvh::HUMANOID_NAMES;
use strut_core::humanoid::Role;

/// Number of bones that Strut uses: those of the canonical humanoid and the upper chest.
pub const BONES: usize = Role::ALL.len() + 1;

/// A bone of Unity's humanoid that has a role in Strut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bone {
    /// Bone of a role.
    Of(Role),
    /// `UpperChest`, between chest and neck. If it is sent, it has the role of the chest.
    UpperChest,
}

impl Bone {
    /// All bones, parents first.
    pub fn all() -> impl Iterator<Item = Bone> {
        let [trunk, others] = [0..Role::Neck.index(), Role::Neck.index()..Role::ALL.len()];
        let of = |roles: std::ops::Range<usize>| roles.map(|i| Bone::Of(Role::ALL[i]));
        of(trunk).chain([Bone::UpperChest]).chain(of(others))
    }

    /// Index in arrays of [`BONES`].
    pub const fn index(self) -> usize {
        match self {
            Self::Of(role) => role.index(),
            Self::UpperChest => BONES - 1,
        }
    }

    /// Parent bone.
    pub const fn parent(self) -> Option<Bone> {
        match self {
            Self::UpperChest => Some(Self::Of(Role::Chest)),
            Self::Of(role) => match role.parent() {
                Some(Role::Chest) => Some(Self::UpperChest),
                Some(parent) => Some(Self::Of(parent)),
                None => None,
            },
        }
    }

    /// Role whose motion it represents.
    pub const fn role(self) -> Role {
        match self {
            Self::Of(role) => role,
            Self::UpperChest => Role::Chest,
        }
    }

    /// Unity's name (`HumanBodyBones`).
    pub const fn name(self) -> &'static str {
        match self {
            Self::Of(role) => HUMANOID_NAMES[role.index()],
            Self::UpperChest => "UpperChest",
        }
    }

    /// Bone of Unity's name; `None` for fingers, eyes and others without a role.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::all().find(|bone| bone.name() == name)
    }
}
