//! POV-Ray as a program that is run.

use std::io::ErrorKind;
use std::process::{Child, Command, Stdio};

use tempfile::TempDir;

use crate::export::to_pov;
use crate::picture::{Quality, Size};
use crate::scene::Scene;

/// POV-Ray as it is installed.
#[derive(Debug)]
pub(super) struct PovRay {
    /// What it says of itself, as `POV-Ray 3.7.0.10`.
    pub version: String,
}

impl PovRay {
    /// # Errors
    /// A sentence, if it is not installed or does not run.
    pub fn find() -> Result<Self, String> {
        let output = Command::new("povray").arg("--version").stdin(Stdio::null()).output().map_err(not_started)?;
        let said = [output.stdout, output.stderr].concat();
        let version = String::from_utf8_lossy(&said)
            .lines()
            .find(|line| line.starts_with("POV-Ray "))
            .map(|line| line.trim_end_matches(".unofficial").to_owned());
        version.map(|version| Self { version }).ok_or_else(|| "povray does not say which version it is".into())
    }

    /// Starts on a picture of `scene`.
    ///
    /// # Errors
    /// A sentence, if it cannot.
    pub fn start(&self, scene: &Scene, size: Size, quality: &Quality) -> Result<Rendering, String> {
        let failed = |error: std::io::Error| format!("a scene cannot be handed to POV-Ray: {error}");
        let directory = tempfile::tempdir().map_err(failed)?;
        std::fs::write(directory.path().join("scene.pov"), to_pov(scene, size, quality)).map_err(failed)?;
        let program = Command::new("povray")
            // It may always read and write where it stands, whatever its configuration forbids.
            .current_dir(directory.path())
            .args(["+Iscene.pov", "+Opicture.png", &format!("+W{}", size.width()), &format!("+H{}", size.height())])
            // One ray a pixel, one thread, no window; 8-bit PNG in sRGB, as this program writes it.
            .args(["-A", "+WT1", "-D", "-P", "+FN8", "File_Gamma=srgb", "Dither=off", "+Q9", "-GA", "-V"])
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .map_err(not_started)?;
        Ok(Rendering { program, directory, size })
    }
}

/// A picture that POV-Ray is drawing.
#[derive(Debug)]
pub(super) struct Rendering {
    program: Child,
    directory: TempDir,
    size: Size,
}

impl Rendering {
    /// Waits for the picture: its pixels in scan order, in 8-bit sRGB.
    ///
    /// # Errors
    /// A sentence, if there is none.
    pub fn finish(self) -> Result<Vec<[u8; 3]>, String> {
        let output = self.program.wait_with_output().map_err(|error| format!("povray is lost: {error}"))?;
        match image::open(self.directory.path().join("picture.png")) {
            Ok(picture) if (picture.width(), picture.height()) == (self.size.width(), self.size.height()) => {
                Ok(picture.to_rgb8().pixels().map(|pixel| pixel.0).collect())
            }
            _ => {
                let said = String::from_utf8_lossy(&output.stderr);
                let why = said.lines().find(|line| line.contains("Error")).unwrap_or("it does not say why");
                Err(format!("POV-Ray drew no picture: {}", why.trim()))
            }
        }
    }
}

fn not_started(error: std::io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => {
            "POV-Ray is not installed: there is no program `povray`; Debian and Ubuntu have it in the package of that \
             name (apt install povray)"
                .into()
        }
        _ => format!("povray cannot be started: {error}"),
    }
}
