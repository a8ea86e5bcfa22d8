//! Atomic writing of files: a file is complete or does not exist.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;
use thiserror::Error;

/// Why a file could not be written.
#[derive(Debug, Error)]
pub enum OutputError {
    /// The path can never hold the file. This is found before the content is made.
    #[error("cannot write {path}: {problem}")]
    Path {
        /// The path of the file.
        path: PathBuf,
        /// What is wrong with it.
        problem: PathProblem,
    },
    /// Writing failed, for instance because the disk is full. The partial file has been removed.
    #[error("writing {path} failed, nothing of it was kept: {source}")]
    Write {
        /// The path of the file.
        path: PathBuf,
        /// The system's error.
        source: io::Error,
    },
}

/// Why a path can never hold the file.
#[derive(Debug, PartialEq, Eq, Error)]
pub enum PathProblem {
    /// The path ends in a separator, `.` or `..`.
    #[error("it does not name a file")]
    NoFileName,
    /// The ending of the name stands for another format.
    #[error("the file will be {format}, not .{ending}; give its name the ending .{own}")]
    OtherFormat {
        /// The format that is written.
        format: &'static str,
        /// The ending of the name.
        ending: String,
        /// The usual ending of the format.
        own: &'static str,
    },
    /// No usual file system takes so long a name.
    #[error("its name is longer than {MAX_NAME_BYTES} bytes")]
    LongName,
    /// The path names a directory.
    #[error("it is a directory; name a file in it")]
    Directory,
    /// The path names a device, a pipe or a socket.
    #[error("it is not a regular file")]
    NotRegular,
    /// The file is write-protected.
    #[error("it is read-only")]
    ReadOnly,
    /// The path is a symbolic link to nothing.
    #[error("it is a link that leads nowhere")]
    DanglingLink,
    /// The file's directory is missing.
    #[error("its directory does not exist")]
    NoDirectory,
    /// What else the system says. The kind alone: the error itself would name the temporary file.
    #[error("{0}")]
    System(io::ErrorKind),
}

/// The longest file name of all usual file systems.
const MAX_NAME_BYTES: usize = 255;

/// Endings of well-known formats. A name with another ending, such as `picture.v2`, says nothing about the format.
const KNOWN_ENDINGS: &[&str] = &[
    "anel", "apng", "avif", "avi", "bmp", "csv", "doc", "docx", "eps", "exr", "gif", "heic", "hdr", "htm", "html",
    "ico", "ini", "jfif", "jpe", "jpeg", "jpg", "json", "jsonl", "jxl", "md", "mkv", "mov", "mp4", "ods", "odt", "pbm",
    "pdf", "pgm", "png", "pnm", "pov", "ppm", "ps", "psd", "qoi", "ron", "svg", "svgz", "tga", "tif", "tiff", "tsv",
    "webm", "webp", "xcf", "xls", "xlsx", "xml", "zip",
];

/// The paths of the temporary files of this process. Whoever makes, renames or removes one holds the lock.
static TEMPORARY_FILES: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Checks that a file can be written to `path`, before its content is made.
///
/// # Errors
/// [`OutputError::Path`] if `path` is a directory or a device, its name is impossible, or its directory is
/// missing or read-only.
pub fn check_writable(path: &Path) -> Result<(), OutputError> {
    begin(path).map(drop)
}

/// Writes the output of `fill` to `path`, atomically: the file appears complete, and until then an existing one stays.
///
/// # Errors
/// [`OutputError::Path`] as [`check_writable`]; [`OutputError::Write`] with the system's error.
pub fn write_whole(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
) -> Result<(), OutputError> {
    let (mut file, target) = begin(path)?;
    let write = || {
        let mut buffer = BufWriter::new(file.file_mut());
        fill(&mut buffer)?;
        buffer.flush()?;
        drop(buffer);
        // The permissions of an existing file stay.
        if let Ok(before) = fs::metadata(&target) {
            file.file_mut().set_permissions(before.permissions())?;
        }
        // Some systems report a full disk only here.
        file.file_mut().sync_all()?;
        file.complete(&target)
    };
    write().map_err(|source| OutputError::Write { path: path.to_owned(), source })
}

/// Checks that the ending of `path` does not stand for another format than the one that is written. `format` names that
/// format, and `endings` are its endings; the first is the usual one. A name without an ending is valid.
///
/// # Errors
/// [`OutputError::Path`], if the ending is that of another well-known format.
pub fn check_ending(path: &Path, format: &'static str, endings: &[&'static str]) -> Result<(), OutputError> {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
    if endings.contains(&&*ending) || !KNOWN_ENDINGS.contains(&&*ending) {
        return Ok(());
    }
    let own = endings.first().copied().unwrap_or_default();
    Err(OutputError::Path { path: path.to_owned(), problem: PathProblem::OtherFormat { format, ending, own } })
}

/// Removes the temporary files of this process, which ends now: no file can be begun or completed afterwards.
pub fn remove_temporary_files() {
    let files = lock();
    for file in files.iter() {
        // It may be gone already.
        let _ = fs::remove_file(file);
    }
    // The lock is never released, so that no thread makes or renames a temporary file until the process ends.
    std::mem::forget(files);
}

/// Makes a name safe as part of a file name: replaces characters with a meaning to file systems by hyphens, and cuts
/// off long names.
pub fn as_file_name(name: &str) -> String {
    const MAX_NAME_CHARS: usize = 60;
    let plain = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '-' };
    let name: String = name.chars().take(MAX_NAME_CHARS).map(plain).collect();
    // Files whose names begin with a dot are hidden.
    let name = name.trim_start_matches('.');
    if name.is_empty() { "picture".into() } else { name.into() }
}

/// Whether two paths name the same file, as far as this is known before both exist.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    let place = |path: &Path| {
        let whole = fs::canonicalize(path);
        whole.or_else(|_| {
            Ok::<_, io::Error>(fs::canonicalize(directory_of(path))?.join(path.file_name().unwrap_or_default()))
        })
    };
    matches!((place(a), place(b)), (Ok(a), Ok(b)) if a == b)
}

/// A temporary file beside the final path of `path`, and that path.
fn begin(path: &Path) -> Result<(TemporaryFile, PathBuf), OutputError> {
    let refuse = |problem| OutputError::Path { path: path.to_owned(), problem };
    let target = target(path).map_err(refuse)?;
    let file = TemporaryFile::beside(&target).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound => refuse(PathProblem::NoDirectory),
        kind => refuse(PathProblem::System(kind)),
    })?;
    Ok((file, target))
}

/// The final path of a file: `path`, or behind a symbolic link the file that it leads to.
fn target(path: &Path) -> Result<PathBuf, PathProblem> {
    let ends_as_directory = path.to_string_lossy().ends_with(std::path::is_separator);
    let Some(name) = path.file_name().filter(|_| !ends_as_directory) else {
        return Err(PathProblem::NoFileName);
    };
    if name.len() > MAX_NAME_BYTES {
        return Err(PathProblem::LongName);
    }
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(PathProblem::Directory),
        // Renaming a file onto a device would replace the device.
        Ok(found) if !found.is_file() => Err(PathProblem::NotRegular),
        Ok(found) if found.permissions().readonly() => Err(PathProblem::ReadOnly),
        Ok(_) => fs::canonicalize(path).map_err(|error| PathProblem::System(error.kind())),
        Err(_) if path.is_symlink() => Err(PathProblem::DanglingLink),
        Err(_) => Ok(path.to_owned()),
    }
}

fn directory_of(path: &Path) -> &Path {
    path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A temporary file that is removed when dropped, and by [`remove_temporary_files`].
struct TemporaryFile {
    /// `None` once it is renamed or removed.
    file: Option<NamedTempFile>,
}

impl TemporaryFile {
    /// Makes a file in the directory of `path`, so that it can be renamed to it.
    fn beside(path: &Path) -> io::Result<Self> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".anel-").suffix(".part");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // The umask decides who can read it; temporary files are private by default.
            builder.permissions(fs::Permissions::from_mode(0o666));
        }
        let mut files = lock();
        let file = builder.tempfile_in(directory_of(path))?;
        files.insert(file.path().to_owned());
        Ok(Self { file: Some(file) })
    }

    fn file_mut(&mut self) -> &mut File {
        self.file.as_mut().expect("only `complete` and `drop` take the file").as_file_mut()
    }

    /// Renames the file to `target`.
    fn complete(mut self, target: &Path) -> io::Result<()> {
        let mut files = lock();
        let Some(file) = self.file.take() else { return Ok(()) };
        files.remove(file.path());
        // If this fails the error has the file, which is removed with it.
        file.persist(target)?;
        Ok(())
    }
}

impl Drop for TemporaryFile {
    fn drop(&mut self) {
        if let Some(file) = self.file.take() {
            let mut files = lock();
            files.remove(file.path());
            drop(file);
        }
    }
}

fn lock() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    // The set is valid even if a thread has panicked.
    TEMPORARY_FILES.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use tempfile::TempDir;

    #[test]
    #[cfg(unix)]
    fn devices_are_kept_and_links_are_followed() {
        let directory = TempDir::new().unwrap();
        let at = |name: &str| directory.path().join(name);
        let write = |path: &Path| write_whole(path, |file| file.write_all(b"new"));
        std::os::unix::fs::symlink("/dev/null", at("device")).unwrap();
        assert!(matches!(write(&at("device")), Err(OutputError::Path { .. })));
        fs::write(at("file"), "old").unwrap();
        std::os::unix::fs::symlink(at("file"), at("link")).unwrap();
        write(&at("link")).unwrap();
        assert!(at("link").is_symlink());
        assert_eq!(fs::read_to_string(at("file")).unwrap(), "new");
        std::os::unix::fs::symlink(at("nothing"), at("dangling")).unwrap();
        assert!(matches!(check_writable(&at("dangling")), Err(OutputError::Path { .. })));
    }

    #[test]
    #[cfg(unix)]
    fn permissions_of_replaced_file_stay() {
        use std::os::unix::fs::PermissionsExt;
        let directory = TempDir::new().unwrap();
        let path = directory.path().join("file");
        for mode in [0o600, 0o664] {
            fs::write(&path, "old").unwrap();
            fs::set_permissions(&path, fs::Permissions::from_mode(mode)).unwrap();
            write_whole(&path, |file| file.write_all(b"new")).unwrap();
            assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, mode);
        }
    }

    #[test]
    fn ending_of_another_format_is_refused() {
        let is_png = |name: &str| check_ending(Path::new(name), "a PNG picture", &["png"]).is_ok();
        assert!(["x", "x.png", "x.PNG", "x.v2", ".png", "x."].into_iter().all(is_png));
        assert!(!["x.jpg", "x.JPEG", "x.png.svg", "x.ron"].into_iter().any(is_png));
        let error = check_ending(Path::new("x.jpg"), "a PNG picture", &["png"]).unwrap_err().to_string();
        assert_eq!(
            error,
            "cannot write x.jpg: the file will be a PNG picture, not .jpg; give its name the ending .png"
        );
    }

    #[test]
    fn as_file_name_removes_separators() {
        assert_eq!(as_file_name("a b/../é\n.ron"), "a-b-..-é-.ron");
        assert_eq!((as_file_name("../x"), as_file_name("..")), ("-x".into(), "picture".into()));
        assert!(as_file_name(&"x".repeat(3000)).len() < 100);
    }

    #[test]
    fn is_same_file_resolves_paths() {
        let directory = TempDir::new().unwrap();
        fs::create_dir(directory.path().join("inner")).unwrap();
        let straight = directory.path().join("file");
        let round = directory.path().join("inner").join("..").join("file");
        assert!(is_same_file(&straight, &round));
        fs::write(&straight, "").unwrap();
        assert!(is_same_file(&straight, &round));
        assert!(!is_same_file(&straight, &directory.path().join("other")));
    }
}
