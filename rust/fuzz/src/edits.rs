//! Files with a few changes, which are derived from arbitrary bytes. A changed file keeps its kind: texts keep their
//! words, containers their lengths and checksums, so that the changes reach the code behind these checks.

use arbitrary::{Result, Unstructured};
use safetensors::tensor::{Dtype, SafeTensors, TensorView};
use serde_json::{Number, Value};

/// Greatest number of changes of a file.
const MAX_EDITS: usize = 12;
/// Longest edited text, bytes.
const MAX_TEXT_BYTES: usize = 1 << 16;
/// Greatest number of numbers of an edited tensor.
const MAX_NUMBERS: usize = 1 << 16;

/// Words that replace a number, or a text.
const WORDS: [&str; 24] = [
    "0",
    "-0",
    "1",
    "-1",
    "1e7",
    "-1e7",
    "1e38",
    "1e-38",
    "1e400",
    "nan",
    "inf",
    "-inf",
    "0x10",
    "90",
    "180",
    "-360",
    "65536",
    "4294967296",
    "18446744073709551616",
    "1.5",
    ".",
    "-",
    "\u{0}",
    "µ",
];

/// Returns a text with changed, repeated, removed and swapped words. `words` are additional words of its kind.
///
/// # Errors
/// If the bytes are used up.
pub fn text(u: &mut Unstructured<'_>, base: &str, words: &[&str]) -> Result<Vec<u8>> {
    let mut tokens: Vec<Vec<u8>> =
        base.split_inclusive([' ', '\n', '\t', ',']).map(|t| t.as_bytes().to_vec()).collect();
    for _ in 0..u.int_in_range(0..=MAX_EDITS)? {
        if tokens.is_empty() {
            break;
        }
        let at = u.choose_index(tokens.len())?;
        match u.int_in_range(0..=6)? {
            0 => replace_word(&mut tokens[at], u.choose(&WORDS)?),
            1 if !words.is_empty() => replace_word(&mut tokens[at], u.choose(words)?),
            2 => {
                let length = u.int_in_range(1..=64)?.min(tokens.len() - at);
                tokens.drain(at..at + length);
            }
            3 => {
                let length = u.int_in_range(1..=64)?.min(tokens.len() - at);
                let part = tokens[at..at + length].to_vec();
                let times = u.int_in_range(1..=32)?;
                let bytes: usize = part.iter().map(Vec::len).sum();
                if bytes * times < MAX_TEXT_BYTES {
                    (0..times).for_each(|_| drop(tokens.splice(at..at, part.iter().cloned())));
                }
            }
            4 => {
                let other = u.choose_index(tokens.len())?;
                tokens.swap(at, other);
            }
            5 => {
                let number = format!("{}", f64::from(u.int_in_range(-2_000_000..=2_000_000)?) / 1000.0);
                replace_word(&mut tokens[at], &number);
            }
            _ => {
                let byte = u.arbitrary()?;
                let place = u.choose_index(tokens[at].len())?;
                tokens[at][place] = byte;
            }
        }
    }
    let mut bytes = tokens.concat();
    bytes.truncate(MAX_TEXT_BYTES);
    Ok(bytes)
}

/// Replaces the word of a token, and keeps the separator after it.
fn replace_word(token: &mut Vec<u8>, word: &str) {
    let separator = token.last().copied().filter(|byte| b" \n\t,".contains(byte));
    *token = word.as_bytes().to_vec();
    token.extend(separator);
}

/// Returns bytes with some of them changed, removed or repeated.
///
/// # Errors
/// If the bytes are used up.
pub fn bytes(u: &mut Unstructured<'_>, base: &[u8]) -> Result<Vec<u8>> {
    let mut out = base.to_vec();
    for _ in 0..u.int_in_range(0..=MAX_EDITS)? {
        if out.is_empty() {
            break;
        }
        // Headers are short and at the start: half of the changes are in the first bytes.
        let within = if u.arbitrary()? { out.len() } else { out.len().min(512) };
        let at = u.choose_index(within)?;
        match u.int_in_range(0..=4)? {
            0 => out[at] = u.arbitrary()?,
            1 => out[at] ^= 1 << u.int_in_range(0..=7)?,
            2 => out.truncate(at),
            3 => {
                let end = (at + u.int_in_range(1..=64)?).min(out.len());
                out.drain(at..end);
            }
            _ => {
                let word = u.arbitrary::<[u8; 4]>()?;
                out.splice(at..at, word);
            }
        }
    }
    Ok(out)
}

/// A tensor of a container.
#[derive(Clone, Debug)]
struct Tensor {
    name: String,
    dtype: Dtype,
    shape: Vec<usize>,
    data: Vec<u8>,
}

/// Returns a container (`strut_formats::container`) with changed metadata and tensors, and with correct lengths and
/// checksum. `entry` is the key of its metadata.
///
/// # Errors
/// If the bytes are used up.
///
/// # Panics
/// If the base is no container.
pub fn container(u: &mut Unstructured<'_>, base: &[u8], entry: &str) -> Result<Vec<u8>> {
    let file = SafeTensors::deserialize(base).expect("the base is a container");
    let (_, header) = SafeTensors::read_metadata(base).expect("the base is a container");
    let json = header.metadata().as_ref().and_then(|m| m.get(entry)).expect("the base has metadata");
    let mut metadata: Value = serde_json::from_str(json).expect("the base has metadata");
    let mut tensors: Vec<Tensor> = file
        .tensors()
        .into_iter()
        .map(|(name, view)| Tensor {
            name,
            dtype: view.dtype(),
            shape: view.shape().to_vec(),
            data: view.data().to_vec(),
        })
        .collect();
    tensors.sort_by(|a, b| a.name.cmp(&b.name));
    for _ in 0..u.int_in_range(0..=MAX_EDITS)? {
        if tensors.is_empty() || u.arbitrary()? {
            edit_metadata(u, &mut metadata)?;
        } else {
            edit_tensors(u, &mut tensors)?;
        }
    }
    Ok(write_container(&metadata, &tensors, entry))
}

/// Changes or removes one value of the metadata.
fn edit_metadata(u: &mut Unstructured<'_>, value: &mut Value) -> Result<()> {
    match value {
        Value::Object(map) if !map.is_empty() => {
            let key = map.keys().nth(u.choose_index(map.len())?).cloned().unwrap_or_default();
            if u.ratio(1, 16)? {
                map.remove(&key);
                return Ok(());
            }
            edit_metadata(u, &mut map[&key])
        }
        Value::Array(list) if !list.is_empty() => {
            let at = u.choose_index(list.len())?;
            match u.int_in_range(0..=7)? {
                0 => drop(list.remove(at)),
                1 => list.insert(at, list[at].clone()),
                _ => edit_metadata(u, &mut list[at])?,
            }
            Ok(())
        }
        _ => {
            *value = scalar(u, value)?;
            Ok(())
        }
    }
}

/// Returns a replacement of a value.
fn scalar(u: &mut Unstructured<'_>, was: &Value) -> Result<Value> {
    Ok(match (was, u.int_in_range(0..=6)?) {
        // Slightly more or less than the value.
        (Value::Number(n), 0..=2) => {
            let near = n.as_f64().unwrap_or(0.0) + f64::from(u.int_in_range(-3..=3)?);
            if n.is_f64() { number(near) } else { Value::from(near as i64) }
        }
        (_, 3) => Value::Null,
        (_, 4) => Value::from(*u.choose(&WORDS)?),
        (_, 5) => number(f64::from(f32::from_bits(u.arbitrary()?))),
        _ => Value::from(*u.choose(&[0i64, 1, -1, 2, 60, 255, 65_536, i64::from(u32::MAX), i64::MAX])?),
    })
}

/// Returns a JSON number, or `null` for a number that is not finite, which JSON lacks.
fn number(of: f64) -> Value {
    Number::from_f64(of).map_or(Value::Null, Value::Number)
}

/// Changes numbers, the shape or the type of a tensor, or removes it.
fn edit_tensors(u: &mut Unstructured<'_>, tensors: &mut Vec<Tensor>) -> Result<()> {
    let at = u.choose_index(tensors.len())?;
    let tensor = &mut tensors[at];
    let size = tensor.dtype.bitsize() / 8;
    let numbers = tensor.data.len() / size;
    match u.int_in_range(0..=9)? {
        0..=5 if numbers > 0 => {
            let first = u.choose_index(numbers)?;
            let count = if u.arbitrary()? { 1 } else { u.int_in_range(1..=4096)? };
            let value =
                if tensor.dtype == Dtype::F32 { float(u)?.to_le_bytes().to_vec() } else { u.bytes(size)?.to_vec() };
            for place in tensor.data.chunks_exact_mut(size).skip(first).take(count) {
                place.copy_from_slice(&value);
            }
        }
        6 | 7 if !tensor.shape.is_empty() => {
            let axis = u.choose_index(tensor.shape.len())?;
            let length = if u.arbitrary()? { tensor.shape[axis] + 1 } else { u.int_in_range(0..=64)? };
            tensor.shape[axis] = length;
            let numbers = tensor.shape.iter().try_fold(1, |n: usize, &axis| n.checked_mul(axis));
            match numbers.filter(|n| *n <= MAX_NUMBERS) {
                Some(numbers) => tensor.data.resize(numbers * size, 0),
                None => drop(tensors.remove(at)),
            }
        }
        8 => {
            tensor.dtype = *u.choose(&[Dtype::F32, Dtype::F64, Dtype::I32, Dtype::U8, Dtype::F16])?;
            let size = tensor.dtype.bitsize() / 8;
            tensor.data.resize(tensor.shape.iter().product::<usize>() * size, 0);
        }
        _ => drop(tensors.remove(at)),
    }
    Ok(())
}

/// Returns an unexpected number, or a usual one.
fn float(u: &mut Unstructured<'_>) -> Result<f32> {
    Ok(match u.int_in_range(0..=9)? {
        0 => f32::NAN,
        1 => f32::INFINITY,
        2 => f32::MAX,
        3 => f32::MIN_POSITIVE,
        4 => f32::from_bits(u.arbitrary()?),
        5 => 0.0,
        _ => u.int_in_range(-4000i32..=4000)? as f32 / 1000.0,
    })
}

fn write_container(metadata: &Value, tensors: &[Tensor], entry: &str) -> Vec<u8> {
    let mut metadata = metadata.clone();
    if let Some(checksum) = metadata.get_mut("checksum") {
        *checksum = Value::from("00000000");
    }
    let views = tensors.iter().map(|t| {
        let view = TensorView::new(t.dtype, t.shape.clone(), &t.data).expect("as much data as its shape says");
        (t.name.as_str(), view)
    });
    let about = std::iter::once((entry.to_owned(), metadata.to_string())).collect();
    let mut file = safetensors::serialize(views, Some(about)).expect("tensors of different names");
    enter_checksum(&mut file);
    file
}

/// Sets the right checksum in a file that has one, in whatever form; other bytes are unchanged.
pub fn enter_checksum(file: &mut [u8]) {
    const FIELD: &[u8] = br#"\"checksum\":\""#;
    const DIGITS: usize = 8;
    let Some(begin) = file.windows(FIELD.len()).position(|w| w == FIELD).map(|at| at + FIELD.len()) else { return };
    let Some(digits) = file.get_mut(begin..begin + DIGITS) else { return };
    digits.fill(b'0');
    let sum = format!("{:08x}", crc32fast::hash(file));
    file[begin..begin + DIGITS].copy_from_slice(sum.as_bytes());
}
