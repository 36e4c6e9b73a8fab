//! Reads text files in the encodings that editors and shells write.

use std::path::Path;

use super::error::SceneError;

/// Reads a text file.
pub(super) fn read_text(path: &Path) -> Result<String, SceneError> {
    String::from_utf8(read_bytes(path)?).map_err(|error| {
        let offset = error.utf8_error().valid_up_to();
        let message = format!(
            "the file is not UTF-8 text (invalid byte at offset {offset}); is it the right file?"
        );
        SceneError::new(None, message).in_file(path)
    })
}

/// Reads a text file, which may contain invalid UTF-8. Drops the byte order mark that some editors
/// put at the start of a file.
pub(super) fn read_bytes(path: &Path) -> Result<Vec<u8>, SceneError> {
    let bytes = std::fs::read(path).map_err(|error| {
        SceneError::new(None, format!("cannot read the file: {error}")).in_file(path)
    })?;
    Ok(
        match (utf_16(&bytes), bytes.strip_prefix("\u{feff}".as_bytes())) {
            (Some(text), _) => text.into_bytes(),
            (None, Some(rest)) => rest.to_owned(),
            (None, None) => bytes,
        },
    )
}

/// Decodes text that begins with a UTF-16 byte order mark, as written by PowerShell.
fn utf_16(bytes: &[u8]) -> Option<String> {
    let (pairs, []) = bytes.as_chunks::<2>() else {
        return None;
    };
    let (mark, pairs) = pairs.split_first()?;
    let decode: fn([u8; 2]) -> u16 = match mark {
        [0xff, 0xfe] => u16::from_le_bytes,
        [0xfe, 0xff] => u16::from_be_bytes,
        _ => return None,
    };
    let units: Vec<u16> = pairs.iter().copied().map(decode).collect();
    String::from_utf16(&units).ok()
}
