//! Submissions that are not handed in as five plain files: archives that nobody's program makes, and
//! folders that lie.

use std::fs::{self, File, Permissions};
use std::io::{Cursor, Write};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Command;

use flate2::Compression;
use flate2::write::GzEncoder;
use serde::Deserialize;
use tar::{Builder, EntryType, Header};
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

/// What is made of an honest folder.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Packaging {
    /// A member whose path climbs out of the archive.
    Climbing,
    /// A member with an absolute path.
    Absolute,
    /// A link to the key in the place of a file.
    LinkToTheKey,
    /// A link to a folder, and a file in it.
    LinkedFolder,
    /// A second name for a file of the machine.
    HardLink,
    /// A pipe, which nobody ever writes to.
    Pipe,
    /// A file of 256 MiB that is packed small.
    Bomb,
    /// More files than anybody has.
    ManyFiles,
    /// Names with escapes, line ends, and letters that run backwards.
    OddNames,
    /// Nothing.
    Empty,
    /// Half of an archive.
    Truncated,
    /// Something else altogether.
    OtherKind,
    /// A folder with a file of 10 GB, all of it a hole.
    Sparse,
    /// A folder in which one file has all rights, and the next has none.
    OddModes,
    /// A folder with a pipe in the place of a file.
    PipeOnDisk,
}

/// Makes it of the folder; returns what is handed in.
pub fn pack(folder: &Path, pack: Packaging, key: &Path) -> PathBuf {
    let files = read_files(folder);
    match pack {
        Packaging::Climbing => write_zip(folder, &files, Some("../../bvh.rs")),
        Packaging::Absolute => write_zip(folder, &files, Some("/bvh.rs")),
        Packaging::OddNames => {
            let odd = "\u{1b}[2J\n\u{202e}sr.hvb\u{7}.rs";
            write_tar(folder, &files, &[(odd, EntryType::Regular, None)])
        }
        Packaging::LinkToTheKey => {
            let link = ("camera.rs", EntryType::Symlink, Some(key));
            write_tar(folder, &files[1..], &[link])
        }
        Packaging::LinkedFolder => {
            let link = ("src", EntryType::Symlink, key.parent());
            write_tar(
                folder,
                &files,
                &[link, ("src/key", EntryType::Regular, None)],
            )
        }
        Packaging::HardLink => {
            let link = ("camera.rs", EntryType::Link, Some(key));
            write_tar(folder, &files[1..], &[link])
        }
        Packaging::Pipe => write_tar(folder, &files[1..], &[("camera.rs", EntryType::Fifo, None)]),
        Packaging::Bomb => {
            let mut files = files;
            files[0].1 = vec![b' '; 256 << 20];
            write_zip(folder, &files, None)
        }
        Packaging::ManyFiles => {
            let names = (0..1 << 16).map(|n| format!("{n}.txt"));
            let many: Vec<_> = names.map(|name| (name, Vec::new())).collect();
            write_zip(folder, &[files, many].concat(), None)
        }
        Packaging::Empty => write_archive(folder, "zip", b""),
        Packaging::OtherKind => write_archive(folder, "zip", b"Rar!\x1a\x07\x01\x00"),
        Packaging::Truncated => {
            let whole = write_zip(folder, &files, None);
            let bytes = fs::read(&whole).expect("it was written");
            fs::write(&whole, &bytes[..bytes.len() / 2]).expect("a file");
            whole
        }
        Packaging::Sparse => {
            let file = File::create(folder.join("camera.rs")).expect("a file");
            file.set_len(10 << 30).expect("a hole");
            folder.to_owned()
        }
        Packaging::OddModes => {
            for (name, mode) in [("camera.rs", 0), ("sphere.rs", 0o6777)] {
                let mode = Permissions::from_mode(mode);
                fs::set_permissions(folder.join(name), mode).expect("it is ours");
            }
            folder.to_owned()
        }
        Packaging::PipeOnDisk => {
            fs::remove_file(folder.join("camera.rs")).expect("it is ours");
            let made = Command::new("mkfifo")
                .arg(folder.join("camera.rs"))
                .status();
            assert!(made.expect("Linux has it").success());
            folder.to_owned()
        }
    }
}

type Files = Vec<(String, Vec<u8>)>;

/// The folder's files, by name.
fn read_files(folder: &Path) -> Files {
    let entries = fs::read_dir(folder).expect("it was written").flatten();
    let file = |entry: fs::DirEntry| {
        let name = entry.file_name().into_string().expect("it is ours");
        (name, fs::read(entry.path()).expect("it is a file"))
    };
    let mut files: Files = entries.map(file).collect();
    files.sort_by_key(|(name, _)| name != "camera.rs");
    files
}

fn write_archive(folder: &Path, extension: &str, bytes: &[u8]) -> PathBuf {
    let path = folder.with_extension(extension);
    fs::write(&path, bytes).expect("a file");
    path
}

fn write_zip(folder: &Path, files: &[(String, Vec<u8>)], also: Option<&str>) -> PathBuf {
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    let also = also.map(|name| (name.to_owned(), Vec::new()));
    for (name, bytes) in files.iter().chain(&also) {
        let options = SimpleFileOptions::default();
        writer.start_file(name.as_str(), options).expect("a name");
        writer.write_all(bytes).expect("there is memory");
    }
    let bytes = writer.finish().expect("it is whole").into_inner();
    write_archive(folder, "zip", &bytes)
}

type Member<'a> = (&'a str, EntryType, Option<&'a Path>);

/// Other members first: whoever unpacks one by one meets them first.
fn write_tar(folder: &Path, files: &[(String, Vec<u8>)], others: &[Member]) -> PathBuf {
    let compressed = GzEncoder::new(Vec::new(), Compression::fast());
    let mut builder = Builder::new(compressed);
    for (name, kind, target) in others {
        let mut header = header(name, *kind, 0);
        if let Some(target) = target {
            header.set_link_name(target).expect("it fits");
        }
        header.set_cksum();
        builder.append(&header, &[][..]).expect("there is memory");
    }
    for (name, bytes) in files {
        let mut header = header(name, EntryType::Regular, bytes.len());
        header.set_cksum();
        builder
            .append(&header, bytes.as_slice())
            .expect("there is memory");
    }
    let bytes = builder.into_inner().and_then(GzEncoder::finish);
    write_archive(folder, "tar.gz", &bytes.expect("it is whole"))
}

/// The name as it is: the crate's own way would refuse some.
fn header(name: &str, kind: EntryType, size: usize) -> Header {
    let mut header = Header::new_ustar();
    let place = &mut header.as_ustar_mut().expect("it is one").name;
    place[..name.len()].copy_from_slice(name.as_bytes());
    header.set_entry_type(kind);
    header.set_size(size as u64);
    header.set_mode(0o644);
    header
}
