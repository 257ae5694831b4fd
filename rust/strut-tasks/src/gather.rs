//! Collection of the BVH files of a task from files, folders (recursively) and zip archives.

use crate::error::{Outcome, TaskError};
use crate::files;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};
use strut_formats::{bvh, corpus};

/// Greatest depth of nested folders.
const MAX_DEPTH: usize = 16;
/// Greatest size of an archive, and of its unpacked files, bytes: the same limit as for a database.
const MAX_ARCHIVE_BYTES: usize = 1 << 30;
/// Greatest size of the unpacked files of all archives, bytes: they are in memory together.
const MAX_UNPACKED_BYTES: u64 = 4 << 30;
/// Greatest size of a licence file, bytes.
const MAX_LICENCE_BYTES: usize = 1 << 20;

/// An input file.
pub struct Source {
    /// Path with `/`. For a file in an archive it is the archive's path, then the path within.
    pub path: String,
    /// Path with `/`, relative to the input folder or archive; for a single file its name.
    pub below: String,
    content: Content,
}

/// Files by path: the path below the input, and the content.
type Found = BTreeMap<String, (String, Content)>;

enum Content {
    OnDisk(PathBuf),
    Unpacked { bytes: Vec<u8>, licence: String },
}

impl Source {
    /// Creates a source of a file with any name.
    pub fn file(path: &Path) -> Self {
        let below = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
        Self { path: shown(path), below, content: Content::OnDisk(path.to_owned()) }
    }

    /// Returns the last part of the path.
    pub fn file_name(&self) -> &str {
        self.path.rsplit('/').next().unwrap_or_default()
    }

    /// Returns whether this is the file at a path, even if the path is written differently.
    pub fn is_at(&self, path: &Path) -> bool {
        let Content::OnDisk(own) = &self.content else { return false };
        matches!((own.canonicalize(), path.canonicalize()), (Ok(a), Ok(b)) if a == b)
    }

    /// Reads the file.
    ///
    /// # Errors
    /// If it cannot be read or is too large.
    pub fn bytes(&self) -> Outcome<Cow<'_, [u8]>> {
        match &self.content {
            Content::OnDisk(path) => files::read(path, bvh::MAX_BYTES).map(Into::into),
            Content::Unpacked { bytes, .. } => Ok(bytes.into()),
        }
    }

    /// Returns the title of the licence file next to the file, or an empty string.
    pub fn licence(&self) -> String {
        let path = match &self.content {
            Content::OnDisk(path) => path,
            Content::Unpacked { licence, .. } => return licence.clone(),
        };
        let title = |name: &&str| {
            let text = files::read(&path.with_file_name(name), MAX_LICENCE_BYTES).ok()?;
            Some(corpus::licence_title(&text)).filter(|title| !title.is_empty())
        };
        corpus::LICENCE_NAMES.iter().find_map(title).unwrap_or_default()
    }
}

/// Returns whether an input is a folder or an archive.
pub fn holds_several(input: &Path) -> bool {
    input.is_dir() || has_extension(input, "zip")
}

/// Returns the archive that contains the file of this [path](Source::path), or `None` if the file is not in an archive.
pub fn archive_of(path: &Path) -> Option<&Path> {
    path.ancestors().skip(1).find(|folder| has_extension(folder, "zip") && folder.is_file())
}

/// Returns all BVH files of the inputs, sorted by path, each once.
///
/// # Errors
/// If an input cannot be read or contains no BVH file.
pub fn gather(inputs: &[PathBuf]) -> Outcome<Vec<Source>> {
    gather_within(inputs, MAX_UNPACKED_BYTES)
}

/// [`gather`], with at most `left` bytes unpacked from all archives.
fn gather_within(inputs: &[PathBuf], mut left: u64) -> Outcome<Vec<Source>> {
    let mut found = Found::new();
    for input in inputs {
        if input.is_dir() {
            walk(input, input, 0, &mut found)?;
        } else if has_extension(input, "zip") {
            unpack(input, &mut left, &mut found)?;
        } else if has_extension(input, "bvh") {
            std::fs::metadata(input).map_err(|e| TaskError::io(input, &e))?;
            let below = input.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            found.entry(shown(input)).or_insert((below, Content::OnDisk(input.clone())));
        } else if input.exists() {
            return Err(TaskError::in_file(input, "a .bvh file, a folder or a .zip archive was expected"));
        } else {
            return Err(TaskError::in_file(input, "there is no such file or folder"));
        }
    }
    if found.is_empty() {
        let inputs: Vec<String> = inputs.iter().map(|p| p.display().to_string()).collect();
        return Err(TaskError::new(format_args!("{}: no .bvh file was found there", inputs.join(", "))));
    }
    Ok(found.into_iter().map(|(path, (below, content))| Source { path, below, content }).collect())
}

fn walk(input: &Path, folder: &Path, depth: usize, found: &mut Found) -> Outcome {
    if depth > MAX_DEPTH {
        return Err(TaskError::in_file(folder, format_args!("folders are nested more than {MAX_DEPTH} deep")));
    }
    let fail = |e: std::io::Error| TaskError::io(folder, &e);
    for entry in std::fs::read_dir(folder).map_err(fail)? {
        let entry = entry.map_err(fail)?;
        let path = entry.path();
        // The entry's own type: links to folders are not followed, as they may form a cycle.
        if entry.file_type().map_err(fail)?.is_dir() {
            walk(input, &path, depth + 1, found)?;
        } else if has_extension(&path, "bvh") && path.is_file() {
            let below = shown(path.strip_prefix(input).unwrap_or(&path));
            found.entry(shown(&path)).or_insert((below, Content::OnDisk(path)));
        }
    }
    Ok(())
}

/// Unpacks an archive. Subtracts its unpacked bytes from `left`.
fn unpack(archive: &Path, left: &mut u64, found: &mut Found) -> Outcome {
    let bytes = files::read(archive, MAX_ARCHIVE_BYTES)?;
    let fail = |e: &dyn std::fmt::Display| TaskError::in_file(archive, format_args!("the archive cannot be read: {e}"));
    let mut zip = zip::ZipArchive::new(Cursor::new(bytes)).map_err(|e| fail(&e))?;
    let licences = licences_in(&mut zip);
    let mut left_here = MAX_ARCHIVE_BYTES;
    for index in 0..zip.len() {
        let file = zip.by_index(index).map_err(|e| fail(&e))?;
        let name = file.name().map_err(|e| fail(&e))?.replace('\\', "/");
        // macOS adds a second, unreadable file for each file.
        let hidden = name.split('/').any(|part| part.starts_with('.') || part == "__MACOSX");
        if hidden || !file.is_file() || !has_extension(Path::new(&name), "bvh") {
            continue;
        }
        // The size in the archive's directory may be wrong, so the unpacked bytes are counted.
        let most = bvh::MAX_BYTES.min(left_here).min(usize::try_from(*left).unwrap_or(usize::MAX));
        let mut content = Vec::new();
        file.take(most as u64 + 1).read_to_end(&mut content).map_err(|e| fail(&e))?;
        if content.len() as u64 > *left {
            let limit = format_args!("the archives together unpack to more than {} MiB", MAX_UNPACKED_BYTES >> 20);
            return Err(TaskError::in_file(archive, limit));
        }
        if content.len() > most {
            return Err(fail(&format_args!("'{name}' unpacks to more than {} MiB", most >> 20)));
        }
        left_here -= content.len();
        *left -= content.len() as u64;
        let licence = licences.get(folder_of(&name)).cloned().unwrap_or_default();
        let path = format!("{}/{name}", shown(archive));
        found.entry(path).or_insert((name, Content::Unpacked { bytes: content, licence }));
    }
    Ok(())
}

/// Returns the titles of the licences in an archive by folder. Unreadable ones are ignored.
fn licences_in(zip: &mut zip::ZipArchive<Cursor<Vec<u8>>>) -> BTreeMap<String, String> {
    let mut titles = BTreeMap::new();
    for licence in corpus::LICENCE_NAMES {
        for index in 0..zip.len() {
            let Ok(file) = zip.by_index(index) else { continue };
            let Some(name) = file.name().ok().map(|name| name.replace('\\', "/")) else { continue };
            let folder = folder_of(&name).to_owned();
            if name[folder.len()..] != *licence || titles.contains_key(&folder) {
                continue;
            }
            let mut text = Vec::new();
            let is_whole = file.take(MAX_LICENCE_BYTES as u64).read_to_end(&mut text).is_ok();
            let title = corpus::licence_title(&text);
            if is_whole && !title.is_empty() {
                titles.insert(folder, title);
            }
        }
    }
    titles
}

/// Returns the folder of a path in an archive, with its slash.
fn folder_of(name: &str) -> &str {
    &name[..name.rfind('/').map_or(0, |at| at + 1)]
}

fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case(extension))
}

fn shown(path: &Path) -> String {
    path.to_string_lossy().replace('\\', "/")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;

    #[test]
    fn folders_are_searched_and_archives_unpacked() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        std::fs::create_dir(at("in")).unwrap();
        for name in ["b.bvh", "in/a.BVH", "notes.txt"] {
            std::fs::write(at(name), name).unwrap();
        }
        std::fs::write(at("LICENSE"), "\nCC BY 4.0\n\nmore").unwrap();
        let mut zip = zip::ZipWriter::new(std::fs::File::create(at("c.zip")).unwrap());
        for name in ["x/d.bvh", "__MACOSX/x/d.bvh", "x/LICENSE"] {
            zip.start_file(name, zip::write::SimpleFileOptions::default()).unwrap();
            zip.write_all(b"zipped").unwrap();
        }
        zip.finish().unwrap();

        let sources = gather(&[folder.path().to_owned(), at("c.zip"), at("b.bvh")]).unwrap();
        let stems: Vec<&str> = sources.iter().map(|s| corpus::stem(&s.path)).collect();
        assert_eq!(stems, ["b", "d", "a"]);
        let below: Vec<&str> = sources.iter().map(|s| s.below.as_str()).collect();
        assert_eq!(below, ["b.bvh", "x/d.bvh", "in/a.BVH"]);
        assert_eq!(sources[1].bytes().unwrap().as_ref(), b"zipped");
        assert_eq!(archive_of(Path::new(&sources[1].path)), Some(at("c.zip").as_path()));
        assert_eq!(archive_of(Path::new(&sources[0].path)), None);
        assert_eq!((sources[0].licence().as_str(), sources[1].licence().as_str()), ("CC BY 4.0", "zipped"));
    }

    #[test]
    fn archives_have_a_limit_together() {
        let folder = tempfile::tempdir().unwrap();
        let archive = |name: &str| {
            let path = folder.path().join(name);
            let mut zip = zip::ZipWriter::new(std::fs::File::create(&path).unwrap());
            zip.start_file("a.bvh", zip::write::SimpleFileOptions::default()).unwrap();
            zip.write_all(&[b' '; 600]).unwrap();
            zip.finish().unwrap();
            path
        };
        let both = ["a.zip", "b.zip"].map(archive);
        assert_eq!(gather_within(&both, 1200).unwrap().len(), 2);
        assert_eq!(gather_within(&both[..1], 1000).unwrap().len(), 1);
        let refused = gather_within(&both, 1000).err().unwrap().to_string();
        assert!(
            refused.contains("b.zip") && refused.contains("the archives together unpack to more than"),
            "{refused}"
        );
    }

    #[test]
    fn inputs_that_hold_nothing_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let text = folder.path().join("a.txt");
        std::fs::write(&text, "x").unwrap();
        let zip = folder.path().join("a.zip");
        std::fs::write(&zip, "x").unwrap();
        let missing = folder.path().join("b.bvh");
        for (input, expected) in [
            (folder.path(), "no .bvh file was found there"),
            (&text, "a .bvh file, a folder or a .zip archive was expected"),
            (&missing, "there is no such file or folder"),
            (&zip, "the archive cannot be read"),
        ] {
            let Err(failure) = gather(&[input.to_owned()]) else { panic!("{} was read", input.display()) };
            assert!(failure.to_string().contains(expected), "{failure}");
        }
    }
}
