//! Reads whole input files.

use std::{
    borrow::Cow,
    fs::{self, File},
    io::{self, Read},
    path::Path,
};

/// Reads a file of at most `most` bytes. Pipes and devices, which may not end, are an error.
pub fn read(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    // Checked before opening, because opening a pipe would block.
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::other("not a regular file"));
    }
    let mut bytes = Vec::new();
    File::open(path)?.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(io::Error::other(format!("file is longer than {most} bytes")));
    }
    Ok(bytes)
}

/// Returns the bytes as UTF-8 without a byte order mark. UTF-16 is converted, with or without a
/// mark.
pub fn utf8(bytes: &[u8]) -> Cow<'_, [u8]> {
    let (order, rest): (fn([u8; 2]) -> u16, _) = match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => return rest.into(),
        [0xff, 0xfe, rest @ ..] => (u16::from_le_bytes, rest),
        [0xfe, 0xff, rest @ ..] => (u16::from_be_bytes, rest),
        [1..=127, 0, 1..=127, 0, ..] => (u16::from_le_bytes, bytes),
        [0, 1..=127, 0, 1..=127, ..] => (u16::from_be_bytes, bytes),
        _ => return bytes.into(),
    };
    let units = rest.as_chunks::<2>().0.iter().map(|&unit| order(unit));
    let decoded = char::decode_utf16(units).map(|unit| unit.unwrap_or(char::REPLACEMENT_CHARACTER));
    decoded.collect::<String>().into_bytes().into()
}

/// Returns the bytes as text. Names and comments may be in any encoding.
pub fn text(bytes: &[u8]) -> Cow<'_, str> {
    match utf8(bytes) {
        Cow::Borrowed(bytes) => String::from_utf8_lossy(bytes),
        Cow::Owned(bytes) => String::from_utf8_lossy(&bytes).into_owned().into(),
    }
}

/// Parses a number; NaN for what C libraries print for NaN, such as `-nan(ind)` and `1.#QNAN`.
pub fn number(word: &str) -> Option<f64> {
    let undefined = || {
        let lower = word.to_ascii_lowercase();
        let digits = lower.trim_start_matches(['+', '-']);
        (digits.starts_with("nan") || digits.starts_with("1.#")).then_some(f64::NAN)
    };
    word.parse().ok().or_else(undefined)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn read_rejects_long_files_and_devices() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("three");
        fs::write(&path, "123").unwrap();
        assert_eq!(read(&path, 3).unwrap(), b"123");
        assert_eq!(read(&path, 2).unwrap_err().to_string(), "file is longer than 2 bytes");
        assert_eq!(read(folder.path(), 3).unwrap_err().to_string(), "not a regular file");
        assert_eq!(read(&folder.path().join("none"), 3).unwrap_err().kind(), io::ErrorKind::NotFound);
    }

    #[test]
    fn utf8_byte_order_marks_and_utf16() {
        let utf16 =
            |order: fn(u16) -> [u8; 2]| "v\u{e9} 1".encode_utf16().flat_map(order).collect::<Vec<u8>>();
        let (little, big) = (utf16(u16::to_le_bytes), utf16(u16::to_be_bytes));
        for bytes in [
            "v\u{e9} 1".into(),
            "\u{feff}v\u{e9} 1".into(),
            [&[0xff, 0xfe], &little[..]].concat(),
            [&[0xfe, 0xff], &big[..]].concat(),
        ] {
            assert_eq!(text(&bytes), "v\u{e9} 1", "{bytes:x?}");
        }
        assert_eq!(text(b"v\0 \0"), "v ");
        assert_eq!(text(b"\0v\0 "), "v ");
        assert_eq!(text(b"v \xe9"), "v \u{fffd}");
    }

    #[test]
    fn number_reads_what_c_prints() {
        for (word, value) in [("-1.5e3", -1500.0), ("+2", 2.0), ("1e400", f64::INFINITY)] {
            assert_eq!(number(word), Some(value));
        }
        for word in ["nan", "-nan(ind)", "1.#QNAN", "-1.#IND", "NaN"] {
            assert!(number(word).is_some_and(f64::is_nan), "{word}");
        }
        assert_eq!([number("two"), number("1,5"), number("")], [None; 3]);
    }
}
