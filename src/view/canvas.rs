//! The picture as it is shown: the render, the owners, or anything between.

use std::ops::Range;

use super::state::RunState;
use super::tones::Tones;
use crate::palette::{Rgb, mix};
use crate::picture::{Atom, Colour, Division, Size, srgb8};

/// The shown picture in 8-bit sRGB, kept up to date piece by piece.
///
/// An atom that is not there yet has a shade of the node in whose queue it is, and stands out while it is traced.
#[derive(Clone, Debug)]
pub struct Canvas {
    size: Size,
    division: Division,
    colours: Vec<Rgb>,
    tones: Tones,
    ground: Rgb,
    blend: f32,
    render: Vec<Rgb>,
    placed: Vec<bool>,
    /// Whether `render` has a preview where nothing is placed.
    previewed: bool,
    shown: Vec<Rgb>,
    dirty: Vec<bool>,
}

impl Canvas {
    /// An empty canvas for nodes of these colours.
    pub fn new(size: Size, division: Division, colours: Vec<Rgb>, ground: Rgb) -> Self {
        let pixels = size.pixels() as usize;
        Self {
            size,
            division,
            tones: Tones::new(&colours),
            colours,
            ground,
            blend: 0.0,
            render: vec![[0; 3]; pixels],
            placed: vec![false; division.atoms() as usize],
            previewed: false,
            shown: vec![ground; pixels],
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

    /// Takes in traced pixels: `pixels` are those of `atoms`.
    pub fn place(&mut self, atoms: Range<Atom>, pixels: &[Colour]) {
        let start = self.division.pixels(atoms.start).start as usize;
        for (to, &from) in self.render[start..].iter_mut().zip(pixels) {
            *to = srgb8(from);
        }
        self.placed[atoms.start as usize..atoms.end as usize].fill(true);
    }

    /// Shows faintly what a pixel, at its place from the left and from the top, will look like.
    pub fn preview(&mut self, guess: impl Fn(u32, u32) -> Colour, state: &RunState) {
        let width = self.size.width();
        for (pixel, to) in (0..).zip(&mut self.render) {
            *to = srgb8(guess(pixel % width, pixel / width));
        }
        self.previewed = true;
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

    /// Shows the render (0), the owners (1) or something between, on `ground`. Nothing is drawn if nothing changes.
    pub fn set_look(&mut self, blend: f32, ground: Rgb, state: &RunState) {
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

    fn paint_atom(&mut self, atom: Atom, pixels: Range<usize>, state: &RunState) {
        let place = atom as usize;
        let (owner, holder) = (state.places()[place].owner(), state.places()[place].holder());
        if self.placed[place] {
            for (to, &render) in self.shown[pixels.clone()].iter_mut().zip(&self.render[pixels]) {
                *to = self.tones.shown(render, owner, self.blend);
            }
            return;
        }
        let traced_now = holder.is_some_and(|node| state.nodes()[usize::from(node)].atom == Some(atom));
        let colour = holder.map(|node| self.colours[usize::from(node)]);
        let strength = match (owner, traced_now) {
            (None, false) => 0.16 + 0.14 * self.blend,
            (None, true) => 1.0,
            (Some(_), _) => 0.6,
        };
        let plain = colour.map_or(self.ground, |colour| mix(self.ground, colour, strength));
        if self.previewed && !traced_now {
            // Fainter the more owners are shown, so that what is done stands out.
            let share = 0.35 - 0.2 * self.blend;
            for (to, &guess) in self.shown[pixels.clone()].iter_mut().zip(&self.render[pixels]) {
                *to = mix(plain, guess, share);
            }
        } else {
            self.shown[pixels].fill(plain);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;

    const COLOURS: [Rgb; 2] = [[200, 0, 0], [0, 0, 200]];
    const GROUND: Rgb = [10, 10, 10];

    fn finished() -> (Canvas, RunState) {
        let header = sample::header(&[1.0, 1.0], 20);
        let mut state = RunState::new(&header);
        let mut canvas = Canvas::new(header.size, header.division, COLOURS.to_vec(), GROUND);
        sample::records(&header).iter().for_each(|record| state.apply(record));
        canvas.take_dirty();
        let touched = state.take_touched();
        canvas.place(0..20, &vec![[0.0, 1.0, 0.0]; 1000]);
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
        canvas.set_look(1.0, GROUND, &state);
        let [first, last] = [canvas.rows(0..1)[0], canvas.rows(19..20)[49]];
        assert!(first[0] > 150 && first[2] < 80, "{first:?}");
        assert!(last[2] > 150 && last[0] < 80, "{last:?}");
    }

    #[test]
    fn only_what_changed_is_drawn_again() {
        let (mut canvas, state) = finished();
        canvas.take_dirty();
        canvas.set_look(0.0, GROUND, &state);
        assert!(canvas.take_dirty().is_empty());
        canvas.paint(3..4, &state);
        canvas.paint(17..19, &state);
        assert_eq!(canvas.take_dirty(), [3..4, 17..19]);
    }

    #[test]
    fn what_is_not_there_yet_shows_whose_it_will_be() {
        let header = sample::header(&[1.0, 1.0], 20);
        let mut state = RunState::new(&header);
        let mut canvas = Canvas::new(header.size, header.division, COLOURS.to_vec(), GROUND);
        sample::records(&header).iter().take(6).for_each(|record| state.apply(record));
        state.take_touched().into_iter().for_each(|atoms| canvas.paint(atoms, &state));
        let [traced, waiting, other] = [canvas.rows(0..1)[0], canvas.rows(5..6)[0], canvas.rows(15..16)[0]];
        assert_eq!(traced, COLOURS[0]);
        assert!(waiting[0] > GROUND[0] && waiting[0] < 80 && waiting[2] <= GROUND[2], "{waiting:?}");
        assert!(other[2] > GROUND[2] && other[0] <= GROUND[0], "{other:?}");
    }
}
