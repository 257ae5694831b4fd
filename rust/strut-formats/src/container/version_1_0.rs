//! Model files in version 1.0, for tests.

use super::Kind;
use safetensors::SafeTensors;
use serde_json::Value;

/// The file in the layout of version 1.0, which had no checksum.
pub(crate) fn version_1_0(kind: Kind, file: &[u8]) -> Vec<u8> {
    let (_, header) = SafeTensors::read_metadata(file).unwrap();
    let mut metadata: Value = serde_json::from_str(&header.metadata().as_ref().unwrap()[kind.entry]).unwrap();
    metadata.as_object_mut().unwrap().remove("checksum").unwrap();
    metadata["version"] = "1.0".into();
    let metadata = std::iter::once((kind.entry.to_owned(), metadata.to_string())).collect();
    let old = safetensors::serialize(SafeTensors::deserialize(file).unwrap().tensors(), Some(metadata)).unwrap();
    assert!(!String::from_utf8_lossy(&old).contains(r#"\"checksum\":"#), "no checksum");
    old
}
