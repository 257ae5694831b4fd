//! Evidence in a joint's name for its role.
//!
//! Covers the names of CMU and Xia, Bandai Namco, Mixamo, 3ds Max Biped, VRM and glTF, 100STYLE, LAFAN, Xsens, Rokoko, SMPL,
//! Unreal, Rigify, Daz, Character Creator, MMD and others (the tables in `find_roles/tests.rs`), for any case, prefix and
//! separator. A name is evidence, not proof: `LeftShoulder` is a clavicle in one convention and the upper arm in another, so
//! each word has weights for roles, and `find_roles` picks the best consistent chain.

use crate::humanoid::Role;
use std::borrow::Cow;

/// Side of the body in a name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// Towards +X when facing +Z.
    Left,
    /// Towards −X.
    Right,
}

/// Part of the body that a role belongs to, on either side.
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
    /// Role of a limb's part on this side; the trunk is not found by names only.
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

/// Words without side, digits and separators → parts and how strongly the word indicates them (0 to 1).
const WORDS: &[(&str, &[(Part, f32)])] = &[
    ("hips", &[(Part::Hips, 1.0)]),
    ("pelvis", &[(Part::Hips, 1.0)]),
    ("hip", &[(Part::Hips, 0.9), (Part::UpperLeg, 0.8)]),
    ("lowertorso", &[(Part::Hips, 0.8)]),
    ("腰", &[(Part::Hips, 0.8)]),
    ("spine", &[(Part::Trunk, 1.0)]),
    ("torso", &[(Part::Trunk, 0.9)]),
    ("uppertorso", &[(Part::Trunk, 0.9)]),
    ("abdomen", &[(Part::Trunk, 0.9)]),
    ("abdomenlower", &[(Part::Trunk, 0.9)]),
    ("abdomenupper", &[(Part::Trunk, 0.9)]),
    ("lowerback", &[(Part::Trunk, 0.9)]),
    ("upperback", &[(Part::Trunk, 0.9)]),
    ("back", &[(Part::Trunk, 0.8)]),
    ("waist", &[(Part::Trunk, 0.6)]),
    ("chest", &[(Part::Trunk, 1.0)]),
    ("upperchest", &[(Part::Trunk, 1.0)]),
    ("chestlower", &[(Part::Trunk, 1.0)]),
    ("chestupper", &[(Part::Trunk, 1.0)]),
    ("thorax", &[(Part::Trunk, 1.0)]),
    ("upperbody", &[(Part::Trunk, 1.0)]),
    ("上半身", &[(Part::Trunk, 1.0)]),
    ("jouhanshin", &[(Part::Trunk, 1.0)]),
    ("neck", &[(Part::Neck, 1.0)]),
    ("lowerneck", &[(Part::Neck, 1.0)]),
    ("upperneck", &[(Part::Neck, 1.0)]),
    ("necklower", &[(Part::Neck, 1.0)]),
    ("neckupper", &[(Part::Neck, 1.0)]),
    ("首", &[(Part::Neck, 1.0)]),
    ("kubi", &[(Part::Neck, 1.0)]),
    ("head", &[(Part::Head, 1.0)]),
    ("skull", &[(Part::Head, 0.8)]),
    ("頭", &[(Part::Head, 1.0)]),
    ("atama", &[(Part::Head, 1.0)]),
    ("clavicle", &[(Part::Shoulder, 1.0)]),
    ("clav", &[(Part::Shoulder, 1.0)]),
    ("collar", &[(Part::Shoulder, 1.0)]),
    ("collarbone", &[(Part::Shoulder, 1.0)]),
    ("scapula", &[(Part::Shoulder, 0.9)]),
    ("shoulder", &[(Part::Shoulder, 0.9), (Part::UpperArm, 0.5)]),
    ("肩", &[(Part::Shoulder, 0.9), (Part::UpperArm, 0.5)]),
    ("kata", &[(Part::Shoulder, 0.9), (Part::UpperArm, 0.5)]),
    ("upperarm", &[(Part::UpperArm, 1.0)]),
    ("armupper", &[(Part::UpperArm, 1.0)]),
    ("uparm", &[(Part::UpperArm, 1.0)]),
    ("uarm", &[(Part::UpperArm, 1.0)]),
    ("shldr", &[(Part::UpperArm, 1.0)]),
    ("humerus", &[(Part::UpperArm, 1.0)]),
    ("arm", &[(Part::UpperArm, 0.9), (Part::LowerArm, 0.2)]),
    ("腕", &[(Part::UpperArm, 0.9), (Part::LowerArm, 0.2)]),
    ("ude", &[(Part::UpperArm, 0.9), (Part::LowerArm, 0.2)]),
    ("lowerarm", &[(Part::LowerArm, 1.0)]),
    ("armlower", &[(Part::LowerArm, 1.0)]),
    ("lowarm", &[(Part::LowerArm, 1.0)]),
    ("loarm", &[(Part::LowerArm, 1.0)]),
    ("forearm", &[(Part::LowerArm, 1.0)]),
    ("farm", &[(Part::LowerArm, 1.0)]),
    ("elbow", &[(Part::LowerArm, 1.0)]),
    ("radius", &[(Part::LowerArm, 1.0)]),
    ("ulna", &[(Part::LowerArm, 0.9)]),
    ("ひじ", &[(Part::LowerArm, 1.0)]),
    ("肘", &[(Part::LowerArm, 1.0)]),
    ("hiji", &[(Part::LowerArm, 1.0)]),
    ("hand", &[(Part::Hand, 1.0)]),
    ("wrist", &[(Part::Hand, 1.0)]),
    ("handwrist", &[(Part::Hand, 1.0)]),
    ("手首", &[(Part::Hand, 1.0)]),
    ("tekubi", &[(Part::Hand, 1.0)]),
    ("upperleg", &[(Part::UpperLeg, 1.0)]),
    ("legupper", &[(Part::UpperLeg, 1.0)]),
    ("upleg", &[(Part::UpperLeg, 1.0)]),
    ("uleg", &[(Part::UpperLeg, 1.0)]),
    ("thigh", &[(Part::UpperLeg, 1.0)]),
    ("femur", &[(Part::UpperLeg, 1.0)]),
    ("leg", &[(Part::LowerLeg, 0.8), (Part::UpperLeg, 0.3)]),
    ("足", &[(Part::UpperLeg, 0.9)]),
    ("脚", &[(Part::UpperLeg, 0.9)]),
    ("ashi", &[(Part::UpperLeg, 0.9)]),
    ("lowerleg", &[(Part::LowerLeg, 1.0)]),
    ("leglower", &[(Part::LowerLeg, 1.0)]),
    ("lowleg", &[(Part::LowerLeg, 1.0)]),
    ("loleg", &[(Part::LowerLeg, 1.0)]),
    ("shin", &[(Part::LowerLeg, 1.0)]),
    ("shank", &[(Part::LowerLeg, 1.0)]),
    ("calf", &[(Part::LowerLeg, 1.0)]),
    ("knee", &[(Part::LowerLeg, 1.0)]),
    ("tibia", &[(Part::LowerLeg, 1.0)]),
    ("ひざ", &[(Part::LowerLeg, 1.0)]),
    ("膝", &[(Part::LowerLeg, 1.0)]),
    ("hiza", &[(Part::LowerLeg, 1.0)]),
    ("ankle", &[(Part::Foot, 1.0)]),
    ("footankle", &[(Part::Foot, 1.0)]),
    ("foot", &[(Part::Foot, 0.9), (Part::Toes, 0.2)]),
    ("足首", &[(Part::Foot, 1.0)]),
    ("ashikubi", &[(Part::Foot, 1.0)]),
    ("toe", &[(Part::Toes, 1.0)]),
    ("toes", &[(Part::Toes, 1.0)]),
    ("toebase", &[(Part::Toes, 1.0)]),
    ("toesbase", &[(Part::Toes, 1.0)]),
    ("forefoot", &[(Part::Toes, 0.9)]),
    ("ball", &[(Part::Toes, 0.9)]),
    ("football", &[(Part::Toes, 0.9)]),
    ("つま先", &[(Part::Toes, 1.0)]),
    ("爪先", &[(Part::Toes, 1.0)]),
    ("tsumasaki", &[(Part::Toes, 1.0)]),
];

/// Prefixes of rigs, and words that mark any joint, or the upper of a pair of bones that bend and twist.
const FILLERS: &[&str] = &[
    "mixamorig",
    "bip",
    "j",
    "c",
    "m",
    "x",
    "cc",
    "rl",
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
    // Daz splits its limbs: `ThighBend` moves the thigh, `ThighTwist` only rotates its skin.
    "bend",
    "stretch",
    "rig",
    "sk",
    "skel",
    "jt",
    "avatar",
    "root",
    "human",
    "humanoid",
    "main",
];

/// Words of joints without a role, even if another word of their name has one.
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
    "part",
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
    "dummy",
    "null",
    "socket",
    "attach",
    "corrective",
    "volume",
    "muscle",
    "armor",
    "armour",
    "pad",
    "jiggle",
    "collider",
    "breast",
    "hair",
    "skirt",
    "prop",
    "weapon",
    "share",
    "tail",
    "fk",
    "mch",
    "org",
    "ear",
    "nose",
    "brow",
    "lip",
    "fix",
    "locator",
    "metatarsal",
    "metatarsals",
    "carpal",
    "heel",
    "pectoral",
    "latissimus",
    // The limbs of animals, which have two pairs of legs.
    "front",
    "hind",
    "rear",
    "捩",
];

/// Words that name the limb, before one that names its part (`L_Leg_Knee`).
const LIMBS: &[&str] = &["leg", "arm"];

/// Parts of a palm in a skeleton without hands.
const PALM: &[(Part, f32)] = &[(Part::Hand, 0.8)];

/// A word in at least this share of a skeleton's names is ignored.
const COMMON: f32 = 0.6;

/// Evidence in a name.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct NameHint {
    /// Side, if the name contains one.
    pub(super) side: Option<Side>,
    /// Whether the name marks a joint without a role: twist bones, fingers, ends and the like.
    pub(super) is_other: bool,
    parts: Cow<'static, [(Part, f32)]>,
}

impl NameHint {
    /// Reads the names of a skeleton's joints. Words that nearly all of them have in common (the performer's name, the type
    /// of rig) are ignored.
    pub(super) fn of_all(names: &[&str]) -> Vec<Self> {
        let words: Vec<Vec<String>> = names.iter().map(|name| words_of(name)).collect();
        let enough = COMMON * names.len() as f32;
        let has = |word: &String| words.iter().filter(|w| w.contains(word)).count() as f32;
        let mut common: Vec<String> = Vec::new();
        // A word that most names contain is in one of the first half of them.
        for word in words.iter().take(names.len().div_ceil(2)).flatten() {
            let known = side_of(word).is_some() || look_up(word).is_some();
            if names.len() > 4 && !known && !common.contains(word) && has(word) >= enough {
                common.push(word.clone());
            }
        }
        let mut hints: Vec<Self> =
            words.iter().map(|words| Self::of_words(words.iter().filter(|w| !common.contains(w)))).collect();
        // If no name contains a hand, palms are hands.
        if hints.iter().all(|hint| hint.weight(Part::Hand) == 0.0) {
            for (hint, words) in hints.iter_mut().zip(&words) {
                let mut palm = Self::of_words(words.iter().filter(|w| *w != "palm" && !common.contains(w)));
                if !palm.is_other && palm.parts.is_empty() && words.iter().any(|w| w == "palm") {
                    palm.parts = Cow::Borrowed(PALM);
                    *hint = palm;
                }
            }
        }
        hints
    }

    /// Reads a single name.
    #[cfg(test)]
    pub(super) fn of(name: &str) -> Self {
        Self::of_words(words_of(name).iter())
    }

    fn of_words<'a>(words: impl Iterator<Item = &'a String>) -> Self {
        let mut side = None;
        let mut rest: Vec<&str> = Vec::new();
        let mut is_other = false;
        for word in words {
            match word.as_str() {
                w if side_of(w).is_some() => side = side_of(w),
                w if OTHERS.contains(&w) => is_other = true,
                w if FILLERS.contains(&w) => {}
                w => rest.push(w),
            }
        }
        let nothing = Self { side, is_other, parts: Cow::Borrowed(&[]) };
        if is_other {
            return nothing;
        }
        let whole = rest.concat();
        if let Some(parts) = look_up(&whole) {
            return Self { parts: Cow::Borrowed(parts), ..nothing };
        }
        for (prefix, glued_side) in
            [("left", Side::Left), ("right", Side::Right), ("l", Side::Left), ("r", Side::Right)]
        {
            let bare = whole.strip_prefix(prefix).or_else(|| whole.strip_suffix(prefix).filter(|_| prefix.len() > 1));
            if let Some(parts) = bare.and_then(look_up) {
                return Self { side: side.or(Some(glued_side)), parts: Cow::Borrowed(parts), ..nothing };
            }
        }
        let [limb, part @ ..] = rest.as_slice() else { return nothing };
        match look_up(&part.concat()) {
            Some(parts) if LIMBS.contains(limb) => Self { parts: of_limb(limb, parts), ..nothing },
            _ => nothing,
        }
    }

    /// How strongly the name indicates this part, 0 to 1.
    pub(super) fn weight(&self, part: Part) -> f32 {
        self.parts.iter().find(|(p, _)| *p == part).map_or(0.0, |(_, w)| *w)
    }
}

/// Restricts the parts of a word to those of a limb: the hip of a leg is not the pelvis.
fn of_limb(limb: &str, parts: &[(Part, f32)]) -> Cow<'static, [(Part, f32)]> {
    let of_leg = |part: Part| matches!(part, Part::UpperLeg | Part::LowerLeg | Part::Foot | Part::Toes);
    let of_arm = |part: Part| matches!(part, Part::Shoulder | Part::UpperArm | Part::LowerArm | Part::Hand);
    let fits = |part: Part| if limb == "leg" { of_leg(part) } else { of_arm(part) };
    Cow::Owned(parts.iter().copied().filter(|(part, _)| fits(*part)).collect())
}

fn side_of(word: &str) -> Option<Side> {
    match word {
        "left" | "l" | "lft" | "lt" | "lf" | "左" | "hidari" => Some(Side::Left),
        "right" | "r" | "rgt" | "rt" | "右" | "migi" => Some(Side::Right),
        _ => None,
    }
}

fn look_up(word: &str) -> Option<&'static [(Part, f32)]> {
    let find = |word: &str| WORDS.iter().find(|(w, _)| *w == word).map(|(_, parts)| *parts);
    // Some programs write the joints of a pair in the plural; `hips` is a separate word.
    find(word).or_else(|| word.strip_suffix('s').filter(|w| *w != "hip").and_then(find))
}

/// Lower-case words of a name: split at separators, digits and changes of case or script; a namespace before the name
/// (`mixamorig:`) and all digits are dropped.
fn words_of(name: &str) -> Vec<String> {
    let name = name.rsplit([':', '|']).next().unwrap_or(name);
    let chars: Vec<char> = name.chars().map(half_width).collect();
    let mut words = vec![String::new()];
    for (i, &c) in chars.iter().enumerate() {
        let begins_word = i > 0 && {
            let (before, after) = (chars[i - 1], chars.get(i + 1));
            let camel = c.is_ascii_uppercase()
                && (before.is_ascii_lowercase()
                    || before.is_ascii_uppercase() && after.is_some_and(char::is_ascii_lowercase));
            // Japanese names have no separator at the characters for the side and for twist.
            let sign = |c: char| matches!(c, '左' | '右' | '捩');
            camel || c.is_ascii() != before.is_ascii() || sign(c) || sign(before)
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

/// The ASCII character of a full-width one (`ＩＫ`).
fn half_width(c: char) -> char {
    let ascii = u32::from(c).checked_sub(0xFF01 - 0x21).filter(|code| (0x21..0x7F).contains(code));
    ascii.and_then(char::from_u32).unwrap_or(c)
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
            "lThighBend",
            "L_Leg_Hip_jnt",
            "mHipLeft",
            "左足",
            "足.L",
            "thigh_stretch.l",
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
    fn palms_are_hands_where_there_are_none() {
        let hands = |names: &[&str]| NameHint::of_all(names).iter().filter(|h| h.weight(Part::Hand) > 0.0).count();
        assert_eq!(hands(&["Body", "LowerArmL", "Palm2L", "ThumbL", "LowerArmR", "Palm2R"]), 2);
        assert_eq!(hands(&["hand.L", "palm.01.L", "palm.02.L", "hand.R", "palm.01.R"]), 2);
    }

    #[test]
    fn fingers_twist_bones_and_ends_have_no_role() {
        for name in [
            "LeftHandIndex1",
            "LThumb",
            "Bip01 L Finger0",
            "LeftForeArmTwist",
            "HeadTop_End",
            "foot_ik.L",
            "x",
            "左足ＩＫ",
            "左腕捩",
            "CC_Base_L_KneeShareBone",
        ] {
            assert_eq!(strongest(name), None, "{name}");
        }
    }
}
