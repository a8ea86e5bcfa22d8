//! The pixel that is inspected. It is traced once more in the background, one job at a time: while somebody moves over many
//! pixels, only the last one asked for is traced next.

use std::sync::Arc;

use super::Session;
use crate::view::{ChosenRay, Inspected};

/// The pixel that is inspected, if there is one.
#[derive(Default)]
pub(super) struct Inspecting {
    /// What was asked for last.
    asked: Option<InspectedRay>,
    /// What is known, which may be of what was asked for before.
    known: Option<Box<Inspected>>,
    is_busy: bool,
    /// Something was asked for since the job began.
    again: bool,
}

/// A pixel, and which of its rays; its first unless that is said.
#[derive(Clone, Copy)]
struct InspectedRay {
    place: [u32; 2],
    chosen: Option<ChosenRay>,
}

impl Session {
    /// Inspects a pixel of the picture, by its column and row.
    pub fn inspect(&mut self, place: [u32; 2]) {
        self.inspecting.asked = Some(InspectedRay { place, chosen: None });
        self.look_again();
    }

    /// Inspects the pixel so far to the right and below, if there is one.
    pub fn inspect_beside(&mut self, by: [i32; 2]) {
        let size = self.header().size;
        if let Some(asked) = self.inspecting.asked {
            let [x, y] = [0, 1].map(|axis| asked.place[axis].saturating_add_signed(by[axis]));
            self.inspect([x.min(size.width() - 1), y.min(size.height() - 1)]);
        }
    }

    /// Looks along another ray of the pixel.
    pub fn choose_ray(&mut self, chosen: ChosenRay) {
        if let Some(asked) = &mut self.inspecting.asked {
            asked.chosen = Some(chosen);
            self.look_again();
        }
    }

    /// Nobody looks any more.
    pub fn stop_inspecting(&mut self) {
        (self.inspecting.asked, self.inspecting.known) = (None, None);
    }

    /// The place of the pixel that is inspected.
    pub fn inspected_place(&self) -> Option<[u32; 2]> {
        self.inspecting.asked.map(|asked| asked.place)
    }

    /// What is known of it; a moment after another was asked for, what is known of the one before.
    pub fn inspected(&self) -> Option<&Inspected> {
        self.inspecting.known.as_deref()
    }

    /// Whether what is known is not yet what was asked for.
    pub fn is_looking(&self) -> bool {
        self.inspecting.is_busy
    }

    /// Traces the pixel once more: another was asked for, or the picture is another.
    pub(super) fn look_again(&mut self) {
        let language = self.language;
        let Some(InspectedRay { place, chosen }) = self.inspecting.asked else { return };
        if self.inspecting.is_busy {
            self.inspecting.again = true;
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
                let inspected = Inspected::new(&tracer, &opened.scene, place)?;
                // In another picture the pixel may have fewer rays.
                let along = chosen.and_then(|chosen| inspected.choose(&tracer, chosen));
                Some(along.unwrap_or(inspected))
            },
            language,
        );
    }

    pub(super) fn take_inspected(&mut self, inspected: Option<Box<Inspected>>) {
        self.inspecting.is_busy = false;
        let again = std::mem::take(&mut self.inspecting.again);
        if self.inspecting.asked.is_none() {
            return;
        }
        match inspected {
            Some(inspected) => self.inspecting.known = Some(inspected),
            // The picture has become smaller.
            None if !again => self.stop_inspecting(),
            None => {}
        }
        if again {
            self.look_again();
        }
    }
}
