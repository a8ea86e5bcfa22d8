//! RON files that people write, and errors that say where.

mod decimal_comma;

use std::fmt;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

use ron::extensions::Extensions;
use serde::de::DeserializeOwned;
use serde_path_to_error::Segment;
use thiserror::Error;

use crate::sentence::shown;

/// The greatest size of a file: people write none that is larger.
const MAX_BYTES: u64 = 16 << 20;

/// The greatest length of a message, in characters; longer ones are cut off.
const MAX_MESSAGE_CHARS: usize = 400;

/// An error in a file: one sentence, with file, line, column and field where they are known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileError {
    /// The file's path, if known.
    pub file: Option<String>,
    /// Line and column, from 1.
    pub position: Option<(usize, usize)>,
    /// What is wrong, and what would be right.
    pub message: String,
}

impl FileError {
    /// An error without a file name. `message` may repeat text of the file, of any kind and length: it is put on one
    /// line and cut off.
    pub fn new(position: Option<(usize, usize)>, message: &str) -> Self {
        Self { file: None, position, message: shown(message, MAX_MESSAGE_CHARS) }
    }

    /// The same error with the file's path.
    pub fn in_file(self, file: &Path) -> Self {
        Self { file: Some(file.to_string_lossy().into_owned()), ..self }
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(f, "{}: ", file.escape_debug())?;
        }
        if let Some((line, column)) = self.position {
            write!(f, "line {line}, column {column}: ")?;
        }
        f.write_str(&self.message)
    }
}

impl std::error::Error for FileError {}

/// Why a text file could not be loaded.
#[derive(Debug, Error)]
pub enum ReadError {
    /// There is no file at the path, and no built-in one of that name.
    #[error("there is no such file, and no built-in {what} of that name (the built-in names are {known})")]
    Missing {
        /// What the file was to be.
        what: &'static str,
        /// The names of the built-in ones.
        known: String,
    },
    /// The path cannot be looked up.
    #[error("the file cannot be found: {0}")]
    Find(io::Error),
    /// The path names a directory.
    #[error("this is a directory, not a {0} file")]
    Directory(&'static str),
    /// The path names a device, a pipe or a socket.
    #[error("this is not a regular file")]
    NotRegular,
    /// The file cannot be opened.
    #[error("the file cannot be opened: {0}")]
    Open(io::Error),
    /// Reading failed.
    #[error("the file cannot be read: {0}")]
    Read(io::Error),
    /// Larger than 16 MiB.
    #[error("the file is larger than {max} MiB, which is too large for a {0}", max = MAX_BYTES >> 20)]
    TooLarge(&'static str),
    /// The line of this number, from 1, is not UTF-8.
    #[error("line {0}: the file is not text (UTF-8)")]
    NotText(usize),
    /// The text has another encoding.
    #[error("the file is text in UTF-16; save it as UTF-8")]
    Utf16,
}

impl From<ReadError> for FileError {
    fn from(error: ReadError) -> Self {
        Self::new(None, &error.to_string())
    }
}

/// Reads the text of a file. `what` names the kind of file in errors, and `built_in` lists the built-in ones for the
/// error that there is no such file.
///
/// # Errors
/// A [`ReadError`], without the file's path.
pub fn read<'a>(
    path: &Path,
    what: &'static str,
    built_in: impl IntoIterator<Item = &'a str>,
) -> Result<String, ReadError> {
    // The kind of file is checked before it is opened, since opening a pipe waits for a writer.
    let data = fs::metadata(path).map_err(|error| match error.kind() {
        ErrorKind::NotFound => ReadError::Missing { what, known: built_in.into_iter().collect::<Vec<_>>().join(", ") },
        _ => ReadError::Find(error),
    })?;
    if data.is_dir() {
        return Err(ReadError::Directory(what));
    }
    if !data.is_file() {
        return Err(ReadError::NotRegular);
    }
    let file = File::open(path).map_err(ReadError::Open)?;
    let mut bytes = Vec::new();
    // A file may grow while it is read.
    file.take(MAX_BYTES + 1).read_to_end(&mut bytes).map_err(ReadError::Read)?;
    if bytes.len() as u64 > MAX_BYTES {
        return Err(ReadError::TooLarge(what));
    }
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err(ReadError::Utf16);
    }
    // Some editors put a byte order mark at the beginning of a file.
    let text = bytes.strip_prefix("\u{feff}".as_bytes()).unwrap_or(&bytes);
    String::from_utf8(text.to_vec()).map_err(|error| {
        let line = error.as_bytes()[..error.utf8_error().valid_up_to()].split(|&byte| byte == b'\n').count();
        ReadError::NotText(line)
    })
}

/// Parses the text of a file. `what` names the kind of file in errors, `least` the parts that it needs, and `deep` is
/// the error if its nesting is too deep.
///
/// # Errors
/// The first mistake, with its line, column and field.
pub fn parse<T: DeserializeOwned>(text: &str, what: &str, least: &str, deep: &str) -> Result<T, FileError> {
    // The text of a scene in a run file may begin with a byte order mark.
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim().is_empty() {
        return Err(FileError::new(None, &format!("the file is empty; a {what} needs at least {least}")));
    }
    let at = |position: ron::error::Position| Some((position.line, position.col));
    let options = ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME);
    let mut reader = ron::Deserializer::from_str_with_options(text, &options)
        .map_err(|error| FileError::new(at(error.span.end), &error.code.to_string()))?;
    let file = serde_path_to_error::deserialize(&mut reader).map_err(|error| {
        let field = field(error.path());
        let spanned = reader.span_error(error.into_inner());
        let position = at(spanned.span.end);
        if spanned.code == ron::Error::ExceededRecursionLimit {
            return FileError::new(position, deep);
        }
        // A number outside its range may be the part before the comma, as in `tube: 0,25`.
        let is_range = matches!(spanned.code, ron::Error::Message(_));
        let place = position.map(|position| byte_offset(text, position));
        let place = place.filter(|&place| !is_range || text[place..].starts_with(','));
        if let Some(number) = place.and_then(|place| decimal_comma::find(text, place)) {
            let point = number.replace(',', ".");
            return FileError::new(position, &format!("{field}a decimal mark is a point: write {point}, not {number}"));
        }
        FileError::new(position, &format!("{field}{}", spanned.code))
    })?;
    reader.end().map_err(|error| {
        let spanned = reader.span_error(error);
        FileError::new(at(spanned.span.end), &format!("something follows the end of the {what}; remove it"))
    })?;
    Ok(file)
}

/// The length in bytes of the comment or string at the beginning of `rest`, if there is one.
pub fn comment_or_string_length(rest: &str) -> Option<usize> {
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

/// Finds the first string `name` outside comments. Returns line and column, from 1.
pub fn find_name(text: &str, name: &str) -> Option<(usize, usize)> {
    let quoted = format!("\"{name}\"");
    let mut rest = text;
    while !rest.is_empty() {
        if rest.starts_with(&quoted) {
            return Some(line_and_column(text, text.len() - rest.len()));
        }
        let comment_or_string_length =
            comment_or_string_length(rest).or_else(|| rest.chars().next().map(char::len_utf8)).unwrap_or(1);
        rest = &rest[comment_or_string_length..];
    }
    None
}

/// Finds the value at a path of field names, map keys and list indices (from 0). Returns line and column, from 1, of
/// the deepest part of the path that exists.
pub fn find_path(text: &str, path: &[String]) -> Option<(usize, usize)> {
    let found = path.iter().try_fold(0, |from, step| find_item(text, from, step).ok_or(from));
    let (Ok(at) | Err(at)) = found;
    (at > 0).then(|| line_and_column(text, at))
}

/// The byte offset of a line and column, from 1.
fn byte_offset(text: &str, (line, column): (usize, usize)) -> usize {
    let line: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    let columns = text[line..].char_indices().map(|(at, _)| at).chain([text.len() - line]);
    line + columns.take(column).last().unwrap_or(0)
}

/// The line and column, from 1, of a byte offset.
fn line_and_column(text: &str, at: usize) -> (usize, usize) {
    let before = &text[..at];
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (before.matches('\n').count() + 1, before[line_start..].chars().count() + 1)
}

/// Finds an item of the first brackets after `from`. Returns its byte offset.
fn find_item(text: &str, from: usize, step: &str) -> Option<usize> {
    let (mut at, mut depth, mut number) = (from, 0_usize, 0_usize);
    let (mut is_list, mut begins) = (false, false);
    while let Some(c) = text[at..].chars().next() {
        let rest = &text[at..];
        let is_comment = rest.starts_with("//") || rest.starts_with("/*");
        if begins && !is_comment && !c.is_whitespace() {
            let is_match = if is_list { step == number.to_string() } else { is_named(rest, step) };
            if is_match {
                return Some(at);
            }
            begins = false;
        }
        match c {
            '(' | '[' | '{' => {
                depth += 1;
                if depth == 1 {
                    (is_list, begins) = (c == '[', true);
                }
            }
            ')' | ']' | '}' if depth <= 1 => return None,
            ')' | ']' | '}' => depth -= 1,
            ',' if depth == 1 => (number, begins) = (number + 1, true),
            _ => {}
        }
        at += comment_or_string_length(rest).unwrap_or(c.len_utf8());
    }
    None
}

/// Whether `rest` begins with a field or a map entry of this name.
fn is_named(rest: &str, name: &str) -> bool {
    let after = rest.strip_prefix(name).or_else(|| rest.strip_prefix('"')?.strip_prefix(name)?.strip_prefix('"'));
    after.is_some_and(|after| after.trim_start().starts_with(':'))
}

/// Formats a path for an error, as in `object 2, Sphere.radius: `, with numbers from 1. Empty for an empty path.
fn field(path: &serde_path_to_error::Path) -> String {
    let mut field = String::new();
    for segment in path {
        let name = match segment {
            Segment::Seq { index } => {
                // The singular, for one item of a list.
                let one = field.strip_suffix('s').unwrap_or(&field);
                field = format!("{one} {}", index + 1);
                continue;
            }
            Segment::Map { key } => key,
            Segment::Enum { variant } => variant,
            // A part that was not read to its end has no name yet.
            Segment::Unknown => continue,
        };
        let between = match field.chars().last() {
            None => "",
            Some(last) if last.is_ascii_digit() => ", ",
            Some(_) => ".",
        };
        field = format!("{field}{between}{name}");
    }
    if field.is_empty() { field } else { field + ": " }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn find_path_skips_comments_and_strings() {
        let text = "A(\n  title: \"steps: [(\", // steps: [\n  steps: [(run: \"x\"), /* , */ (run : \"y\", at: (1, 2))],\n  \
                    of: {\"a b\": (n: 1)},\n)";
        let found = |path: &[&str]| find_path(text, &path.iter().map(|&step| step.to_owned()).collect::<Vec<_>>());
        assert_eq!(found(&["steps", "0"]), Some((3, 11)));
        assert_eq!(found(&["steps", "1", "run"]), Some((3, 32)));
        assert_eq!(found(&["of", "a b", "n"]), Some((4, 16)));
        assert_eq!(found(&["steps", "1", "none"]), found(&["steps", "1"]));
        assert_eq!(found(&["none"]), None);
    }
}
