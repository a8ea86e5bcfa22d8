//! The picture as it is shown: the render, the owners, or anything between.

use std::ops::Range;
use std::sync::Arc;

use super::overlay::{Layer, Shades};
use crate::balance::NodeId;
use crate::palette::{Rgb, mix};
use crate::picture::{Atom, Colour, Division, Size, srgb8};
use crate::view::state::run_state::RunState;

/// The shown picture in 8-bit sRGB, kept up to date piece by piece.
///
/// An atom that is not there yet has a shade of the node in whose queue it is, and stands out while it is traced.
#[derive(Clone, Debug)]
pub struct Canvas {
    size: Size,
    division: Division,
    colours: Vec<Rgb>,
    tones: Shades,
    ground: Rgb,
    blend: f32,
    /// What an atom costs on the average, as far as costs are shown by it.
    mean_cost: f64,
    render: Vec<Rgb>,
    /// By atom: whether `render` has its pixels.
    known: Vec<bool>,
    /// What the render will about look like; empty if that is not known. Of its own, so that a moment that is shown again
    /// looks the same.
    preview: Arc<[Rgb]>,
    shown: Vec<Rgb>,
    /// By atom: what `shown` shows of it.
    painted: Vec<Painted>,
    dirty: Vec<bool>,
}

/// What decides how an atom is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Painted {
    holder: Option<NodeId>,
    tone: Option<u16>,
    is_traced: bool,
    is_traced_now: bool,
    is_render: bool,
}

impl Canvas {
    /// An empty canvas for nodes of these colours.
    pub fn new(size: Size, division: Division, colours: Vec<Rgb>, ground: Rgb) -> Self {
        let pixels = size.pixels() as usize;
        Self {
            size,
            division,
            tones: Shades::new(Layer::Owners, &colours),
            colours,
            ground,
            blend: 0.0,
            mean_cost: 0.0,
            render: vec![[0; 3]; pixels],
            known: vec![false; division.atoms() as usize],
            preview: Arc::default(),
            shown: vec![ground; pixels],
            painted: vec![Painted::default(); division.atoms() as usize],
            dirty: vec![true; size.height() as usize],
        }
    }

    /// Width and height.
    pub fn size(&self) -> Size {
        self.size
    }

    /// What is seen where nothing is.
    pub fn ground(&self) -> Rgb {
        self.ground
    }

    /// Takes in traced pixels: `pixels` are those of `atoms`. They are seen once the parent has placed them.
    pub fn take(&mut self, atoms: Range<Atom>, pixels: &[Colour]) {
        let start = self.division.pixels(atoms.start).start as usize;
        for (to, &from) in self.render[start..].iter_mut().zip(pixels) {
            *to = srgb8(from);
        }
        self.known[atoms.start as usize..atoms.end as usize].fill(true);
    }

    /// Shows faintly what all pixels, in scan order, will look like; nothing if there are none.
    pub fn preview(&mut self, guess: Arc<[Rgb]>, state: &RunState) {
        self.preview = guess;
        self.paint(0..self.division.atoms(), state);
    }

    /// Draws atoms anew after what `state` knows of them.
    pub fn paint(&mut self, atoms: Range<Atom>, state: &RunState) {
        for atom in atoms {
            let pixels = self.division.pixels(atom);
            if pixels.is_empty() {
                continue;
            }
            let rows = pixels.start / self.size.width()..=(pixels.end - 1) / self.size.width();
            self.dirty[*rows.start() as usize..=*rows.end() as usize].fill(true);
            let pixels = pixels.start as usize..pixels.end as usize;
            self.paint_atom(atom, pixels, state);
        }
    }

    /// Draws anew what of these atoms looks different by now.
    pub fn show(&mut self, atoms: Range<Atom>, state: &RunState) {
        for atom in atoms {
            if self.painted[atom as usize] != self.to_paint(atom, state) {
                self.paint(atom..atom + 1, state);
            }
        }
    }

    /// Shows another moment.
    pub fn show_all(&mut self, state: &RunState) {
        self.show(0..self.division.atoms(), state);
    }

    /// Shows the render (0), a layer (1) or something between, on `ground`. Nothing is drawn if nothing changes.
    pub fn set_look(&mut self, (layer, blend): (Layer, f32), ground: Rgb, state: &RunState) {
        /// What costs are compared with follows the mean in steps, or each atom would be drawn anew with every other.
        const STEP: f64 = 1.1;
        if layer != self.tones.layer() {
            self.tones = Shades::new(layer, &self.colours);
            self.blend = f32::NAN;
        }
        let mean = state.mean_cost();
        let is_off = !(self.mean_cost / STEP..=self.mean_cost * STEP).contains(&mean);
        if layer == Layer::Costs && is_off {
            self.mean_cost = mean;
            self.show_all(state);
        }
        if (blend, ground) != (self.blend, self.ground) {
            (self.blend, self.ground) = (blend, ground);
            self.paint(0..self.division.atoms(), state);
        }
    }

    /// The rows that have changed since this was last asked; runs that nearly touch are one.
    pub fn take_dirty(&mut self) -> Vec<Range<u32>> {
        const NEAR: u32 = 8;
        let mut runs: Vec<Range<u32>> = Vec::new();
        for (row, dirty) in (0..).zip(&mut self.dirty) {
            if !std::mem::take(dirty) {
                continue;
            }
            match runs.last_mut() {
                Some(run) if row < run.end + NEAR => run.end = row + 1,
                _ => runs.push(row..row + 1),
            }
        }
        runs
    }

    /// The shown pixels of some rows.
    pub fn rows(&self, rows: Range<u32>) -> &[Rgb] {
        let width = self.size.width() as usize;
        &self.shown[rows.start as usize * width..rows.end as usize * width]
    }

    fn to_paint(&self, atom: Atom, state: &RunState) -> Painted {
        let place = state.places()[atom as usize];
        let (holder, is_traced) = (place.holder(), place.owner().is_some());
        let is_traced_now = holder.is_some_and(|node| state.nodes()[usize::from(node)].atom == Some(atom));
        let tone = self.tones.of(atom, state, self.mean_cost);
        Painted { holder, tone, is_traced, is_traced_now, is_render: place.is_placed() && self.known[atom as usize] }
    }

    fn paint_atom(&mut self, atom: Atom, pixels: Range<usize>, state: &RunState) {
        let painted = self.to_paint(atom, state);
        self.painted[atom as usize] = painted;
        let Painted { holder, tone, is_traced, is_traced_now, is_render } = painted;
        if is_render {
            for (to, &render) in self.shown[pixels.clone()].iter_mut().zip(&self.render[pixels]) {
                *to = self.tones.shown(render, tone, self.blend);
            }
            return;
        }
        let colour = holder.map(|node| self.colours[usize::from(node)]);
        let strength = match (is_traced, is_traced_now) {
            (false, false) => 0.16 + 0.14 * self.blend,
            (false, true) => 1.0,
            (true, _) => 0.6,
        };
        // Under another layer it is of no interest whose an atom will be.
        let strength = if self.tones.layer() == Layer::Owners { strength } else { strength * (1.0 - 0.7 * self.blend) };
        let plain = colour.map_or(self.ground, |colour| mix(self.ground, colour, strength));
        if !self.preview.is_empty() && !is_traced_now {
            // Fainter the more owners are shown, so that what is done stands out.
            let share = 0.35 - 0.2 * self.blend;
            for (to, &guess) in self.shown[pixels.clone()].iter_mut().zip(&self.preview[pixels]) {
                *to = mix(plain, guess, share);
            }
        } else {
            self.shown[pixels].fill(plain);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::view::tests::sample_runs;

    const COLOURS: [Rgb; 2] = [[200, 0, 0], [0, 0, 200]];
    const GROUND: Rgb = [10, 10, 10];

    fn finished() -> (Canvas, RunState) {
        let header = sample_runs::header(&[1.0, 1.0], 20);
        let mut state = RunState::new(&header);
        let mut canvas = Canvas::new(header.size, header.division, COLOURS.to_vec(), GROUND);
        sample_runs::records(&header).iter().for_each(|record| state.apply(record));
        canvas.take_dirty();
        let touched = state.take_touched();
        canvas.take(0..20, &vec![[0.0, 1.0, 0.0]; 1000]);
        touched.into_iter().for_each(|atoms| canvas.paint(atoms, &state));
        (canvas, state)
    }

    #[test]
    fn the_render_is_shown_as_it_is_saved() {
        let (canvas, _) = finished();
        assert!(canvas.rows(0..20).iter().all(|&pixel| pixel == srgb8([0.0, 1.0, 0.0])));
    }

    #[test]
    fn the_owners_colour_what_they_traced() {
        let (mut canvas, state) = finished();
        canvas.set_look((Layer::Owners, 1.0), GROUND, &state);
        let [first, last] = [canvas.rows(0..1)[0], canvas.rows(19..20)[49]];
        assert!(first[0] > 150 && first[2] < 80, "{first:?}");
        assert!(last[2] > 150 && last[0] < 80, "{last:?}");
    }

    #[test]
    fn only_what_changed_is_drawn_again() {
        let (mut canvas, state) = finished();
        canvas.take_dirty();
        canvas.set_look((Layer::Owners, 0.0), GROUND, &state);
        assert!(canvas.take_dirty().is_empty());
        canvas.paint(3..4, &state);
        canvas.paint(17..19, &state);
        assert_eq!(canvas.take_dirty(), [3..4, 17..19]);
    }

    #[test]
    fn what_is_not_there_yet_shows_whose_it_will_be() {
        let header = sample_runs::header(&[1.0, 1.0], 20);
        let mut state = RunState::new(&header);
        let mut canvas = Canvas::new(header.size, header.division, COLOURS.to_vec(), GROUND);
        sample_runs::records(&header).iter().take(6).for_each(|record| state.apply(record));
        state.take_touched().into_iter().for_each(|atoms| canvas.paint(atoms, &state));
        let [traced, waiting, other] = [canvas.rows(0..1)[0], canvas.rows(5..6)[0], canvas.rows(15..16)[0]];
        assert_eq!(traced, COLOURS[0]);
        assert!(waiting[0] > GROUND[0] && waiting[0] < 80 && waiting[2] <= GROUND[2], "{waiting:?}");
        assert!(other[2] > GROUND[2] && other[0] <= GROUND[0], "{other:?}");
    }
}
