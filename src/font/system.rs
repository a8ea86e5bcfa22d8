//! Search of a letter in the fonts of the computer. Of each font file only the table of its letters is read.

use std::env;
use std::fs::{self, File};
use std::io::{Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use skrifa::raw::tables::cmap::Cmap;
use skrifa::raw::{FontData, FontRead};

/// A font of the computer.
#[derive(Clone, Debug)]
pub struct SystemFont {
    /// The content of its file.
    pub data: Vec<u8>,
    /// The number of the font in the file, from 0.
    pub index: u32,
}

/// Directories in directories that are searched.
const MAX_DEPTH: usize = 6;
/// The largest table of letters; no font has a larger one.
const MAX_TABLE_BYTES: u32 = 8 << 20;
/// Most fonts in a file.
const MAX_FONTS: u32 = 64;

/// Finds a font of the computer that has this letter, in the usual directories of fonts.
pub fn system_font(letter: char) -> Option<SystemFont> {
    static FILES: OnceLock<Vec<PathBuf>> = OnceLock::new();
    FILES.get_or_init(|| font_files(&directories())).iter().find_map(|path| {
        let index = font_with(path, letter)?;
        Some(SystemFont { data: fs::read(path).ok()?, index })
    })
}

/// The directories of fonts on Linux, macOS and Windows; those that do not exist are passed over.
fn directories() -> Vec<PathBuf> {
    let from = |variable: &str, below: &str| env::var_os(variable).map(|path| Path::new(&path).join(below));
    let home = |below: &str| env::home_dir().map(|home| home.join(below));
    let own = [
        from("XDG_DATA_HOME", "fonts"),
        home(".local/share/fonts"),
        home(".fonts"),
        home("Library/Fonts"),
        from("LOCALAPPDATA", "Microsoft/Windows/Fonts"),
        from("WINDIR", "Fonts"),
    ];
    let shared = [
        "/usr/local/share/fonts",
        "/usr/share/fonts",
        "/run/current-system/sw/share/X11/fonts",
        "/System/Library/Fonts",
        "/Library/Fonts",
    ];
    own.into_iter().flatten().chain(shared.map(PathBuf::from)).collect()
}

/// Lists font files: sans-serif fonts first, and each group in the order of its paths.
fn font_files(directories: &[PathBuf]) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for directory in directories {
        list(directory, MAX_DEPTH, &mut files);
    }
    let preference = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy().to_lowercase();
        let has = |words: &[&str]| words.iter().any(|word| name.contains(word));
        (has(&["serif", "mono", "italic", "oblique", "symbol", "emoji"]), !has(&["regular", "sans", "gothic"]))
    };
    files.sort_by_cached_key(|path| (preference(path), path.clone()));
    files
}

fn list(directory: &Path, depth: usize, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(directory).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            if depth > 0 {
                list(&path, depth - 1, files);
            }
        } else if path.extension().is_some_and(|extension| {
            ["ttf", "otf", "ttc", "otc"].iter().any(|known| extension.eq_ignore_ascii_case(known))
        }) {
            files.push(path);
        }
    }
}

/// Returns the number of the first font in a file that has this letter.
fn font_with(path: &Path, letter: char) -> Option<u32> {
    let mut file = File::open(path).ok()?;
    let starts = font_starts(&mut file)?;
    (0..).zip(starts).find(|(_, start)| has_letter(&mut file, *start, letter).unwrap_or(false)).map(|(index, _)| index)
}

/// Returns where the fonts of a file begin: one font, or those of a collection.
fn font_starts(file: &mut File) -> Option<Vec<u32>> {
    let head: [u8; 12] = read(file, 0, 12)?.try_into().ok()?;
    if !head.starts_with(b"ttcf") {
        return Some(vec![0]);
    }
    let fonts = number(&head[8..])?.min(MAX_FONTS);
    let starts = read(file, 12, 4 * fonts)?;
    starts.chunks(4).map(number).collect()
}

/// Whether the font that begins at `start` has a letter.
fn has_letter(file: &mut File, start: u32, letter: char) -> Option<bool> {
    let head = read(file, start, 12)?;
    let tables = u32::from(u16::from_be_bytes([head[4], head[5]]));
    let directory = read(file, start.checked_add(12)?, 16 * tables)?;
    let table = directory.chunks(16).find(|table| table.starts_with(b"cmap"))?;
    let bytes = read(file, number(&table[8..])?, number(&table[12..])?)?;
    let letters = Cmap::read(FontData::new(&bytes)).ok()?;
    Some(letters.map_codepoint(letter).is_some_and(|glyph| glyph.to_u32() != 0))
}

fn read(file: &mut File, start: u32, length: u32) -> Option<Vec<u8>> {
    if length > MAX_TABLE_BYTES {
        return None;
    }
    let mut bytes = vec![0; length as usize];
    file.seek(SeekFrom::Start(start.into())).ok()?;
    file.read_exact(&mut bytes).ok()?;
    Some(bytes)
}

/// Reads the number of four bytes at the beginning.
fn number(bytes: &[u8]) -> Option<u32> {
    Some(u32::from_be_bytes(bytes.get(..4)?.try_into().ok()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::font::PLEX;

    #[test]
    fn letter_is_found_in_fonts_and_not_in_other_files() {
        let directory = tempfile::tempdir().unwrap();
        let inner = directory.path().join("truetype");
        fs::create_dir(&inner).unwrap();
        fs::write(inner.join("plex.TTF"), PLEX).unwrap();
        for cut in [0, 3, 12, 40, 5000] {
            fs::write(directory.path().join(format!("cut-{cut}.ttf")), &PLEX[..cut]).unwrap();
        }
        fs::write(directory.path().join("text.ttf"), "no font at all, but long enough to have a head").unwrap();
        fs::write(directory.path().join("readme.txt"), PLEX).unwrap();
        let files = font_files(&[directory.path().to_owned(), directory.path().join("nowhere")]);
        assert_eq!(files.len(), 7, "{files:?}");
        let found = |letter| files.iter().filter(|path| font_with(path, letter).is_some()).count();
        assert_eq!([found('é'), found('日')], [1, 0]);
        assert_eq!(font_with(&inner.join("plex.TTF"), 'é'), Some(0));
    }
}
