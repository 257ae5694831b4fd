//! Evidence in a joint's name for its role.
//!
//! Covers the names of CMU and Xia, Bandai Namco, Mixamo, 3ds Max Biped, VRM and glTF, 100STYLE, LAFAN,
//! Xsens, Rokoko, SMPL, Unreal, Rigify and Daz, whatever their case, prefix and separator. A name is
//! evidence, not proof: `LeftShoulder` is a clavicle in one convention and the upper arm in another, so
//! each word carries weights for roles, and `find_roles` picks the best consistent chain.

use crate::humanoid::Role;

/// Side of the body that a name gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// Towards +X when facing +Z.
    Left,
    /// Towards −X.
    Right,
}

/// Part of the body that a role belongs to, whatever the side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Hips,
    Trunk,
    Neck,
    Head,
    Shoulder,
    UpperArm,
    LowerArm,
    Hand,
    UpperLeg,
    LowerLeg,
    Foot,
    Toes,
}

impl Part {
    /// Role of a limb's part on this side; the trunk is not found by names alone.
    pub(super) fn on(self, side: Side) -> Role {
        let left = match self {
            Part::Hips => Role::Hips,
            Part::Trunk => Role::Spine,
            Part::Neck => Role::Neck,
            Part::Head => Role::Head,
            Part::Shoulder => Role::LeftShoulder,
            Part::UpperArm => Role::LeftUpperArm,
            Part::LowerArm => Role::LeftLowerArm,
            Part::Hand => Role::LeftHand,
            Part::UpperLeg => Role::LeftUpperLeg,
            Part::LowerLeg => Role::LeftLowerLeg,
            Part::Foot => Role::LeftFoot,
            Part::Toes => Role::LeftToes,
        };
        if side == Side::Left { left } else { left.mirrored() }
    }
}

/// Words without side, digits and separators → parts and how strongly the word means them (0 to 1).
const WORDS: &[(&str, &[(Part, f32)])] = &[
    ("hips", &[(Part::Hips, 1.0)]),
    ("pelvis", &[(Part::Hips, 1.0)]),
    ("hip", &[(Part::Hips, 0.9), (Part::UpperLeg, 0.8)]),
    ("spine", &[(Part::Trunk, 1.0)]),
    ("torso", &[(Part::Trunk, 0.9)]),
    ("abdomen", &[(Part::Trunk, 0.9)]),
    ("lowerback", &[(Part::Trunk, 0.9)]),
    ("upperback", &[(Part::Trunk, 0.9)]),
    ("back", &[(Part::Trunk, 0.8)]),
    ("waist", &[(Part::Trunk, 0.6)]),
    ("chest", &[(Part::Trunk, 1.0)]),
    ("upperchest", &[(Part::Trunk, 1.0)]),
    ("thorax", &[(Part::Trunk, 1.0)]),
    ("neck", &[(Part::Neck, 1.0)]),
    ("lowerneck", &[(Part::Neck, 1.0)]),
    ("upperneck", &[(Part::Neck, 1.0)]),
    ("head", &[(Part::Head, 1.0)]),
    ("skull", &[(Part::Head, 0.8)]),
    ("clavicle", &[(Part::Shoulder, 1.0)]),
    ("collar", &[(Part::Shoulder, 1.0)]),
    ("collarbone", &[(Part::Shoulder, 1.0)]),
    ("shoulder", &[(Part::Shoulder, 0.9), (Part::UpperArm, 0.5)]),
    ("upperarm", &[(Part::UpperArm, 1.0)]),
    ("uparm", &[(Part::UpperArm, 1.0)]),
    ("shldr", &[(Part::UpperArm, 1.0)]),
    ("humerus", &[(Part::UpperArm, 1.0)]),
    ("arm", &[(Part::UpperArm, 0.9), (Part::LowerArm, 0.2)]),
    ("lowerarm", &[(Part::LowerArm, 1.0)]),
    ("lowarm", &[(Part::LowerArm, 1.0)]),
    ("forearm", &[(Part::LowerArm, 1.0)]),
    ("elbow", &[(Part::LowerArm, 1.0)]),
    ("radius", &[(Part::LowerArm, 1.0)]),
    ("hand", &[(Part::Hand, 1.0)]),
    ("wrist", &[(Part::Hand, 1.0)]),
    ("upperleg", &[(Part::UpperLeg, 1.0)]),
    ("upleg", &[(Part::UpperLeg, 1.0)]),
    ("thigh", &[(Part::UpperLeg, 1.0)]),
    ("femur", &[(Part::UpperLeg, 1.0)]),
    ("leg", &[(Part::LowerLeg, 0.8), (Part::UpperLeg, 0.3)]),
    ("lowerleg", &[(Part::LowerLeg, 1.0)]),
    ("lowleg", &[(Part::LowerLeg, 1.0)]),
    ("shin", &[(Part::LowerLeg, 1.0)]),
    ("calf", &[(Part::LowerLeg, 1.0)]),
    ("knee", &[(Part::LowerLeg, 1.0)]),
    ("tibia", &[(Part::LowerLeg, 1.0)]),
    ("ankle", &[(Part::Foot, 1.0)]),
    ("foot", &[(Part::Foot, 0.9), (Part::Toes, 0.2)]),
    ("toe", &[(Part::Toes, 1.0)]),
    ("toes", &[(Part::Toes, 1.0)]),
    ("toebase", &[(Part::Toes, 1.0)]),
    ("toesbase", &[(Part::Toes, 1.0)]),
    ("forefoot", &[(Part::Toes, 0.9)]),
    ("football", &[(Part::Toes, 0.9)]),
    ("shoulders", &[(Part::Shoulder, 0.9), (Part::UpperArm, 0.5)]),
    ("scapula", &[(Part::Shoulder, 0.8)]),
    ("ulna", &[(Part::LowerArm, 0.9)]),
    // MikuMikuDance; what stands for the side is cut off before.
    ("腰", &[(Part::Hips, 1.0)]),
    ("上半身", &[(Part::Trunk, 1.0)]),
    ("首", &[(Part::Neck, 1.0)]),
    ("頭", &[(Part::Head, 1.0)]),
    ("肩", &[(Part::Shoulder, 1.0)]),
    ("腕", &[(Part::UpperArm, 1.0)]),
    ("ひじ", &[(Part::LowerArm, 1.0)]),
    ("手首", &[(Part::Hand, 1.0)]),
    ("足", &[(Part::UpperLeg, 1.0)]),
    ("ひざ", &[(Part::LowerLeg, 1.0)]),
    ("足首", &[(Part::Foot, 1.0)]),
    ("つま先", &[(Part::Toes, 1.0)]),
    ("ball", &[(Part::Toes, 0.9)]),
];

/// Prefixes of rigs, and words that mean only that this is a joint.
const FILLERS: &[&str] = &[
    "mixamorig",
    "bip",
    "j",
    "c",
    "cc",
    "base",
    "valve",
    "biped",
    "character",
    "armature",
    "def",
    "joint",
    "jnt",
    "bone",
    "bind",
    "rig",
    "sk",
    "skel",
    "jt",
    // Daz halves its limbs: `ThighBend` moves the thigh, `ThighTwist` only turns its skin.
    "bend",
    "m",
    "avatar",
    "root",
    "human",
    "humanoid",
    "main",
];

/// Words of joints that have no role, even where another word of their name has one.
const OTHERS: &[&str] = &[
    "thumb",
    "index",
    "middle",
    "ring",
    "pinky",
    "little",
    "finger",
    "fingers",
    "metacarpal",
    "palm",
    "twist",
    "roll",
    "eye",
    "eyes",
    "jaw",
    "tongue",
    "ik",
    "pole",
    "ctrl",
    "target",
    "nub",
    "end",
    "tip",
    "top",
    "site",
    "effector",
    "helper",
    "breast",
    "hair",
    "skirt",
    "prop",
    "weapon",
    "share",
    "tail",
    "fk",
    "ear",
    "nose",
    "brow",
    "lip",
    "volume",
    "muscle",
    "corrective",
    "fix",
    "null",
    "locator",
    "metatarsal",
    "metatarsals",
    "carpal",
    "heel",
    "pectoral",
    "latissimus",
];

/// Evidence in a name.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct NameHint {
    /// Side, where the name gives one.
    pub(super) side: Option<Side>,
    parts: &'static [(Part, f32)],
}

impl NameHint {
    /// Reads a joint's name.
    pub(super) fn of(name: &str) -> Self {
        let words = words_of(name);
        let mut side = None;
        let mut rest = String::new();
        let mut other = false;
        for word in words {
            match word.as_str() {
                "left" | "l" | "lft" | "lt" => side = Some(Side::Left),
                "right" | "r" | "rgt" | "rt" => side = Some(Side::Right),
                w if OTHERS.contains(&w) => other = true,
                w if FILLERS.contains(&w) => {}
                w => rest.push_str(w),
            }
        }
        if other {
            return Self { side, parts: &[] };
        }
        if let Some(parts) = look_up(&rest) {
            return Self { side, parts };
        }
        for (prefix, glued_side) in [
            ("left", Side::Left),
            ("right", Side::Right),
            ("左", Side::Left),
            ("右", Side::Right),
            ("l", Side::Left),
            ("r", Side::Right),
        ] {
            let bare = rest.strip_prefix(prefix).or_else(|| rest.strip_suffix(prefix).filter(|_| prefix.len() > 1));
            if let Some(parts) = bare.and_then(look_up) {
                return Self { side: side.or(Some(glued_side)), parts };
            }
        }
        Self { side, parts: &[] }
    }

    /// How strongly the name means this part, 0 to 1.
    pub(super) fn weight(&self, part: Part) -> f32 {
        self.parts.iter().find(|(p, _)| *p == part).map_or(0.0, |(_, w)| *w)
    }
}

fn look_up(word: &str) -> Option<&'static [(Part, f32)]> {
    WORDS.iter().find(|(w, _)| *w == word).map(|(_, parts)| *parts)
}

/// Lower-case words of a name: split at separators, digits and changes of case; what a namespace
/// (`mixamorig:`) puts before the name and all digits are dropped.
fn words_of(name: &str) -> Vec<String> {
    let name = name.rsplit([':', '|']).next().unwrap_or(name);
    let chars: Vec<char> = name.chars().collect();
    let mut words = vec![String::new()];
    for (i, &c) in chars.iter().enumerate() {
        let begins_word = c.is_ascii_uppercase() && i > 0 && {
            let after_lower = chars[i - 1].is_ascii_lowercase();
            let before_lower = chars.get(i + 1).is_some_and(char::is_ascii_lowercase);
            after_lower || (chars[i - 1].is_ascii_uppercase() && before_lower)
        };
        if begins_word || !c.is_alphabetic() {
            words.push(String::new());
        }
        if c.is_alphabetic()
            && let Some(word) = words.last_mut()
        {
            word.push(c.to_ascii_lowercase());
        }
    }
    words.retain(|w| !w.is_empty());
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strongest(name: &str) -> Option<(Option<Side>, Part)> {
        let hint = NameHint::of(name);
        hint.parts.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(p, _)| (hint.side, *p))
    }

    #[test]
    fn reads_the_thigh_in_every_convention() {
        let left = [
            "LeftUpLeg",
            "mixamorig:LeftUpLeg",
            "mixamorigLeftUpLeg",
            "Bip01 L Thigh",
            "Bip001_L_Thigh",
            "UpperLeg_L",
            "J_Bip_L_UpperLeg",
            "leftUpperLeg",
            "LeftThigh",
            "thigh_l",
            "thigh.L",
            "DEF-thigh.L",
            "lThigh",
            "lfemur",
            "LEFT_UPLEG",
            "leftupleg",
            "ValveBiped.Bip01_L_Thigh",
            "CC_Base_L_Thigh",
            "character1:LeftUpLeg",
            "L_Hip",
        ];
        for name in left {
            let hint = NameHint::of(name);
            assert_eq!(hint.side, Some(Side::Left), "{name}");
            assert!(hint.weight(Part::UpperLeg) >= 0.8, "{name}");
        }
        assert_eq!(strongest("RightThigh"), Some((Some(Side::Right), Part::UpperLeg)));
        assert_eq!(strongest("rThigh"), Some((Some(Side::Right), Part::UpperLeg)));
    }

    #[test]
    fn reads_other_parts() {
        for (name, side, part) in [
            ("Hips", None, Part::Hips),
            ("Bip01 Pelvis", None, Part::Hips),
            ("LeftToeBase", Some(Side::Left), Part::Toes),
            ("Bip01 R Toe0", Some(Side::Right), Part::Toes),
            ("ball_r", Some(Side::Right), Part::Toes),
            ("RightForeArm", Some(Side::Right), Part::LowerArm),
            ("rShldr", Some(Side::Right), Part::UpperArm),
            ("lradius", Some(Side::Left), Part::LowerArm),
            ("Neck1", None, Part::Neck),
            ("J_Bip_C_Head", None, Part::Head),
            ("l_toebase_JNT", Some(Side::Left), Part::Toes),
            ("lShldrBend", Some(Side::Left), Part::UpperArm),
            ("rForearmBend", Some(Side::Right), Part::LowerArm),
            ("mKneeLeft", Some(Side::Left), Part::LowerLeg),
            ("右ひざ", Some(Side::Right), Part::LowerLeg),
            ("左足首", Some(Side::Left), Part::Foot),
        ] {
            assert_eq!(strongest(name), Some((side, part)), "{name}");
        }
    }

    #[test]
    fn fingers_twist_bones_and_ends_have_no_role() {
        for name in ["LeftHandIndex1", "LThumb", "Bip01 L Finger0", "LeftForeArmTwist", "HeadTop_End", "foot_ik.L", "x"]
        {
            assert_eq!(strongest(name), None, "{name}");
        }
    }
}
