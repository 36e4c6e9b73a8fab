//! Reads zip archives. The central directory at the end lists the contents, and only requested
//! entries are inflated. Nothing is written to disk.

use std::io::Read;

use flate2::read::DeflateDecoder;
use rawzip::{
    CompressionMethod, RECOMMENDED_BUFFER_SIZE, ReaderAt, ZipArchive, ZipArchiveEntryWayfinder,
    ZipFileHeaderRecord, ZipLocator,
};
use yore::code_pages::CP437;

/// A zip archive whose central directory has been read.
#[derive(Debug)]
pub struct Zip<R> {
    archive: ZipArchive<R>,
    /// The archive's entries, in the order of the directory.
    pub entries: Vec<Entry>,
}

/// The kind of an entry, according to the directory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntryKind {
    /// A regular file.
    File,
    /// A folder.
    Folder,
    /// A link or a device.
    Special,
}

/// A file, folder, link or device in a zip.
#[derive(Debug)]
pub struct Entry {
    /// The recorded name. It may be a path that leads out of the folder into which the zip is
    /// unpacked.
    pub name: String,
    /// The kind of the entry.
    pub kind: EntryKind,
    /// The nine Unix permission bits.
    pub permissions: u32,
    /// The size declared in the zip, in bytes.
    pub size: u64,
    method: CompressionMethod,
    is_encrypted: bool,
    wayfinder: ZipArchiveEntryWayfinder,
}

/// Reasons for rejecting a zip or an entry.
#[derive(Debug, thiserror::Error)]
pub enum ZipError {
    /// The zip is truncated or malformed.
    #[error("{0}")]
    Damaged(#[from] rawzip::Error),
    /// The directory has more or fewer entries than the zip declares.
    #[error("its directory lists fewer files than it should")]
    WrongCount,
    /// The zip has too many entries.
    #[error("it has more than {0} files")]
    TooManyEntries(usize),
    /// The entry is encrypted.
    #[error("it is password-protected")]
    Encrypted,
    /// The entry's compression method is rare and not supported.
    #[error("its compression method is not supported")]
    UnsupportedMethod,
}

impl<R: ReaderAt> Zip<R> {
    /// Reads the directory of a zip that is `length` bytes long. Fails if there are more than
    /// `most` entries.
    pub fn open(bytes: R, length: u64, most: usize) -> Result<Self, ZipError> {
        let mut buffer = vec![0; RECOMMENDED_BUFFER_SIZE];
        let located = ZipLocator::new().locate_in_reader(bytes, &mut buffer, length);
        let archive = located.map_err(|(_, error)| error)?;
        let mut entries = Vec::new();
        let mut directory = archive.entries(&mut buffer);
        while let Some(header) = directory.next_entry()? {
            if entries.len() == most {
                return Err(ZipError::TooManyEntries(most));
            }
            entries.push(Entry::new(&header));
        }
        // Without this check, entries missing from the directory would go unnoticed.
        if archive.entries_hint() != entries.len() as u64 {
            return Err(ZipError::WrongCount);
        }
        Ok(Zip { archive, entries })
    }

    /// Returns a reader for an entry's contents. Damage is only reported once the contents have
    /// been read to the end.
    pub fn read(&self, entry: &Entry) -> Result<impl Read + '_, ZipError> {
        if entry.is_encrypted {
            return Err(ZipError::Encrypted);
        }
        let found = self.archive.get_entry(entry.wayfinder)?;
        let packed = found.reader();
        let bytes: Box<dyn Read> = match entry.method {
            CompressionMethod::STORE => Box::new(packed),
            CompressionMethod::DEFLATE => Box::new(DeflateDecoder::new(packed)),
            _ => return Err(ZipError::UnsupportedMethod),
        };
        Ok(found.verifying_reader(bytes))
    }
}

impl Entry {
    fn new(header: &ZipFileHeaderRecord) -> Self {
        let mode = header.mode();
        Entry {
            name: decode_name(header.file_path().as_bytes()),
            kind: match mode.value() & 0o170_000 {
                _ if header.is_dir() => EntryKind::Folder,
                0o040_000 => EntryKind::Folder,
                0 | 0o100_000 => EntryKind::File,
                _ => EntryKind::Special,
            },
            permissions: mode.permissions(),
            size: header.uncompressed_size_hint(),
            method: header.compression_method(),
            is_encrypted: header.flags().is_encrypted(),
            wayfinder: header.wayfinder(),
        }
    }
}

/// Decodes a name. UTF-8 is tried even if the flag for it isn't set, since not every program sets
/// the flag. Names that aren't valid UTF-8 are decoded as code page 437, the original encoding of
/// the format (PKWARE's APPNOTE.TXT, appendix D).
fn decode_name(bytes: &[u8]) -> String {
    match str::from_utf8(bytes) {
        Ok(name) => name.to_owned(),
        Err(_) => bytes.iter().map(|byte| CP437.decode_byte(*byte)).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::decode_name;

    #[test]
    fn decodes_names_as_utf8_or_code_page_437() {
        assert_eq!(decode_name("Jürgen/bvh.rs".as_bytes()), "Jürgen/bvh.rs");
        assert_eq!(decode_name(b"J\x81rgen/\xe1.rs"), "Jürgen/ß.rs");
    }
}
