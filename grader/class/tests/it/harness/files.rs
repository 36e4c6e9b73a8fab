//! Archives, folders and their files.

use std::collections::BTreeMap;
use std::fs;
use std::io::{Cursor, Read, Write};
use std::path::{Path, PathBuf};

use serde_json::Value;
use zip::write::SimpleFileOptions;
use zip::{ZipArchive, ZipWriter};

/// Packs files into an archive.
pub fn zip<P: ToString, B: AsRef<[u8]>>(files: impl IntoIterator<Item = (P, B)>) -> Vec<u8> {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (path, bytes) in files {
        let options = SimpleFileOptions::default();
        writer.start_file(path.to_string(), options).unwrap();
        writer.write_all(bytes.as_ref()).unwrap();
    }
    writer.finish().unwrap().into_inner()
}

/// Returns the name and the contents of each file in an archive.
pub fn unzip(archive: &[u8]) -> Vec<(String, Vec<u8>)> {
    let mut archive = ZipArchive::new(Cursor::new(archive)).unwrap();
    let mut files = Vec::new();
    for index in 0..archive.len() {
        let mut file = archive.by_index(index).unwrap();
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).unwrap();
        files.push((file.name().unwrap().into_owned(), bytes));
    }
    files
}

/// Returns the paths of all files in a folder, sorted.
pub fn files_below(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut open = vec![folder.to_owned()];
    while let Some(folder) = open.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() { &mut open } else { &mut files }.push(path);
        }
    }
    files.sort();
    files
}

/// Returns all files in a folder, without anything that differs between equivalent runs: the
/// timings, the folder's own path in reports, and the flag that a merge sets on each list taken
/// from the shards.
pub fn comparable_files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let comparable = |path: PathBuf| {
        let mut bytes = fs::read(&path).unwrap();
        if path.ends_with("score.json") {
            let mut score: Value = serde_json::from_slice(&bytes).unwrap();
            score["timings"] = Value::Null;
            bytes = serde_json::to_vec(&score).unwrap();
        } else if path.ends_with("report.html") || path.ends_with("run.json") {
            let here = folder.canonicalize().unwrap().display().to_string();
            let text = String::from_utf8(bytes).unwrap().replace(&here, "OUT");
            bytes = text.replace(IS_OF_PARTS, "").into_bytes();
        }
        (path.strip_prefix(folder).unwrap().to_owned(), bytes)
    };
    files_below(folder).into_iter().map(comparable).collect()
}

/// The flag that a merge sets on each list taken from the shards.
const IS_OF_PARTS: &str = ",\n      \"is_of_parts\": true";
