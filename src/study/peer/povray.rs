//! POV-Ray as an external program.

use std::io::{self, ErrorKind};
use std::process::{Child, Command, Stdio};

use tempfile::TempDir;
use thiserror::Error;

use crate::export::to_pov;
use crate::picture::{Quality, Size};
use crate::scene::Scene;

/// Why POV-Ray drew no picture.
#[derive(Debug, Error)]
pub enum PovRayError {
    /// There is no such program.
    #[error(
        "POV-Ray is not installed: there is no program `povray`; Debian and Ubuntu have it in the package of that name \
         (apt install povray)"
    )]
    NotInstalled,
    /// The program does not start.
    #[error("povray does not start: {0}; check that `povray --version` works")]
    NotStarted(#[source] io::Error),
    /// The program does not name its version.
    #[error("povray does not say which version it is; check that `povray --version` works, with POV-Ray 3.7")]
    UnknownVersion,
    /// The scene could not be written for it.
    #[error("the scene for POV-Ray cannot be written: {0}; check the directory for temporary files")]
    NoInput(#[source] io::Error),
    /// The program could not be waited for.
    #[error("povray cannot be waited for: {0}; run the study again")]
    Lost(#[source] io::Error),
    /// The program ended without a picture of the size.
    #[error("POV-Ray drew no picture: {0}")]
    NoPicture(String),
}

impl PovRayError {
    /// The error of a program that did not start.
    fn start(error: io::Error) -> Self {
        match error.kind() {
            ErrorKind::NotFound => Self::NotInstalled,
            _ => Self::NotStarted(error),
        }
    }
}

/// POV-Ray as it is installed.
#[derive(Debug)]
pub(super) struct PovRay {
    /// The version as the program reports it, such as `POV-Ray 3.7.0.10`.
    pub version: String,
}

impl PovRay {
    /// Looks for the program and asks for its version.
    ///
    /// # Errors
    /// A [`PovRayError`], if it is not installed or does not run.
    pub fn find() -> Result<Self, PovRayError> {
        let output =
            Command::new("povray").arg("--version").stdin(Stdio::null()).output().map_err(PovRayError::start)?;
        let said = [output.stdout, output.stderr].concat();
        let version = String::from_utf8_lossy(&said)
            .lines()
            .find(|line| line.starts_with("POV-Ray "))
            .map(|line| line.trim_end_matches(".unofficial").to_owned());
        version.map(|version| Self { version }).ok_or(PovRayError::UnknownVersion)
    }

    /// Starts rendering a picture of `scene`.
    ///
    /// # Errors
    /// A [`PovRayError`], if the scene cannot be written or the program does not start.
    pub fn start(&self, scene: &Scene, size: Size, quality: &Quality) -> Result<Rendering, PovRayError> {
        let directory = tempfile::tempdir().map_err(PovRayError::NoInput)?;
        std::fs::write(directory.path().join("scene.pov"), to_pov(scene, size, quality).text)
            .map_err(PovRayError::NoInput)?;
        let program = Command::new("povray")
            // Its configuration always lets it read and write in its working directory.
            .current_dir(directory.path())
            .args(["+Iscene.pov", "+Opicture.png", &format!("+W{}", size.width()), &format!("+H{}", size.height())])
            // One ray a pixel, one thread, no window; 8-bit PNG in sRGB, as this program writes it.
            .args(["-A", "+WT1", "-D", "-P", "+FN8", "File_Gamma=srgb", "Dither=off", "+Q9", "-GA", "-V"])
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(PovRayError::start)?;
        Ok(Rendering { program, directory, size })
    }
}

/// A picture being rendered by POV-Ray.
#[derive(Debug)]
pub(super) struct Rendering {
    program: Child,
    directory: TempDir,
    size: Size,
}

impl Rendering {
    /// Waits for the picture and returns its pixels in scan order, in 8-bit sRGB.
    ///
    /// # Errors
    /// A [`PovRayError`], if there is no picture.
    pub fn finish(self) -> Result<Vec<[u8; 3]>, PovRayError> {
        let output = self.program.wait_with_output().map_err(PovRayError::Lost)?;
        match image::open(self.directory.path().join("picture.png")) {
            Ok(picture) if (picture.width(), picture.height()) == (self.size.width(), self.size.height()) => {
                Ok(picture.to_rgb8().pixels().map(|pixel| pixel.0).collect())
            }
            _ => {
                let said = String::from_utf8_lossy(&output.stderr);
                let why = said.lines().find(|line| line.contains("Error")).unwrap_or("it does not say why");
                Err(PovRayError::NoPicture(why.trim().into()))
            }
        }
    }
}
