use super::*;
use proptest::prelude::*;
use serde::{Deserialize, Serialize};

const KIND: Kind = Kind { name: "sample", entry: "sample", version: "1.1", checksum_since: 1, max_bytes: 1 << 20 };

#[derive(Debug, PartialEq, Serialize, Deserialize)]
struct Metadata {
    version: String,
    #[serde(default)]
    checksum: String,
    note: String,
}

fn file() -> Vec<u8> {
    let metadata = Metadata { version: KIND.version.into(), checksum: BLANK.into(), note: r#""checksum":""#.into() };
    write(KIND, &metadata, &[("values", floats(vec![2, 3], || (0..6).map(|i| i as f32)))])
}

fn values(file: &[u8]) -> Result<Vec<f32>, ContainerError> {
    let (_, tensors): (Metadata, _) = open(KIND, file)?;
    tensors.finite("values", &[2, 3])
}

fn refused(file: &[u8]) -> String {
    values(file).unwrap_err().to_string()
}

#[test]
fn tensors_come_back() {
    assert_eq!(values(&file()).unwrap(), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
}

#[test]
fn only_files_of_earlier_versions_need_no_checksum() {
    assert!(values(&version_1_0(KIND, &file())).is_ok());
    let mut renamed = file();
    let at = renamed.windows(8).position(|w| w == b"checksum").unwrap();
    renamed[at] = b'k';
    assert_eq!(refused(&renamed), "the sample's metadata cannot be read: they have no checksum");
}

#[test]
fn other_files_are_refused_with_a_reason() {
    let file = file();
    assert!(refused(&file[..file.len() - 7]).contains("cut short"));
    assert!(refused(b"HIERARCHY\nROOT Hips\n").contains("not a sample"));
    assert!(refused(&[]).contains("not a sample"));
    let other = Kind { version: "2.0", ..KIND };
    let error = open::<Metadata, [u8]>(other, &file).err().unwrap().to_string();
    assert_eq!(error, "the sample has version 1.1; this release of Strut reads version 2.0");
}

/// JSON as other programs write it: with blanks or lines between its tokens, and keys in another order.
#[test]
fn metadata_may_be_spelt_otherwise() {
    for json in [
        r#"{"version": "1.1", "checksum": "00000000", "note": "\"checksum\": \"00000000\""}"#,
        r#"{"note": "checksum", "more": {"checksum": "12345678"}, "checksum" : "00000000", "version": "1.1"}"#,
        "{\n\t\"checksum\"\n:\r\n\t \"00000000\",\n \"version\": \"1.1\", \"note\": \"\"}",
    ] {
        let about = std::iter::once((KIND.entry.to_owned(), json.to_owned())).collect();
        let data: Vec<u8> = (0..6).flat_map(|i| (i as f32).to_le_bytes()).collect();
        let view = safetensors::tensor::TensorView::new(safetensors::Dtype::F32, vec![2, 3], &data).unwrap();
        let mut file = safetensors::serialize([("values", view)], Some(about)).unwrap();
        // The algorithm of any program: the sum with zeros in its place, then the sum is inserted.
        let sum = format!("{:08x}", crc32fast::hash(&file));
        let at = file.windows(8).rposition(|w| w == b"00000000").unwrap();
        let at =
            if json.starts_with("{\"version") { file.windows(8).position(|w| w == b"00000000").unwrap() } else { at };
        file[at..at + 8].copy_from_slice(sum.as_bytes());
        assert_eq!(values(&file).unwrap(), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0], "{json}");
        file[at - 20] ^= 1;
        assert!(values(&file).is_err());
    }
}

proptest! {
    #[test]
    fn every_changed_byte_is_noticed(at: prop::sample::Index, change in 1_u8..) {
        let mut bytes = file();
        let at = at.index(bytes.len());
        bytes[at] ^= change;
        prop_assert!(values(&bytes).is_err());
    }
}
