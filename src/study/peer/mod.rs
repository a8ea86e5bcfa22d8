//! Compares every pixel with POV-Ray 3.7, which shares no code with this program: how many differ, why, and which is
//! right.
//!
//! Causes are found by removing them: a scene is changed for both programs alike, step by step, and pixels that agree
//! after a step had differed for its cause. No pixel is excluded, not even at edges, since both programs send their
//! rays through the same points.

mod bored_cylinder;
mod povray;
mod report;
mod step;

use serde::Serialize;

use super::progress::Progress;
use super::{ProgressSink, Study, StudyError};
use crate::output::as_file_name;
use crate::picture::{Difference, Quality, Size, encode_png, max_channel_difference, srgb8};
use crate::scene::{Opened, Scene};
use crate::tracer::{Scratch, Tracer};
use bored_cylinder::Bore;
use povray::PovRay;
pub use povray::PovRayError;
use step::Step;

/// A scene after some of the steps, in both programs.
#[derive(Clone, Debug, Serialize)]
struct PeerRow {
    scene: String,
    /// The last step taken.
    step: &'static str,
    pixels: u32,
    /// Pixels with a channel that is more than [`Difference::TOLERANCE`] apart.
    differing: u32,
    /// Share of all pixels.
    share: f64,
    /// Greatest difference of a channel, of 255.
    greatest: u8,
    /// Pixels with a view through the bore, if the scene has one.
    through_bore: Option<u32>,
    /// Number of these pixels in which anel does not show the background.
    anel_wrong: Option<u32>,
    /// Number of these pixels in which POV-Ray does not show the background.
    povray_wrong: Option<u32>,
}

/// Compares both programs on each of the scenes, and on a cylinder whose ends coincide with those of its bore, in
/// pictures of `size`.
///
/// # Errors
/// [`StudyError::PovRay`], if POV-Ray is not installed or fails; [`StudyError::File`], if a picture cannot be encoded.
pub fn peer(scenes: &[Opened], size: Size, tell: ProgressSink<'_>) -> Result<Study, StudyError> {
    let povray = PovRay::find()?;
    let bored = bored_cylinder::scene()?;
    let bore = Bore::of(&bored.scene, size);
    let mut progress = Progress::new((scenes.len() + 1) * Step::ALL.len(), tell);
    let mut study = Study::new("peer");
    let mut rows = Vec::new();
    for opened in scenes.iter().chain([&bored]) {
        let (mut scene, mut quality) = (opened.scene.clone(), Quality::default());
        let mut started = Vec::new();
        for step in Step::ALL {
            step.apply(&mut scene, &mut quality);
            // All at once, since POV-Ray takes longer to start than to render.
            started.push((step, scene.clone(), quality, povray.start(&scene, size, &quality)?));
        }
        for (step, scene, quality, theirs) in started {
            progress.next(&format!("{}: {}", opened.name, step.name()));
            let ours = trace(&scene, size, quality);
            let pictures = Pictures { size, ours, theirs: theirs.finish()? };
            if step == Step::AsItIs {
                pictures.add_files(&mut study, &opened.name)?;
            }
            // After later steps the ends no longer coincide, and the bore is rightly closed.
            let looks_through = std::ptr::eq(opened, &bored) && step == Step::AsItIs;
            rows.push(pictures.row(&opened.name, step, looks_through.then_some(&bore)));
        }
    }
    study.add_rows(&rows)?;
    study.add_report(report::report(&povray, size, &rows));
    Ok(study)
}

/// Traces this program's picture, in 8-bit sRGB.
fn trace(scene: &Scene, size: Size, quality: Quality) -> Vec<[u8; 3]> {
    let mut pixels = Vec::new();
    Tracer::new(scene, size, quality).trace(0..size.pixels(), &mut Scratch::default(), &mut pixels);
    pixels.into_iter().map(srgb8).collect()
}

/// A scene rendered by both programs, in 8-bit sRGB.
struct Pictures {
    size: Size,
    ours: Vec<[u8; 3]>,
    theirs: Vec<[u8; 3]>,
}

impl Pictures {
    /// Returns the greatest difference of a channel, by pixel.
    fn differences(&self) -> impl Iterator<Item = u8> {
        self.ours.iter().zip(&self.theirs).map(|(ours, theirs)| max_channel_difference(*ours, *theirs))
    }

    fn row(&self, scene: &str, step: Step, bore: Option<&Bore>) -> PeerRow {
        let differing = self.differences().filter(|&difference| difference > Difference::TOLERANCE).count() as u32;
        PeerRow {
            scene: scene.to_owned(),
            step: step.name(),
            pixels: self.size.pixels(),
            differing,
            share: f64::from(differing) / f64::from(self.size.pixels()),
            greatest: self.differences().max().unwrap_or(0),
            through_bore: bore.map(Bore::pixels),
            anel_wrong: bore.map(|bore| bore.wrong(&self.ours)),
            povray_wrong: bore.map(|bore| bore.wrong(&self.theirs)),
        }
    }

    /// Adds both pictures and their difference to the study's files.
    fn add_files(&self, study: &mut Study, scene: &str) -> Result<(), StudyError> {
        let where_they_differ = self.ours.iter().zip(self.differences()).map(|(ours, difference)| {
            if difference > Difference::TOLERANCE { [255, 80, 60] } else { ours.map(|channel| channel / 4) }
        });
        let pictures =
            [(OURS, self.ours.clone()), (THEIRS, self.theirs.clone()), (DIFFERENCE, where_they_differ.collect())];
        for (which, pixels) in pictures {
            let (file, mut png) = (picture_name(scene, which), Vec::new());
            let encoded = encode_png(&mut png, self.size, pixels.as_flattened());
            encoded.map_err(|error| StudyError::file(&*file, error))?;
            study.files.push((file, png));
        }
        Ok(())
    }
}

const OURS: &str = "anel";
const THEIRS: &str = "povray";
const DIFFERENCE: &str = "difference";

/// Returns a picture's file name.
fn picture_name(scene: &str, which: &str) -> String {
    format!("peer-{}-{which}.png", as_file_name(scene))
}
