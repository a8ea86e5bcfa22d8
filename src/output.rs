//! Atomic writing of files: a file is complete or does not exist.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

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
        let mut buffer = BufWriter::new(file.as_file_mut());
        fill(&mut buffer)?;
        buffer.flush()?;
        drop(buffer);
        // The permissions of an existing file stay.
        if let Ok(before) = fs::metadata(&target) {
            file.as_file().set_permissions(before.permissions())?;
        }
        // Some systems report a full disk only here.
        file.as_file().sync_all()?;
        file.persist(&target)?;
        Ok(())
    };
    write().map_err(|source| OutputError::Write { path: path.to_owned(), source })
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
fn begin(path: &Path) -> Result<(NamedTempFile, PathBuf), OutputError> {
    let refuse = |problem| OutputError::Path { path: path.to_owned(), problem };
    let target = target(path).map_err(refuse)?;
    let file = temporary_beside(&target).map_err(|error| match error.kind() {
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

/// A temporary file in the directory of `path`, so that it can be renamed to it. It is removed when dropped.
fn temporary_beside(path: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".anel-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // The umask decides who can read it; temporary files are private by default.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(directory_of(path))
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
