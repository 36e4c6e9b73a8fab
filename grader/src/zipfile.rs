//! Zips: the directory at the end says what is in one, and only what is wanted is inflated. Nothing
//! is unpacked to a disk.

use std::io::Read;

use flate2::read::DeflateDecoder;
use rawzip::{
    CompressionMethod, RECOMMENDED_BUFFER_SIZE, ReaderAt, ZipArchive, ZipArchiveEntryWayfinder,
    ZipFileHeaderRecord, ZipLocator,
};

/// What the upper half of the bytes means in a name that is no UTF-8: code page 437, which the format
/// was made with. PKWARE's APPNOTE.TXT, appendix D.
const CODE_PAGE_437: &str = "ÇüéâäàåçêëèïîìÄÅÉæÆôöòûùÿÖÜ¢£¥₧ƒáíóúñÑªº¿⌐¬½¼¡«»░▒▓│┤╡╢╖╕╣║╗╝╜╛┐\
    └┴┬├─┼╞╟╚╔╩╦╠═╬╧╨╤╥╙╘╒╓╫╪┘┌█▄▌▐▀αßΓπΣσµτΦΘΩδ∞φε∩≡±≥≤⌠⌡÷≈°∙·√ⁿ²■\u{a0}";

/// A zip, its directory read.
#[derive(Debug)]
pub struct Zip<R> {
    archive: ZipArchive<R>,
    /// What is in it, in the order of its directory.
    pub entries: Vec<Entry>,
}

/// What a directory says of a file or folder.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntryKind {
    /// A file.
    File,
    /// A folder.
    Folder,
    /// A link or a device.
    Special,
}

/// One file or folder.
#[derive(Debug)]
pub struct Entry {
    /// As it stands there, whatever that leads to.
    pub name: String,
    /// What it is.
    pub kind: EntryKind,
    /// Who may read, write and run it: nine bits, as Unix has them.
    pub permissions: u32,
    method: CompressionMethod,
    is_encrypted: bool,
    wayfinder: ZipArchiveEntryWayfinder,
}

/// Why a zip, or one file in it, can not be read.
#[derive(Debug, thiserror::Error)]
pub enum ZipError {
    /// It ends too soon, or is not what it claims to be.
    #[error("{0}")]
    Damaged(#[from] rawzip::Error),
    /// Its directory is longer or shorter than its end says.
    #[error("its directory holds another number of files than it says")]
    WrongCount,
    /// It holds more than was to be read.
    #[error("it holds more than {0} files")]
    TooManyEntries(usize),
    /// A file is encrypted.
    #[error("it needs a password")]
    Encrypted,
    /// A file is compressed in a way that is rarely used.
    #[error("it is compressed in a way of its own")]
    UnsupportedMethod,
}

impl<R: ReaderAt> Zip<R> {
    /// Reads the directory of a zip of so many bytes, of at most so many entries.
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
        // What is cut out of a directory would else be missing without a word.
        if archive.entries_hint() != entries.len() as u64 {
            return Err(ZipError::WrongCount);
        }
        Ok(Zip { archive, entries })
    }

    /// The bytes of one of the entries; at their end it is known whether they are whole.
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
            method: header.compression_method(),
            is_encrypted: header.flags().is_encrypted(),
            wayfinder: header.wayfinder(),
        }
    }
}

/// Those who write UTF-8 do not always say so.
fn decode_name(bytes: &[u8]) -> String {
    let of_byte = |byte: &u8| match byte.checked_sub(128) {
        None => char::from(*byte),
        Some(place) => CODE_PAGE_437
            .chars()
            .nth(place.into())
            .expect("there are 128"),
    };
    match str::from_utf8(bytes) {
        Ok(name) => name.to_owned(),
        Err(_) => bytes.iter().map(of_byte).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::{CODE_PAGE_437, decode_name};

    #[test]
    fn decodes_names_as_utf8_or_code_page_437() {
        assert_eq!(CODE_PAGE_437.chars().count(), 128);
        assert_eq!(decode_name("Jürgen/bvh.rs".as_bytes()), "Jürgen/bvh.rs");
        assert_eq!(decode_name(b"J\x81rgen/\xe1.rs"), "Jürgen/ß.rs");
    }
}
