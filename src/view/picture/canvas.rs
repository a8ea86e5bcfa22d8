//! The shown picture: the render, a layer of colour, or a mixture of both.

use std::ops::Range;
use std::sync::Arc;

use super::overlay::{Layer, Shades};
use crate::balance::NodeId;
use crate::palette::{Rgb, luminance, mix};
use crate::picture::{Atom, Colour, Division, Size, srgb8};
use crate::view::state::run_state::RunState;

/// The shown picture in 8-bit sRGB, updated atom by atom.
///
/// An atom that is not traced yet has a shade of the node that has it, and the node's full colour while it is traced.
#[derive(Clone, Debug)]
pub struct Canvas {
    size: Size,
    division: Division,
    colours: Vec<Rgb>,
    tones: Shades,
    ground: Rgb,
    blend: f32,
    /// Mean cost of an atom with which the layer of costs compares.
    mean_cost: f64,
    render: Vec<Rgb>,
    /// By atom: whether `render` has its pixels.
    has_pixels: Vec<bool>,
    /// Preview of the render; may be empty. It is apart from `render`, so that a time that is shown again looks the
    /// same.
    preview: Arc<[Rgb]>,
    /// Drawn by [`Canvas::set_look`] at first, and then atom by atom.
    shown: Vec<Rgb>,
    /// Whether all of `shown` is to be drawn again with the next look.
    is_stale: bool,
    /// By atom: its look in `shown`.
    painted: Vec<Painted>,
    /// By row: whether it has changed since [`Canvas::take_dirty`].
    dirty: Vec<bool>,
}

/// Properties of an atom that decide its look.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Painted {
    holder: Option<NodeId>,
    tone: Option<u16>,
    is_traced: bool,
    is_traced_now: bool,
    is_render: bool,
}

impl Canvas {
    /// Creates an empty canvas for nodes with these colours.
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
            has_pixels: vec![false; division.atoms() as usize],
            preview: Arc::default(),
            shown: vec![[0; 3]; pixels],
            is_stale: true,
            painted: vec![Painted::default(); division.atoms() as usize],
            dirty: vec![true; size.height() as usize],
        }
    }

    /// Width and height.
    pub fn size(&self) -> Size {
        self.size
    }

    /// Colour where nothing is drawn.
    pub fn ground(&self) -> Rgb {
        self.ground
    }

    /// Adds the traced pixels of atoms. They are shown once the parent has placed them.
    pub fn take(&mut self, atoms: Range<Atom>, pixels: &[Colour]) {
        let start = self.division.pixels(atoms.start).start as usize;
        for (to, &from) in self.render[start..].iter_mut().zip(pixels) {
            *to = srgb8(from);
        }
        self.has_pixels[atoms.start as usize..atoms.end as usize].fill(true);
    }

    /// Shows a preview of all pixels, in scan order, faintly; none if it is empty.
    pub fn preview(&mut self, preview: Arc<[Rgb]>) {
        self.preview = preview;
        self.is_stale = true;
    }

    /// Redraws atoms.
    pub fn paint(&mut self, atoms: Range<Atom>, state: &RunState) {
        for atom in if self.is_stale { 0..0 } else { atoms } {
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

    /// Redraws those of the atoms whose look has changed.
    pub fn show(&mut self, atoms: Range<Atom>, state: &RunState) {
        for atom in if self.is_stale { 0..0 } else { atoms } {
            if self.painted[atom as usize] != self.to_paint(atom, state) {
                self.paint(atom..atom + 1, state);
            }
        }
    }

    /// Redraws all atoms whose look has changed.
    pub fn show_all(&mut self, state: &RunState) {
        self.show(0..self.division.atoms(), state);
    }

    /// Sets the mixture of the render (`blend` 0) and a layer (1), and the ground. Redraws only if something changes.
    pub fn set_look(&mut self, (layer, blend): (Layer, f32), ground: Rgb, state: &RunState) {
        /// The mean cost of the layer follows in steps of this ratio, or each new atom would redraw all others.
        const MEAN_COST_STEP: f64 = 1.1;
        if layer != self.tones.layer() {
            self.tones = Shades::new(layer, &self.colours);
            self.blend = f32::NAN;
        }
        let mean = state.mean_cost();
        let is_off = !(self.mean_cost / MEAN_COST_STEP..=self.mean_cost * MEAN_COST_STEP).contains(&mean);
        if layer == Layer::Costs && is_off {
            self.mean_cost = mean;
            self.show_all(state);
        }
        if self.is_stale || (blend, ground) != (self.blend, self.ground) {
            (self.blend, self.ground, self.is_stale) = (blend, ground, false);
            self.paint(0..self.division.atoms(), state);
        }
    }

    /// Takes the rows that have changed since the last call; ranges that nearly touch are joined.
    pub fn take_dirty(&mut self) -> Vec<Range<u32>> {
        const MAX_GAP_ROWS: u32 = 8;
        let mut runs: Vec<Range<u32>> = Vec::new();
        for (row, dirty) in (0..).zip(&mut self.dirty) {
            if !std::mem::take(dirty) {
                continue;
            }
            match runs.last_mut() {
                Some(run) if row < run.end + MAX_GAP_ROWS => run.end = row + 1,
                _ => runs.push(row..row + 1),
            }
        }
        runs
    }

    /// Shown pixels of a range of rows.
    pub fn rows(&self, rows: Range<u32>) -> &[Rgb] {
        let width = self.size.width() as usize;
        &self.shown[rows.start as usize * width..rows.end as usize * width]
    }

    fn to_paint(&self, atom: Atom, state: &RunState) -> Painted {
        let atom_state = state.atom_states()[atom as usize];
        let (holder, is_traced) = (atom_state.holder(), atom_state.owner().is_some());
        let is_traced_now = holder.is_some_and(|node| state.nodes()[usize::from(node)].atom == Some(atom));
        let tone = self.tones.of(atom, state, self.mean_cost);
        Painted {
            holder,
            tone,
            is_traced,
            is_traced_now,
            is_render: atom_state.is_placed() && self.has_pixels[atom as usize],
        }
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
        // Under other layers the future owner is shown faintly.
        let strength = if self.tones.layer() == Layer::Owners { strength } else { strength * (1.0 - 0.7 * self.blend) };
        let plain = colour.map_or(self.ground, |colour| mix(self.ground, colour, strength));
        if !self.preview.is_empty() && !is_traced_now {
            // Fainter the more of the layer is shown, so that traced atoms stand out.
            let share = 0.35 - 0.2 * self.blend;
            blend_in(plain, &self.preview[pixels.clone()], share, &mut self.shown[pixels.clone()]);
        } else {
            self.shown[pixels.clone()].fill(plain);
        }
        if !(is_traced || is_traced_now) {
            self.hatch(pixels);
        }
    }

    /// Draws stripes over pixels that are not traced, on a light ground: there their shade could be that of a finished
    /// picture. On a dark ground it is dark.
    fn hatch(&mut self, pixels: Range<usize>) {
        /// Distance of the stripes as a share of the picture's width.
        const STRIPE_DISTANCE: u32 = 64;
        const LEAST_DISTANCE_PX: usize = 6;
        if luminance(self.ground) < 0.5 {
            return;
        }
        let width = self.size.width() as usize;
        let distance = ((self.size.width() / STRIPE_DISTANCE) as usize).max(LEAST_DISTANCE_PX);
        for pixel in pixels {
            if (pixel % width + pixel / width) % distance < distance / 3 {
                self.shown[pixel] = mix(self.shown[pixel], self.ground, 0.7);
            }
        }
    }
}

/// Blends `share` of each of the pixels into a colour, as [`mix`] does, in whole numbers: whole pictures are drawn so
/// in one frame.
fn blend_in(plain: Rgb, pixels: &[Rgb], share: f32, out: &mut [Rgb]) {
    const WHOLE: u32 = 1 << 16;
    let share = (share * WHOLE as f32) as u32;
    let [r, g, b] = plain.map(|channel| u32::from(channel) * (WHOLE - share) + WHOLE / 2);
    for (to, &[red, green, blue]) in out.iter_mut().zip(pixels) {
        let blend = |plain: u32, channel: u8| ((plain + u32::from(channel) * share) / WHOLE) as u8;
        *to = [blend(r, red), blend(g, green), blend(b, blue)];
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
        canvas.set_look((Layer::Owners, 0.0), GROUND, &state);
        touched.into_iter().for_each(|atoms| canvas.paint(atoms, &state));
        (canvas, state)
    }

    #[test]
    fn render_is_shown_as_it_is_saved() {
        let (canvas, _) = finished();
        assert!(canvas.rows(0..20).iter().all(|&pixel| pixel == srgb8([0.0, 1.0, 0.0])));
    }

    #[test]
    fn owners_colour_their_atoms() {
        let (mut canvas, state) = finished();
        canvas.set_look((Layer::Owners, 1.0), GROUND, &state);
        let [first, last] = [canvas.rows(0..1)[0], canvas.rows(19..20)[49]];
        assert!(first[0] > 150 && first[2] < 80, "{first:?}");
        assert!(last[2] > 150 && last[0] < 80, "{last:?}");
    }

    #[test]
    fn only_changed_rows_are_drawn_again() {
        let (mut canvas, state) = finished();
        canvas.take_dirty();
        canvas.set_look((Layer::Owners, 0.0), GROUND, &state);
        assert!(canvas.take_dirty().is_empty());
        canvas.paint(3..4, &state);
        canvas.paint(17..19, &state);
        assert_eq!(canvas.take_dirty(), [3..4, 17..19]);
    }

    /// A run that has begun, on this ground.
    fn begun(ground: Rgb) -> Canvas {
        let header = sample_runs::header(&[1.0, 1.0], 20);
        let mut state = RunState::new(&header);
        let mut canvas = Canvas::new(header.size, header.division, COLOURS.to_vec(), ground);
        sample_runs::records(&header).iter().take(6).for_each(|record| state.apply(record));
        canvas.set_look((Layer::Owners, 0.0), ground, &state);
        canvas
    }

    #[test]
    fn preview_is_blended_as_by_mix() {
        let pixels: Vec<Rgb> = (0..=255).map(|value| [value, 255 - value, value / 2]).collect();
        for share in [0.15, 0.2, 0.35] {
            let mut blended = vec![[0; 3]; pixels.len()];
            blend_in([3, 128, 250], &pixels, share, &mut blended);
            for (&one, &pixel) in blended.iter().zip(&pixels) {
                let expected = mix([3, 128, 250], pixel, share);
                assert!(one.iter().zip(expected).all(|(&a, b)| a.abs_diff(b) <= 1), "{one:?}, {expected:?}");
            }
        }
    }

    #[test]
    fn untraced_atoms_are_hatched_on_a_light_ground() {
        let kinds = |canvas: &Canvas, row: u32| {
            let mut pixels = canvas.rows(row..row + 1).to_vec();
            pixels.sort_unstable();
            pixels.dedup();
            pixels.len()
        };
        let (light, dark) = (begun([250; 3]), begun(GROUND));
        assert_eq!([kinds(&light, 0), kinds(&light, 5), kinds(&dark, 5)], [1, 2, 1]);
    }

    #[test]
    fn untraced_atom_has_a_shade_of_its_holder() {
        let canvas = begun(GROUND);
        let [traced, waiting, other] = [canvas.rows(0..1)[0], canvas.rows(5..6)[0], canvas.rows(15..16)[0]];
        assert_eq!(traced, COLOURS[0]);
        assert!(waiting[0] > GROUND[0] && waiting[0] < 80 && waiting[2] <= GROUND[2], "{waiting:?}");
        assert!(other[2] > GROUND[2] && other[0] <= GROUND[0], "{other:?}");
    }
}
