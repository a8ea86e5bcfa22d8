//! Paths in the stored state of the window, which is text. A path need not be UTF-8.

use std::path::{Path, PathBuf};

/// Marks a path that is not UTF-8; no path has this character. The path's bytes follow in hexadecimal digits.
const MARK: char = '\0';

/// Writes a path as text.
pub fn write(path: &Path) -> String {
    let bytes = || path.as_os_str().as_encoded_bytes().iter().map(|byte| format!("{byte:02x}")).collect::<String>();
    path.to_str().map_or_else(|| format!("{MARK}{}", bytes()), str::to_owned)
}

/// Reads a path that [`write`] has written.
pub fn read(text: &str) -> PathBuf {
    text.strip_prefix(MARK).map_or_else(|| text.into(), from_hexadecimal)
}

#[cfg(unix)]
fn from_hexadecimal(digits: &str) -> PathBuf {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    let byte = |pair: &[u8]| str::from_utf8(pair).ok().and_then(|pair| u8::from_str_radix(pair, 16).ok());
    let bytes: Vec<u8> = digits.as_bytes().chunks(2).filter_map(byte).collect();
    OsStr::from_bytes(&bytes).into()
}

/// Other systems have no bytes in their paths; such a path is not found.
#[cfg(not(unix))]
fn from_hexadecimal(digits: &str) -> PathBuf {
    digits.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn path_is_read_as_it_was_written() {
        for path in ["/home/é/a b.ron", "ten-objects", ""] {
            assert_eq!((write(Path::new(path)), read(path)), (path.to_owned(), PathBuf::from(path)));
        }
        #[cfg(unix)]
        {
            use std::os::unix::ffi::OsStrExt;
            let path = Path::new(std::ffi::OsStr::from_bytes(b"/tmp/caf\xe9/x.ron"));
            assert_eq!(read(&write(path)), path);
        }
    }
}
