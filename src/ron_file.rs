//! Text files that people write, in RON, and errors that say where.

use std::fmt;
use std::fs::{self, File};
use std::io::{ErrorKind, Read};
use std::path::Path;

use ron::extensions::Extensions;
use serde::de::DeserializeOwned;

use crate::sentence::shown;

/// Larger files are none that somebody wrote.
const MAX_BYTES: u64 = 16 << 20;

/// Longer messages are cut off, in characters.
const LONGEST_MESSAGE: usize = 400;

/// Why a file cannot be had: one sentence, with line, column and field where there are such.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileError {
    /// The file, once it is known.
    pub file: Option<String>,
    /// Line and column, from 1.
    pub place: Option<(usize, usize)>,
    /// What is wrong, and what would be right.
    pub message: String,
}

impl FileError {
    /// An error at a place, if that is known, in a file that is not. What a message repeats of a file may be of any kind
    /// and length.
    pub fn new(place: Option<(usize, usize)>, message: &str) -> Self {
        Self { file: None, place, message: shown(message, LONGEST_MESSAGE) }
    }

    /// The same, of a file.
    pub fn of(self, file: &str) -> Self {
        Self { file: Some(file.to_owned()), ..self }
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{}: ", file.escape_debug())?;
        }
        if let Some((line, column)) = self.place {
            write!(f, "line {line}, column {column}: ")?;
        }
        f.write_str(&self.message)
    }
}

impl std::error::Error for FileError {}

/// The text of a file. `what` it is to be stands in errors, as does what is said if there is none.
///
/// # Errors
/// A sentence.
pub fn read(path: &Path, what: &str, none: impl FnOnce() -> String) -> Result<String, String> {
    // Looked at before it is opened, since opening a pipe waits for somebody to write.
    let data = fs::metadata(path).map_err(|error| match error.kind() {
        ErrorKind::NotFound => none(),
        _ => format!("the file cannot be found: {error}"),
    })?;
    if data.is_dir() {
        return Err(format!("this is a directory, not a {what} file"));
    }
    if !data.is_file() {
        return Err("this is not a regular file".into());
    }
    let file = File::open(path).map_err(|error| format!("the file cannot be opened: {error}"))?;
    let mut bytes = Vec::new();
    // A file may grow while it is read.
    file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(|error| format!("the file cannot be read: {error}"))?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(format!("the file is larger than {} MiB; that is no {what}", MAX_BYTES >> 20));
    }
    String::from_utf8(bytes).map_err(|error| {
        let line = error.as_bytes()[..error.utf8_error().valid_up_to()].split(|&byte| byte == b'\n').count();
        format!("line {line}: the file is not text (UTF-8)")
    })
}

/// Reads the text of a file: `what` it is stands in errors, `least` what such a file needs at least, and `deep` what is to
/// be done if it is nested too deep.
///
/// # Errors
/// The first thing that is wrong, with its line, its column and its field.
pub fn parse<T: DeserializeOwned>(text: &str, what: &str, least: &str, deep: &str) -> Result<T, FileError> {
    // Some editors begin a file with this mark.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim().is_empty() {
        return Err(FileError::new(None, &format!("the file is empty; a {what} needs at least {least}")));
    }
    let at = |position: ron::error::Position| Some((position.line, position.col));
    let options = ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
    let mut reader = ron::Deserializer::from_str_with_options(text, &options)
        .map_err(|wrong| FileError::new(at(wrong.span.end), &wrong.code.to_string()))?;
    let file = serde_path_to_error::deserialize(&mut reader).map_err(|wrong| {
        let path = wrong.path().to_string();
        let spanned = reader.span_error(wrong.into_inner());
        let place = at(spanned.span.end);
        if spanned.code == ron::Error::ExceededRecursionLimit {
            return FileError::new(place, deep);
        }
        // A field that was not read to its end has no name yet.
        let path = path.trim_end_matches(['?', '.']);
        let field = if path.is_empty() { String::new() } else { format!("{path}: ") };
        FileError::new(place, &format!("{field}{}", spanned.code))
    })?;
    reader.end().map_err(|wrong| {
        let spanned = reader.span_error(wrong);
        FileError::new(at(spanned.span.end), &format!("something follows the end of the {what}"))
    })?;
    Ok(file)
}

/// How long the comment or the string is that begins here, if one does.
pub fn skipped(rest: &str) -> Option<usize> {
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
pub fn find_name(text: &str, name: &str) -> Option<(usize, usize)> {
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
