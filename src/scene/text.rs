//! The text of a scene file, and places in it.

use std::fs::{self, File};
use std::io::Read;
use std::path::Path;

use super::BUILT_IN;

/// Files larger than this are no scenes.
const MAX_BYTES: u64 = 16 << 20;

/// The text of a scene file; errors are sentences.
pub(super) fn read(path: &Path) -> Result<String, String> {
    // Looked at before it is opened, since opening a pipe waits for somebody to write.
    let data = fs::metadata(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => {
            let names: Vec<_> = BUILT_IN.iter().map(|(name, _)| *name).collect();
            format!("there is no such file, and no built-in scene of that name (they are {})", names.join(", "))
        }
        _ => format!("the file cannot be found: {error}"),
    })?;
    if data.is_dir() {
        return Err("this is a directory, not a scene file".into());
    }
    if !data.is_file() {
        return Err("this is not a regular file".into());
    }
    let file = File::open(path).map_err(|error| format!("the file cannot be opened: {error}"))?;
    let mut bytes = Vec::new();
    // A file may grow while it is read.
    file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(|error| format!("the file cannot be read: {error}"))?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(format!("the file is larger than {} MiB; that is no scene", MAX_BYTES >> 20));
    }
    String::from_utf8(bytes).map_err(|error| {
        let line = error.as_bytes()[..error.utf8_error().valid_up_to()].split(|&byte| byte == b'\n').count();
        format!("line {line}: the file is not text (UTF-8)")
    })
}

/// How long the comment or the string is that begins here, if one does.
pub(super) fn skipped(rest: &str) -> Option<usize> {
    if rest.starts_with("//") {
        return Some(rest.find('\n').unwrap_or(rest.len()));
    }
    if rest.starts_with("/*") {
        return Some(rest.find("*/").map_or(rest.len(), |end| end + 2));
    }
    let string = rest.strip_prefix('"')?;
    let mut escaped = false;
    for (at, c) in string.char_indices() {
        match c {
            '"' if !escaped => return Some(at + 2),
            _ => escaped = c == '\\' && !escaped,
        }
    }
    Some(rest.len())
}

/// Line and column, from 1, of the first string `name` outside comments.
pub(super) fn find_name(text: &str, name: &str) -> Option<(usize, usize)> {
    let quoted = format!("\"{name}\"");
    let mut rest = text;
    while !rest.is_empty() {
        if rest.starts_with(&quoted) {
            let before = &text[..text.len() - rest.len()];
            let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
            return Some((before.matches('\n').count() + 1, before[line_start..].chars().count() + 1));
        }
        let skipped = skipped(rest).or_else(|| rest.chars().next().map(char::len_utf8)).unwrap_or(1);
        rest = &rest[skipped..];
    }
    None
}
