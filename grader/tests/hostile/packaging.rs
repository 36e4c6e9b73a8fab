//! Submissions that aren't five plain files in a folder: archives that an ordinary program would
//! never make, and folders with unusual files.

use std::fs::{self, File, Permissions};
use std::io::{Cursor, Write};
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::Command;

use flate2::Compression;
use flate2::write::GzEncoder;
use serde::Deserialize;
use tar::{Builder, EntryType, Header};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// The form in which a folder of task files is submitted.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Packaging {
    /// A zip with a path that leads out of the archive.
    Climbing,
    /// A zip with an absolute path.
    Absolute,
    /// A zip with two spellings of the same path.
    TwoSpellings,
    /// A tar with a symbolic link to the key in place of a file.
    LinkToTheKey,
    /// A tar with a symbolic link to a folder, and a file whose path leads through that link.
    LinkedFolder,
    /// A tar with a hard link to the key in place of a file.
    HardLink,
    /// A tar with a named pipe in place of a file.
    Pipe,
    /// A zip with a 256 MiB file that compresses well.
    Bomb,
    /// A zip with more files than the limit allows.
    ManyFiles,
    /// A folder with more archives than the limit allows.
    ManyArchives,
    /// A tar with a file name that contains escape sequences, line breaks and right-to-left text.
    OddNames,
    /// A folder with a file whose name differs from a task file's name by one Cyrillic letter.
    LookAlike,
    /// An empty file.
    Empty,
    /// The first half of a zip.
    Truncated,
    /// The beginning of a RAR archive, in a file named like a zip.
    OtherKind,
    /// A folder with a sparse file of 10 GB.
    Sparse,
    /// A folder in which one file has all permissions and another has none.
    OddModes,
    /// A folder where one file is a named pipe.
    PipeOnDisk,
    /// A folder where one file is a link to a correct file elsewhere.
    LinkedFileOnDisk,
    /// A folder whose `student` folder is a link to a folder elsewhere with a correct `src`.
    LinkedFolderOnDisk,
    /// A folder whose `student/src` is a link to a folder of correct files elsewhere.
    LinkedSourceOnDisk,
    /// A folder whose only subfolder is a link to a folder of correct files elsewhere.
    LinkedOnlyFolderOnDisk,
}

/// Packs the folder. Returns the path to submit.
pub fn pack(folder: &Path, packaging: Packaging, key: &Path) -> PathBuf {
    let files = read_files(folder);
    let tar_with =
        |files: &[(String, Vec<u8>)], others: &[Member]| write_tar(folder, files, others);
    let in_place_of_camera = |kind, target| tar_with(&files[1..], &[("camera.rs", kind, target)]);
    match packaging {
        Packaging::Climbing => return write_zip(folder, &files, Some("../../bvh.rs")),
        Packaging::Absolute => return write_zip(folder, &files, Some("/bvh.rs")),
        Packaging::TwoSpellings => return write_zip(folder, &files, Some("./Camera.rs")),
        Packaging::OddNames => {
            let odd = "\u{1b}[2J\n\u{202e}sr.hvb\u{7}.rs";
            return tar_with(&files, &[(odd, EntryType::Regular, None)]);
        }
        Packaging::LinkToTheKey => return in_place_of_camera(EntryType::Symlink, Some(key)),
        Packaging::HardLink => return in_place_of_camera(EntryType::Link, Some(key)),
        Packaging::Pipe => return in_place_of_camera(EntryType::Fifo, None),
        Packaging::LinkedFolder => {
            let link = ("src", EntryType::Symlink, key.parent());
            let through = ("src/key", EntryType::Regular, None);
            return tar_with(&files, &[link, through]);
        }
        Packaging::Bomb => {
            let bomb = (files[0].0.clone(), vec![b' '; 256 << 20]);
            return write_zip(folder, &[&[bomb], &files[1..]].concat(), None);
        }
        Packaging::ManyFiles => {
            let names = (0..1 << 16).map(|n| format!("{n}.txt"));
            let many: Vec<_> = names.map(|name| (name, Vec::new())).collect();
            return write_zip(folder, &[files, many].concat(), None);
        }
        Packaging::Empty => return write_archive(folder, "zip", b""),
        Packaging::OtherKind => return write_archive(folder, "zip", b"Rar!\x1a\x07\x01\x00"),
        Packaging::Truncated => {
            let whole = write_zip(folder, &files, None);
            let bytes = fs::read(&whole).expect("the archive can be read");
            return write_archive(folder, "zip", &bytes[..bytes.len() / 2]);
        }
        Packaging::LookAlike => {
            let text = "compile_error!(\"this is not camera.rs\");";
            fs::write(folder.join("cam\u{435}ra.rs"), text).expect("the file can be written");
        }
        Packaging::ManyArchives => {
            let archive = write_zip(&folder.join("0"), &files, None);
            for number in 1..200 {
                let copy = folder.join(format!("{number}.zip"));
                fs::copy(&archive, copy).expect("the file can be copied");
            }
        }
        Packaging::Sparse => {
            let file = File::create(folder.join("camera.rs")).expect("the file can be created");
            let grown = file.set_len(10 << 30);
            grown.expect("the file system supports sparse files");
        }
        Packaging::OddModes => {
            for (name, mode) in [("camera.rs", 0), ("sphere.rs", 0o6777)] {
                let mode = Permissions::from_mode(mode);
                fs::set_permissions(folder.join(name), mode).expect("the file can be changed");
            }
        }
        Packaging::PipeOnDisk => {
            let camera = folder.join("camera.rs");
            fs::remove_file(&camera).expect("the file can be changed");
            let made = Command::new("mkfifo").arg(&camera).status();
            assert!(made.expect("Linux has mkfifo").success());
        }
        Packaging::LinkedFileOnDisk => {
            let others = move_elsewhere(folder, "");
            for (name, bytes) in &files[1..] {
                fs::write(folder.join(name), bytes).expect("the file can be written");
            }
            link(&others.join("camera.rs"), &folder.join("camera.rs"));
        }
        Packaging::LinkedFolderOnDisk => {
            link(&move_elsewhere(folder, "src"), &folder.join("student"));
        }
        Packaging::LinkedSourceOnDisk => {
            link(&move_elsewhere(folder, ""), &folder.join("student/src"));
        }
        Packaging::LinkedOnlyFolderOnDisk => {
            link(&move_elsewhere(folder, ""), &folder.join("pathtracing"));
        }
    }
    folder.to_owned()
}

/// Moves the files into the subfolder `below` of a new folder next to the old one, as if they
/// belonged to another student. Returns the new folder. The old folder is empty afterwards.
fn move_elsewhere(folder: &Path, below: &str) -> PathBuf {
    let others = folder.with_extension("others");
    let target = others.join(below);
    fs::create_dir_all(target.parent().expect("it has a parent")).expect("it can be created");
    fs::rename(folder, &target).expect("the folder can be moved");
    fs::create_dir(folder).expect("the folder can be created");
    others
}

/// Creates a link and the folder that contains it.
fn link(original: &Path, path: &Path) {
    let folder = path.parent().expect("it has a parent");
    fs::create_dir_all(folder).expect("the folder can be created");
    symlink(original, path).expect("the link can be created");
}

type Files = Vec<(String, Vec<u8>)>;

/// Returns the names and contents of the folder's files, `camera.rs` first.
fn read_files(folder: &Path) -> Files {
    let entries = fs::read_dir(folder)
        .expect("the folder can be read")
        .flatten();
    let file = |entry: fs::DirEntry| {
        let name = entry.file_name().into_string().expect("the name is UTF-8");
        (name, fs::read(entry.path()).expect("the file can be read"))
    };
    let mut files: Files = entries.map(file).collect();
    files.sort_by_key(|(name, _)| name != "camera.rs");
    files
}

fn write_archive(folder: &Path, extension: &str, bytes: &[u8]) -> PathBuf {
    let path = folder.with_extension(extension);
    fs::write(&path, bytes).expect("the file can be written");
    path
}

fn write_zip(folder: &Path, files: &[(String, Vec<u8>)], also: Option<&str>) -> PathBuf {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let also = also.map(|name| (name.to_owned(), Vec::new()));
    for (name, bytes) in files.iter().chain(&also) {
        let options = SimpleFileOptions::default();
        let started = writer.start_file(name.as_str(), options);
        started.expect("the name is valid");
        writer.write_all(bytes).expect("writing to memory succeeds");
    }
    let bytes = writer.finish().expect("the archive is complete");
    write_archive(folder, "zip", &bytes.into_inner())
}

type Member<'a> = (&'a str, EntryType, Option<&'a Path>);

/// Writes a tar. The members in `others` come first, so that a program that unpacks members one by
/// one reads them before the files.
fn write_tar(folder: &Path, files: &[(String, Vec<u8>)], others: &[Member]) -> PathBuf {
    let compressed = GzEncoder::new(Vec::new(), Compression::fast());
    let mut builder = Builder::new(compressed);
    let others = others.iter().map(|(name, kind, target)| {
        let mut header = header(name, *kind, 0);
        let target = target.map(|target| header.set_link_name(target));
        target.transpose().expect("the name fits");
        (header, &[][..])
    });
    let files = files.iter().map(|(name, bytes)| {
        let header = header(name, EntryType::Regular, bytes.len());
        (header, bytes.as_slice())
    });
    for (mut header, bytes) in others.chain(files) {
        header.set_cksum();
        let added = builder.append(&header, bytes);
        added.expect("writing to memory succeeds");
    }
    let bytes = builder.into_inner().and_then(GzEncoder::finish);
    write_archive(folder, "tar.gz", &bytes.expect("the archive is complete"))
}

/// Returns a header with exactly this name. The `tar` crate's own method rejects some names.
fn header(name: &str, kind: EntryType, size: usize) -> Header {
    let mut header = Header::new_ustar();
    let field = &mut header.as_ustar_mut().expect("it is a ustar header").name;
    field[..name.len()].copy_from_slice(name.as_bytes());
    header.set_entry_type(kind);
    header.set_size(size as u64);
    header.set_mode(0o644);
    header
}
