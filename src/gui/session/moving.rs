//! Camera moves: a coarse preview follows the camera, and when it rests the run restarts from its position.

use std::sync::Arc;
use std::time::Duration;

use super::Session;
use super::job_result::{CameraPreview, JobResult};
use super::jobs::Jobs;
use super::opening::Opening;
use super::preview::with_preview;
use crate::language::{Language, word};
use crate::picture::{Quality, Size, srgb8};
use crate::scene::{Camera, Opened, Scene};
use crate::tracer::Tracer;

/// A moved camera and its preview.
pub(super) struct CameraMove {
    camera: Camera,
    /// egui's clock when it moved last, in seconds.
    moved: f64,
    is_busy: bool,
    /// Whether the camera was moved since the job began.
    is_stale: bool,
    /// Whether the run from the new position is being prepared.
    is_settled: bool,
    preview: Option<Arc<CameraPreview>>,
}

/// Seconds without movement after which the run restarts from the camera's position.
const SETTLE_S: f64 = 0.4;

/// Time limit of a preview, for 30 a second; its first, coarsest step is always made.
const PREVIEW_TIME: Duration = Duration::from_millis(33);

/// While the camera moves, a ray's weakest descendants up to this total weight are left out: nobody sees them in a
/// coarse picture, and it is finer for the time that they would take.
const PREVIEW_CUTOFF: f64 = 0.2;

impl Session {
    /// Moves the camera. In a recorded run it only shows a notice.
    pub fn move_camera(&mut self, change: impl FnOnce(&Camera) -> Camera) {
        if self.is_recorded() {
            return self.refuse_camera();
        }
        let Some(prepared) = &self.prepared else { return };
        let before = self.camera_move.as_ref().map_or(prepared.opened.scene.camera, |moving| moving.camera);
        let camera = change(&before);
        let preview = self.camera_move.take().and_then(|moving| moving.preview);
        let (is_busy, is_stale) = (self.camera_jobs > 0, self.camera_jobs > 0);
        self.camera_move =
            Some(CameraMove { camera, moved: self.clock, is_busy, is_stale, is_settled: false, preview });
        self.preview_camera();
    }

    /// Shows the notice that the camera of a recorded run cannot be moved.
    pub fn refuse_camera(&mut self) {
        let language = self.language;
        self.note(word!(
            language,
            "The camera of a recorded run is fixed. Open Set up (E) and press Make it live",
            "A câmera de uma execução gravada é fixa. Abra Ajustar (E) e pressione Executar ao vivo"
        ));
    }

    /// Moves the camera back to that of the scene.
    pub fn reset_camera(&mut self) {
        if let Some(home) = self.opened().map(|opened| opened.home_camera).filter(|_| self.is_camera_moved()) {
            self.move_camera(|_| home);
        }
    }

    /// Whether the camera is not that of the scene.
    pub fn is_camera_moved(&self) -> bool {
        if self.is_recorded() {
            return false;
        }
        let Some(opened) = self.opened() else { return false };
        let now = self.camera_move.as_ref().map_or(opened.scene.camera, |moving| moving.camera);
        let home = opened.home_camera;
        home.eye != now.eye || home.look_at != now.look_at
    }

    /// Returns the preview of the moving camera.
    pub fn camera_preview(&self) -> Option<&Arc<CameraPreview>> {
        self.camera_move.as_ref().and_then(|moving| moving.preview.as_ref())
    }

    /// Whether the camera moves, or the run from its new position is being prepared.
    pub fn is_camera_moving(&self) -> bool {
        self.camera_move.is_some()
    }

    /// Restarts the run from the camera's position once it rests and is not dragged.
    pub fn settle_camera(&mut self, is_dragged: bool) {
        let language = self.language;
        let Some(moving) = self.camera_move.as_mut().filter(|moving| !moving.is_settled) else { return };
        if is_dragged || self.clock - moving.moved < SETTLE_S {
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
                    "Restarted from the new camera position",
                    "Reiniciada da nova posição da câmera"
                ));
            }
            None => {
                self.camera_move = None;
                self.trouble(word!(
                    language,
                    "The camera cannot go there. Choose another position",
                    "A câmera não pode ir para lá. Escolha outra posição"
                ));
            }
        }
    }

    /// Ends a settled camera move: the picture of the new run replaces the preview.
    pub(super) fn end_camera_move(&mut self) {
        if self.camera_move.as_ref().is_some_and(|moving| moving.is_settled) {
            self.camera_move = None;
        }
    }

    pub(super) fn take_camera_preview(&mut self, preview: CameraPreview) {
        self.camera_jobs -= 1;
        if let Some(moving) = &mut self.camera_move {
            moving.is_busy = false;
            moving.preview = Some(Arc::new(preview));
            if std::mem::take(&mut moving.is_stale) {
                self.preview_camera();
            }
        }
    }

    /// Starts a preview from the moved camera, or notes that one is needed when the present job ends.
    fn preview_camera(&mut self) {
        let language = self.language;
        let (Some(moving), Some(prepared)) = (&mut self.camera_move, &self.prepared) else { return };
        if moving.is_busy {
            moving.is_stale = true;
            return;
        }
        moving.is_busy = true;
        self.camera_jobs += 1;
        self.jobs.preview((Arc::clone(&prepared.opened), moving.camera), prepared.size, prepared.quality, language);
    }
}

impl Jobs {
    /// Traces a coarse preview of the scene, as fine as the time limit allows.
    fn preview(&mut self, (opened, camera): (Arc<Opened>, Camera), size: Size, quality: Quality, language: Language) {
        self.start(language, "camera", move || {
            let scene = Scene { camera, ..opened.scene.clone() };
            JobResult::CameraPreview(preview(&scene, size, quality))
        });
    }
}

fn preview(scene: &Scene, size: Size, quality: Quality) -> CameraPreview {
    let quality = Quality { samples: 1, cutoff: quality.cutoff.max(PREVIEW_CUTOFF), ..quality };
    let tracer = with_preview(Tracer::new(scene, size, quality), 1, PREVIEW_TIME);
    let preview = tracer.preview().map(|preview| (preview.step(), preview.shape(), preview.colours()));
    let (step, shape, colours) = preview.expect("it was refined at least once");
    CameraPreview { size, step, shape, pixels: colours.map(srgb8).collect() }
}
