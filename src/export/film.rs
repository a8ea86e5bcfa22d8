//! A whole run as pictures one after the other: the picture fills in, beside it the ring, below both the sentence.

use std::io::{self, Write};
use std::time::Duration;

use image::RgbImage;
use image::imageops::{FilterType, overlay, resize};

use super::animation::Animation;
use super::{Raster, to_svg};
use crate::language::Language;
use crate::palette::{PRINT, node_colours};
use crate::picture::{Frame, Size};
use crate::runlog::RunLog;
use crate::time::Time;
use crate::view::{
    Anchor, Canvas, Hue, Layer, Mark, RingLayout, RingOverlay, Snapshot, Summary, TextSize, ring, time_words,
};

/// How a film is made of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Film {
    /// How broad the picture is in it; neither side of the picture is longer.
    pub width: u32,
    /// How long the run takes in it, however long it took.
    pub length: Duration,
    /// What of the picture is shown: the render (0), a layer (1) or something between.
    pub look: (Layer, f32),
}

impl Default for Film {
    fn default() -> Self {
        Self { width: 480, length: Duration::from_secs(10), look: (Layer::Owners, 0.7) }
    }
}

/// How long a frame is seen in hundredths of a second, the format's unit: 12.5 frames a second.
const SEEN: u16 = 8;

/// How long the end is seen: at first as the run left it, then the render alone.
const END_SEEN: u16 = 150;
const RENDER_SEEN: u16 = 300;

/// Between things, and below them for the words.
const GAP: u32 = 16;
const WORDS: u32 = 44;

/// Where things are in a frame.
struct Layout {
    whole: [u32; 2],
    picture: [u32; 4],
    ring: [u32; 4],
    words: [u32; 4],
}

impl Film {
    /// The widest picture in a film, and the narrowest.
    pub const WIDTHS: std::ops::RangeInclusive<u32> = 100..=1920;

    /// Writes a run whose picture is `frame` as an animated GIF that begins again and again. `tell` is told how much of
    /// it is done, 0 to 1, and says whether to go on.
    ///
    /// # Errors
    /// What `to` says; that it was interrupted, if it is not to go on.
    pub fn write(
        self,
        to: impl Write,
        log: &RunLog,
        frame: &Frame,
        tell: &mut dyn FnMut(f64) -> bool,
    ) -> io::Result<()> {
        let layout = Layout::new(self.width, log.header.size);
        let mut animation = Animation::begin(to, layout.whole)?;
        let mut projector = FilmFrames::new(log, frame, self, layout);
        let frames = (self.length.as_millis() as u64 / (10 * u64::from(SEEN))).max(1);
        for number in 0..=frames {
            if !tell(number as f64 / frames as f64) {
                return Err(io::ErrorKind::Interrupted.into());
            }
            let at = Time((u128::from(projector.end.0) * u128::from(number) / u128::from(frames)) as u64);
            let is_last = number == frames;
            let image = projector.at(at, is_last).map_err(io::Error::other)?;
            animation.show(&image, if is_last { END_SEEN } else { SEEN })?;
        }
        projector.look.1 = 0.0;
        animation.show(&projector.at(projector.end, true).map_err(io::Error::other)?, RENDER_SEEN)?;
        animation.end()
    }
}

impl Layout {
    fn new(width: u32, size: Size) -> Self {
        let scale = f64::from(width) / f64::from(size.width().max(size.height()));
        let side = |pixels: u32| ((f64::from(pixels) * scale).round() as u32).max(1);
        let [width, height] = [side(size.width()), side(size.height())];
        let tall = height.max(320);
        // The ring wants a little more breadth than height, for its labels.
        let ring = [tall + tall / 6, tall];
        let whole = [width + ring[0] + 3 * GAP, tall + WORDS + 2 * GAP];
        Self {
            whole,
            picture: [GAP, GAP + (tall - height) / 2, width, height],
            ring: [2 * GAP + width, GAP, ring[0], ring[1]],
            words: [GAP, GAP + tall + GAP / 2, whole[0] - 2 * GAP, WORDS],
        }
    }
}

/// Goes through a run and draws its moments.
struct FilmFrames<'a> {
    log: &'a RunLog,
    look: (Layer, f32),
    moment: Snapshot,
    canvas: Canvas,
    raster: Raster,
    layout: Layout,
    outcome: Option<Summary>,
    /// When the picture was complete, or else the last record.
    end: Time,
    /// How many of the run's seconds go by in one of the film.
    rate: f64,
    /// What the words were last, and how they look.
    words: (String, RgbImage),
}

impl<'a> FilmFrames<'a> {
    fn new(log: &'a RunLog, frame: &Frame, film: Film, layout: Layout) -> Self {
        let header = &log.header;
        let colours = node_colours(header.speeds.len());
        let mut canvas = Canvas::new(header.size, header.division, colours, PRINT.ground);
        canvas.take(0..header.division.atoms(), frame.pixels());
        let finished = log.records().iter().rfind(|record| record.what == crate::record::RecordKind::Finished);
        let end = finished.map_or_else(|| log.end(), |finished| finished.at);
        Self {
            look: film.look,
            moment: Snapshot::new(header),
            canvas,
            raster: Raster::new(),
            layout,
            outcome: Summary::of(log),
            end,
            rate: end.secs() / film.length.as_secs_f64().max(1e-3),
            words: Default::default(),
            log,
        }
    }

    /// The frame of a time, which is not before that of the last one; everything has come to rest at the end.
    fn at(&mut self, at: Time, is_last: bool) -> Result<RgbImage, String> {
        let records = if is_last { self.log.records().len() } else { self.log.until(at) };
        for record in &self.log.records()[self.moment.records().min(records)..records] {
            self.moment.apply(record);
        }
        let state = &mut self.moment.state;
        state.set_rate(self.rate);
        for atoms in state.take_touched() {
            self.canvas.show(atoms, state);
        }
        self.canvas.set_look(self.look, PRINT.ground, state);
        let [width, height] = self.layout.whole;
        let mut image = RgbImage::from_pixel(width, height, image::Rgb(PRINT.ground));
        put(&mut image, self.layout.picture, &self.picture());
        let ring = self.ring(at, is_last)?;
        put(&mut image, self.layout.ring, &ring);
        self.say(at, is_last)?;
        put(&mut image, self.layout.words, &self.words.1);
        Ok(image)
    }

    fn picture(&self) -> RgbImage {
        let size = self.canvas.size();
        let (width, height) = (size.width(), size.height());
        let pixels = self.canvas.rows(0..height).as_flattened().to_vec();
        // There are as many pixels as the size says.
        let whole = RgbImage::from_raw(width, height, pixels).unwrap_or_default();
        let [_, _, across, down] = self.layout.picture;
        if (across, down) == (width, height) { whole } else { resize(&whole, across, down, FilterType::CatmullRom) }
    }

    fn ring(&self, at: Time, is_last: bool) -> Result<RgbImage, String> {
        /// Longer than the last message is drawn.
        const LINGER: Duration = Duration::from_secs(5);
        let overlay = RingOverlay { summary: self.outcome.filter(|_| is_last), ..RingOverlay::default() };
        let at = if is_last { at + LINGER.mul_f64(self.rate.max(1.0)) } else { at };
        let [_, _, width, height] = self.layout.ring;
        let state = &self.moment.state;
        let layout = RingLayout::new(state.nodes().len(), [width as f32, height as f32], Language::English);
        self.drawn(&ring(&layout, state, &overlay, at, Language::English), [width, height])
    }

    /// Time and sentence; drawn only where they are others than before.
    fn say(&mut self, at: Time, is_last: bool) -> Result<(), String> {
        let time = time_words(at, (self.end.secs() / 2.0).clamp(1e-9, 1.0), Language::English);
        let sentence = match self.outcome.filter(|_| is_last) {
            Some(_) => format!("Complete after {time}"),
            None => self.moment.narrator.sentence(&self.moment.state, at, Language::English),
        };
        let both = format!("{time} {sentence}");
        if self.words.0 == both {
            return Ok(());
        }
        let [_, _, width, height] = self.layout.words;
        let y = height as f32 / 2.0;
        let label = |x: f32, anchor: Anchor, text: String, size: f32, hue: Hue| Mark::Label {
            at: [x, y],
            anchor,
            text,
            size: TextSize::Fit(size),
            ink: hue.full(),
        };
        // Where it is told exactly a time is longer.
        let clock = (9.5 * time.chars().count() as f32).max(64.0);
        // About so many letters of this font fit a line, a little more than half as broad as high.
        let fits = (width as f32 - clock - 12.0) / (0.54 * sentence.chars().count().max(1) as f32);
        let marks = [
            label(clock, Anchor::Right, time, 17.0, Hue::Quiet),
            label(clock + 12.0, Anchor::Left, sentence, fits.min(17.0), Hue::Text),
        ];
        self.words = (both, self.drawn(&marks, [width, height])?);
        Ok(())
    }

    fn drawn(&self, marks: &[Mark], [width, height]: [u32; 2]) -> Result<RgbImage, String> {
        let svg = to_svg(marks, [width as f32, height as f32], self.log.header.speeds.len());
        let (size, rgb) = self.raster.draw(&svg, 1.0)?;
        RgbImage::from_raw(size.width(), size.height(), rgb).ok_or_else(|| "a drawing has too few pixels".into())
    }
}

fn put(image: &mut RgbImage, [x, y, ..]: [u32; 4], piece: &RgbImage) {
    overlay(image, piece, x.into(), y.into());
}
