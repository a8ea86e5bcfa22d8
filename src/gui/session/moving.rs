//! The camera in the user's hand: a coarse picture follows it, and when it rests the run starts anew from there.

use std::sync::Arc;
use std::time::Duration;

use super::Session;
use super::job_result::{CameraPreview, JobResult};
use super::jobs::Jobs;
use super::opening::Opening;
use super::preview::{guess, with_preview};
use crate::language::{Language, word};
use crate::picture::{Quality, Size};
use crate::scene::{Camera, Scene};
use crate::tracer::Tracer;

/// A camera that was moved, and what is seen by it.
pub(super) struct CameraMove {
    camera: Camera,
    /// egui's clock when it moved last, in seconds.
    since: f64,
    is_busy: bool,
    /// The camera was moved since the job began.
    again: bool,
    /// The run that starts anew from there is being prepared.
    is_settled: bool,
    shown: Option<Arc<CameraPreview>>,
}

/// A camera that rests for so long, in seconds, is where it is meant to be.
const REST: f64 = 0.4;

/// The job looks at the picture as finely as this time allows, and always once.
const LOOK: Duration = Duration::from_millis(30);

impl Session {
    /// Moves the camera; a recorded run keeps its own.
    pub fn move_camera(&mut self, change: impl FnOnce(&Camera) -> Camera) {
        if self.is_recorded() {
            return self.refuse_camera();
        }
        let Some(prepared) = &self.prepared else { return };
        let before = self.moving.as_ref().map_or(prepared.opened.scene.camera, |moving| moving.camera);
        let camera = change(&before);
        let shown = self.moving.take().and_then(|moving| moving.shown);
        let (is_busy, again) = (self.camera_jobs > 0, self.camera_jobs > 0);
        self.moving = Some(CameraMove { camera, since: self.clock, is_busy, again, is_settled: false, shown });
        self.look_from_there();
    }

    /// Says why the camera of a recorded run cannot be moved.
    pub fn refuse_camera(&mut self) {
        let language = self.language;
        self.note(word!(
            language,
            "A recorded run keeps its camera: make it live first, under Set up (E)",
            "Uma execução gravada mantém sua câmera: antes, executar ao vivo, em Ajustar (E)"
        ));
    }

    /// Goes back to the scene's own camera.
    pub fn camera_home(&mut self) {
        if let Some(home) = self.home.filter(|_| self.is_camera_away()) {
            self.move_camera(|_| home);
        }
    }

    /// Whether the scene is seen by another camera than its own.
    pub fn is_camera_away(&self) -> bool {
        if self.is_recorded() {
            return false;
        }
        let now = self.moving.as_ref().map(|moving| moving.camera);
        let now = now.or_else(|| self.prepared.as_ref().map(|prepared| prepared.opened.scene.camera));
        self.home.zip(now).is_some_and(|(home, now)| home.eye != now.eye || home.look_at != now.look_at)
    }

    /// What is about seen by a camera that moves.
    pub fn moved(&self) -> Option<&Arc<CameraPreview>> {
        self.moving.as_ref().and_then(|moving| moving.shown.as_ref())
    }

    /// Whether the camera moves, or the run from there is being prepared.
    pub fn is_moving(&self) -> bool {
        self.moving.is_some()
    }

    /// Once the camera rests and no hand `holds` it, the run starts anew from there.
    pub fn settle_camera(&mut self, holds: bool) {
        let language = self.language;
        let Some(moving) = self.moving.as_mut().filter(|moving| !moving.is_settled) else { return };
        if holds || self.clock - moving.since < REST {
            return;
        }
        moving.is_settled = true;
        let camera = moving.camera;
        let opened = self.prepared.as_ref().and_then(|prepared| prepared.opened.with_camera(camera));
        match opened {
            Some(opened) => {
                self.show(Opening::Scene(Arc::new(opened)));
                self.note(word!(
                    language,
                    "Seen from elsewhere: the run starts anew",
                    "Vista de outro lugar: a execução reinicia"
                ));
            }
            None => {
                self.moving = None;
                self.trouble(word!(language, "The camera cannot go there", "A câmera não pode ir para lá"));
            }
        }
    }

    /// The stage is another: what is seen there is the picture itself.
    pub(super) fn camera_has_settled(&mut self) {
        if self.moving.as_ref().is_some_and(|moving| moving.is_settled) {
            self.moving = None;
        }
    }

    pub(super) fn take_moved(&mut self, moved: CameraPreview) {
        self.camera_jobs -= 1;
        if let Some(moving) = &mut self.moving {
            moving.is_busy = false;
            moving.shown = Some(Arc::new(moved));
            if std::mem::take(&mut moving.again) {
                self.look_from_there();
            }
        }
    }

    fn look_from_there(&mut self) {
        let language = self.language;
        let (Some(moving), Some(prepared)) = (&mut self.moving, &self.prepared) else { return };
        if moving.is_busy {
            moving.again = true;
            return;
        }
        moving.is_busy = true;
        self.camera_jobs += 1;
        let scene = Scene { camera: moving.camera, ..prepared.opened.scene.clone() };
        self.jobs.look(scene, prepared.size, prepared.quality, language);
    }
}

impl Jobs {
    /// Looks at the scene, coarsely and then as finely as there is time.
    fn look(&mut self, scene: Scene, size: Size, quality: Quality, language: Language) {
        self.start(language, "camera", move || JobResult::CameraPreview(look(&scene, size, quality)));
    }
}

fn look(scene: &Scene, size: Size, quality: Quality) -> CameraPreview {
    let tracer = Tracer::new(scene, size, Quality { samples: 1, ..quality });
    CameraPreview { size, pixels: guess(&with_preview(tracer, 1, LOOK)) }
}
