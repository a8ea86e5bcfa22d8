//! Files that are either whole or not there.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;
use thiserror::Error;

/// Why a file could not be written.
#[derive(Debug, Error)]
pub enum OutputError {
    /// The path can never hold the file: found before the work of making what goes into it.
    #[error("cannot write {path}: {why}")]
    Path {
        /// Where it was to go.
        path: PathBuf,
        /// What is wrong with that.
        why: String,
    },
    /// Writing failed, for instance because the disk is full; the partial file has been removed.
    #[error("writing {path} failed, nothing was kept: {source}")]
    Write {
        /// Where it was to go.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
}

/// Makes sure that a file can be written to `path`, before the work of making what goes into it.
///
/// # Errors
/// [`OutputError::Path`], if `path` is a directory or a device, or its directory is missing or read-only.
pub fn check_writable(path: &Path) -> Result<(), OutputError> {
    let refuse = |why: String| Err(OutputError::Path { path: path.to_owned(), why });
    match fs::metadata(path) {
        Ok(found) if found.is_dir() => return refuse("it is a directory; name a file in it".into()),
        // Renaming over a device would replace it.
        Ok(found) if !found.is_file() => return refuse("it is not a regular file".into()),
        Ok(found) if found.permissions().readonly() => return refuse("it is read-only".into()),
        _ => {}
    }
    match temporary_beside(path) {
        Ok(_) => Ok(()),
        Err(error) if error.kind() == io::ErrorKind::NotFound => refuse("its directory does not exist".into()),
        Err(error) => refuse(error.to_string()),
    }
}

/// Writes what `fill` writes to `path`. The file appears whole under its name or not at all; one that was there before
/// stays until then.
///
/// # Errors
/// [`OutputError::Write`] with what the system said.
pub fn write_whole(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>,
) -> Result<(), OutputError> {
    let write = || {
        let mut file = temporary_beside(path)?;
        let mut buffer = BufWriter::new(file.as_file_mut());
        fill(&mut buffer)?;
        buffer.flush()?;
        drop(buffer);
        // A disk that fills may say so only here.
        file.as_file().sync_all()?;
        file.persist(path)?;
        Ok(())
    };
    write().map_err(|source| OutputError::Write { path: path.to_owned(), source })
}

/// A temporary file in the directory of `path`, so that it can be renamed to it; it removes itself when dropped.
fn temporary_beside(path: &Path) -> io::Result<NamedTempFile> {
    let directory = path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut builder = tempfile::Builder::new();
    builder.prefix(".anel-").suffix(".part");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // Readable by others as far as the user's umask allows, not the private mode of temporary files.
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder.tempfile_in(directory)
}
