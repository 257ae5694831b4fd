//! Reads metadata and tensors from bytes; checks everything.

use super::tensor::Tensors;
use super::{ContainerError, Kind, Source, checksum};
use crate::quotation::quotation;
use safetensors::tensor::Metadata as Header;
use serde::Deserialize;
use serde::de::DeserializeOwned;

/// Part of the metadata that is common to all kinds.
#[derive(Deserialize)]
struct Common {
    version: String,
    checksum: Option<String>,
}

/// Greatest number of characters of a text from the file in a message.
const SHOWN: usize = 20;

/// Metadata and tensors of an undamaged file.
pub(crate) fn open<M: DeserializeOwned, S: Source + ?Sized>(
    kind: Kind,
    file: &S,
) -> Result<(M, Tensors<'_, S>), ContainerError> {
    if file.len() > kind.max_bytes {
        return Err(ContainerError::TooManyBytes { kind, bytes: file.len() });
    }
    let no_header = ContainerError::NotSafetensors { kind };
    let Some(beginning) = beginning(file) else { return Err(no_header) };
    let Ok(header) = serde_json::from_slice::<Header>(&beginning[LENGTH_BYTES..]) else { return Err(no_header) };
    if header.data_len().checked_add(beginning.len()) != Some(file.len()) {
        return Err(ContainerError::Length);
    }
    let json = header.metadata().as_ref().and_then(|m| m.get(kind.entry));
    let json = json.ok_or(ContainerError::NoMetadata { kind })?;
    let unreadable = |e: serde_json::Error| ContainerError::Metadata { kind, reason: e.to_string() };
    let Common { version, checksum } = serde_json::from_str(json).map_err(unreadable)?;
    let Some(minor) = minor_version(kind, &version) else {
        return Err(ContainerError::Version { kind, found: quotation(&version, SHOWN) });
    };
    if checksum.is_some() || minor >= kind.checksum_since {
        let none = || ContainerError::Metadata { kind, reason: "they have no checksum".to_owned() };
        let found = checksum.ok_or_else(none)?;
        let computed = checksum::compute(&beginning, file, &found).ok_or_else(|| ContainerError::Metadata {
            kind,
            reason: format!("the checksum {} is not written with eight digits", quotation(&found, SHOWN)),
        })?;
        if found != computed {
            return Err(ContainerError::Checksum { kind, found: quotation(&found, SHOWN), computed });
        }
    }
    let metadata = serde_json::from_str(json).map_err(unreadable)?;
    Ok((metadata, Tensors::new(kind, header, beginning.len(), file)))
}

/// Minor version, if the major version is the kind's.
fn minor_version(kind: Kind, version: &str) -> Option<u32> {
    let parts = |v: &str| {
        let (major, minor) = v.split_once('.').unwrap_or((v, "0"));
        Some((major.parse::<u32>().ok()?, minor.split('.').next()?.parse::<u32>().ok()?))
    };
    let (major, minor) = parts(version)?;
    (Some(major) == parts(kind.version).map(|(major, _)| major)).then_some(minor)
}

/// Number of bytes of the header's length.
const LENGTH_BYTES: usize = 8;

/// The file up to the end of its header; `None` if the file is shorter.
fn beginning<S: Source + ?Sized>(file: &S) -> Option<Vec<u8>> {
    let mut length = [0; LENGTH_BYTES];
    if file.len() < LENGTH_BYTES {
        return None;
    }
    file.copy(0, &mut length);
    let end = usize::try_from(u64::from_le_bytes(length)).ok()?.checked_add(LENGTH_BYTES)?;
    if end > file.len() {
        return None;
    }
    let mut beginning = vec![0; end];
    file.copy(0, &mut beginning);
    Some(beginning)
}
