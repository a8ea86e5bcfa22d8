//! The inspected pixel, traced again in the background. Only one job runs at a time; of the pixels that are requested
//! meanwhile only the last one is traced next.

use std::sync::Arc;

use super::Session;
use crate::view::{ChosenRay, Inspected};

/// State of the inspector.
#[derive(Default)]
pub(super) struct Inspecting {
    /// The pixel and ray requested last; `None` while the inspector is closed.
    requested: Option<InspectedRay>,
    /// The last result, which may belong to an earlier request.
    result: Option<Box<Inspected>>,
    is_busy: bool,
    /// Whether there was a request since the job began.
    is_stale: bool,
}

/// A pixel and one of its rays; `None` is its first.
#[derive(Clone, Copy)]
struct InspectedRay {
    pixel: [u32; 2],
    ray: Option<ChosenRay>,
}

impl Session {
    /// Inspects the pixel at this column and row.
    pub fn inspect(&mut self, pixel: [u32; 2]) {
        self.inspecting.requested = Some(InspectedRay { pixel, ray: None });
        self.inspect_again();
    }

    /// Moves the inspected pixel by this many columns and rows, at most to the edge of the picture. The chosen ray
    /// stays, if the other pixel has it.
    pub fn inspect_beside(&mut self, by: [i32; 2]) {
        let size = self.header().size;
        if let Some(requested) = self.inspecting.requested {
            let [x, y] = [0, 1].map(|axis| requested.pixel[axis].saturating_add_signed(by[axis]));
            let pixel = [x.min(size.width() - 1), y.min(size.height() - 1)];
            self.inspecting.requested = Some(InspectedRay { pixel, ..requested });
            self.inspect_again();
        }
    }

    /// Inspects another ray of the pixel.
    pub fn choose_ray(&mut self, ray: ChosenRay) {
        if let Some(requested) = &mut self.inspecting.requested {
            requested.ray = Some(ray);
            self.inspect_again();
        }
    }

    /// Closes the inspector.
    pub fn stop_inspecting(&mut self) {
        (self.inspecting.requested, self.inspecting.result) = (None, None);
    }

    /// Returns column and row of the inspected pixel.
    pub fn inspected_pixel(&self) -> Option<[u32; 2]> {
        self.inspecting.requested.map(|requested| requested.pixel)
    }

    /// Returns the last result; until the job of a new request ends, it belongs to an earlier one.
    pub fn inspected(&self) -> Option<&Inspected> {
        self.inspecting.result.as_deref()
    }

    /// Whether a job is tracing the requested pixel.
    pub fn is_inspecting(&self) -> bool {
        self.inspecting.is_busy
    }

    /// Traces the requested pixel, after a new request or in a new picture.
    pub(super) fn inspect_again(&mut self) {
        let language = self.language;
        let Some(InspectedRay { pixel, ray }) = self.inspecting.requested else { return };
        if self.inspecting.is_busy {
            self.inspecting.is_stale = true;
            return;
        }
        let live = || self.prepared.as_ref().map(|prepared| (&prepared.tracer, &prepared.opened));
        let shown = self.recorded.as_ref().map(|recorded| (&recorded.tracer, &recorded.opened)).or_else(live);
        let Some((tracer, opened)) = shown.map(|(tracer, opened)| (Arc::clone(tracer), Arc::clone(opened))) else {
            return self.stop_inspecting();
        };
        self.inspecting.is_busy = true;
        self.jobs.inspect(
            move || {
                let inspected = Inspected::new(&tracer, &opened.scene, pixel)?;
                // In a new picture the pixel may not have this ray.
                let chosen = ray.and_then(|ray| inspected.choose(&tracer, ray));
                Some(chosen.unwrap_or(inspected))
            },
            language,
        );
    }

    pub(super) fn take_inspected(&mut self, inspected: Option<Box<Inspected>>) {
        self.inspecting.is_busy = false;
        let is_stale = std::mem::take(&mut self.inspecting.is_stale);
        if self.inspecting.requested.is_none() {
            return;
        }
        match inspected {
            Some(inspected) => self.inspecting.result = Some(inspected),
            // A smaller picture may not have the pixel.
            None if !is_stale => self.stop_inspecting(),
            None => {}
        }
        if is_stale {
            self.inspect_again();
        }
    }
}
