//! A message: a bone, the root, the time, a style, or a message that is passed on.

use super::bone::Bone;
use super::place::{Place, RootPlace};
use rosc::{OscMessage, OscType};
use strut_core::math::{Quat, Vec3};
use strut_core::transfer::MAX_WEIGHT;

const BONE: &str = "/VMC/Ext/Bone/Pos";
const ROOT: &str = "/VMC/Ext/Root/Pos";
const TIME: &str = "/VMC/Ext/T";
const OK: &str = "/VMC/Ext/OK";
const STYLE: &str = "/strut/style";
/// Greatest valid coordinate, metres.
const MAX_COORDINATE: f32 = 1e4;
/// Range of squared lengths that count as a unit quaternion.
const SQUARED_LENGTH: std::ops::RangeInclusive<f32> = 0.25..=4.0;

/// A message that Strut interprets, or one that is passed on. Lengths in metres, in the axes of [`strut_core`].
#[derive(Clone, Debug, PartialEq)]
pub enum Message {
    /// A bone relative to its parent.
    Bone(Bone, Place),
    /// Position and rotation of the model.
    Root(RootPlace),
    /// The sender's time, seconds; it ends a frame.
    Time(f64),
    /// Whether the sender's model is loaded.
    Loaded(bool),
    /// Weight of a style.
    Style(String, f32),
    /// Expressions, fingers, eyes and all others.
    Other(OscMessage),
}

impl Message {
    /// Parses a message; `None` if arguments are missing, not finite, or texts in place of numbers. Extra arguments are
    /// ignored, as are those that are neither text nor number.
    pub(super) fn read(message: OscMessage) -> Option<Self> {
        if !matches!(message.addr.as_str(), BONE | ROOT | TIME | OK | STYLE) {
            return Some(Self::Other(message));
        }
        let args: Vec<Arg<'_>> = message.args.iter().filter_map(Arg::read).collect();
        match message.addr.as_str() {
            BONE => match (Bone::from_name(text(&args)?), place(args.get(1..)?)) {
                (Some(bone), place) => Some(Self::Bone(bone, place?)),
                (None, _) => Some(Self::Other(message)),
            },
            ROOT => {
                text(&args)?;
                let place = place(args.get(1..)?)?;
                Some(Self::Root(RootPlace { place, scale_and_offset: floats(args.get(8..).unwrap_or_default()) }))
            }
            TIME => {
                let [secs] = numbers(&args)?;
                Some(Self::Time(secs))
            }
            OK => {
                let [loaded] = numbers(&args)?;
                Some(Self::Loaded(loaded != 0.0))
            }
            _ => {
                let [weight] = floats(args.get(1..)?)?;
                (weight.abs() <= MAX_WEIGHT).then_some(Self::Style(text(&args)?.to_owned(), weight))
            }
        }
    }

    /// Encodes the message.
    pub(super) fn write(&self) -> OscMessage {
        let message = |addr: &str, args: Vec<OscType>| OscMessage { addr: addr.to_owned(), args };
        match self {
            Self::Bone(bone, place) => message(BONE, place_args(bone.name(), place)),
            Self::Root(root) => {
                let mut args = place_args("root", &root.place);
                args.extend(root.scale_and_offset.into_iter().flatten().map(OscType::Float));
                message(ROOT, args)
            }
            Self::Time(secs) => message(TIME, vec![OscType::Float(*secs as f32)]),
            Self::Loaded(loaded) => message(OK, vec![OscType::Int(i32::from(*loaded))]),
            Self::Style(name, weight) => message(STYLE, vec![OscType::String(name.clone()), OscType::Float(*weight)]),
            Self::Other(other) => other.clone(),
        }
    }
}

/// An argument that can be interpreted.
#[derive(Clone, Copy)]
enum Arg<'a> {
    Text(&'a str),
    Number(f64),
}

impl<'a> Arg<'a> {
    /// Senders use any number type of their language; true is 1, false and nil are 0.
    fn read(arg: &'a OscType) -> Option<Self> {
        match arg {
            OscType::String(text) => Some(Self::Text(text)),
            OscType::Float(value) => Some(Self::Number(f64::from(*value))),
            OscType::Double(value) => Some(Self::Number(*value)),
            OscType::Int(value) => Some(Self::Number(f64::from(*value))),
            OscType::Long(value) => Some(Self::Number(*value as f64)),
            OscType::Bool(value) => Some(Self::Number(f64::from(u8::from(*value)))),
            OscType::Nil => Some(Self::Number(0.0)),
            _ => None,
        }
    }
}

fn text<'a>(args: &[Arg<'a>]) -> Option<&'a str> {
    match args.first()? {
        Arg::Text(text) => Some(text),
        Arg::Number(_) => None,
    }
}

/// The first `N` numbers, all finite.
fn numbers<const N: usize>(args: &[Arg<'_>]) -> Option<[f64; N]> {
    let mut numbers = [0.0; N];
    for (number, arg) in numbers.iter_mut().zip(args.get(..N)?) {
        *number = match arg {
            Arg::Number(value) if value.is_finite() => *value,
            _ => return None,
        };
    }
    Some(numbers)
}

/// The first `N` numbers, all finite in single precision.
fn floats<const N: usize>(args: &[Arg<'_>]) -> Option<[f32; N]> {
    let floats = numbers(args)?.map(|number| number as f32);
    floats.iter().all(|number| number.is_finite()).then_some(floats)
}

/// Position and rotation from seven numbers in Unity's axes.
fn place(args: &[Arg<'_>]) -> Option<Place> {
    let [x, y, z, i, j, k, w] = floats(args)?;
    let rotation = mirrored(Quat::from_xyzw(i, j, k, w));
    let position = Vec3::new(-x, y, z);
    let is_place = position.abs().max_element() < MAX_COORDINATE && SQUARED_LENGTH.contains(&rotation.dot(rotation));
    is_place.then(|| Place { position, rotation: rotation.normalized() })
}

fn place_args(name: &str, place: &Place) -> Vec<OscType> {
    let (Vec3 { x, y, z }, q) = (place.position, mirrored(place.rotation));
    let numbers = [-x, y, z, q.x, q.y, q.z, q.w].map(OscType::Float);
    std::iter::once(OscType::String(name.to_owned())).chain(numbers).collect()
}

/// Mirrors a rotation at x = 0.
fn mirrored(q: Quat) -> Quat {
    Quat::from_xyzw(q.x, -q.y, -q.z, q.w)
}
