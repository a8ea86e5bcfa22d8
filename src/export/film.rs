//! A run as an animation: the picture fills in, beside the ring; time and sentence are below both.

use std::io::{self, Write};
use std::time::Duration;

use image::RgbImage;
use image::imageops::{FilterType, overlay, resize};

use super::animation::Animation;
use super::{ExportError, Raster, to_svg};
use crate::language::Language;
use crate::palette::{PRINT, node_colours};
use crate::picture::{Frame, Size};
use crate::runlog::RunLog;
use crate::time::Time;
use crate::view::{
    Anchor, Canvas, Hue, Layer, Mark, RingLayout, RingOverlay, Snapshot, Summary, TextSize, TimeScale, ring, time_words,
};

/// Settings of a run's animation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Film {
    /// Length of the picture's longer side in the animation, in pixels.
    pub width: u32,
    /// Duration of the run in the animation, whatever the run took.
    pub length: Duration,
    /// Look of the picture: a layer, and its weight from 0 (the render) to 1 (the layer).
    pub look: (Layer, f32),
}

impl Default for Film {
    fn default() -> Self {
        Self { width: 480, length: Duration::from_secs(10), look: (Layer::Owners, 0.7) }
    }
}

/// How long a frame is shown in hundredths of a second, the format's unit: 12.5 frames a second.
const FRAME_CENTISECONDS: u16 = 8;

/// How long the end is shown, in hundredths of a second: as the run left it, then the render alone.
const END_CENTISECONDS: u16 = 150;
const RENDER_CENTISECONDS: u16 = 300;

/// Gap between the parts, and height of the caption below them, in pixels.
const GAP_PX: u32 = 16;
const CAPTION_HEIGHT_PX: u32 = 44;

/// Places of the parts in a frame: x, y, width and height in pixels.
struct Layout {
    whole: [u32; 2],
    picture: [u32; 4],
    ring: [u32; 4],
    caption: [u32; 4],
}

impl Film {
    /// Possible values of [`Film::width`].
    pub const WIDTHS: std::ops::RangeInclusive<u32> = 100..=1920;

    /// Possible values of [`Film::length`], in seconds.
    pub const SECONDS: std::ops::RangeInclusive<f64> = 1.0..=120.0;

    /// Returns width and height of the animation of a picture, in pixels.
    pub fn size(self, picture: Size) -> [u32; 2] {
        Layout::new(self.width, picture).whole
    }

    /// Returns how long the whole animation takes: the run, then its end.
    pub fn duration(self) -> Duration {
        self.length + Duration::from_millis(10 * u64::from(END_CENTISECONDS + RENDER_CENTISECONDS))
    }

    /// Draws the frame of a time of the run. Returns its size and its pixels: three bytes each, in scan order.
    ///
    /// # Errors
    /// An [`ExportError`], if it cannot be drawn.
    pub fn still(self, log: &RunLog, frame: &Frame, at: Time) -> Result<(Size, Vec<u8>), ExportError> {
        let mut film_frames = FilmFrames::new(log, frame, self, Layout::new(self.width, log.header.size));
        let image = film_frames.at(at.min(film_frames.end), at >= film_frames.end)?;
        let size = Size::new(image.width(), image.height()).map_err(|error| ExportError::Size(error.into()))?;
        Ok((size, image.into_raw()))
    }

    /// Writes a run whose picture is `frame` as an endlessly repeating GIF. `tell` gets the finished fraction, 0 to 1,
    /// and returns whether to go on.
    ///
    /// # Errors
    /// The error of writing to `to`; [`io::ErrorKind::Interrupted`], if `tell` returns false; an [`ExportError`], if a
    /// frame cannot be drawn.
    pub fn write(
        self,
        to: impl Write,
        log: &RunLog,
        frame: &Frame,
        tell: &mut dyn FnMut(f64) -> bool,
    ) -> io::Result<()> {
        let layout = Layout::new(self.width, log.header.size);
        let mut animation = Animation::begin(to, layout.whole)?;
        let mut film_frames = FilmFrames::new(log, frame, self, layout);
        let frames = (self.length.as_millis() as u64 / (10 * u64::from(FRAME_CENTISECONDS))).max(1);
        for number in 0..=frames {
            if !tell(number as f64 / frames as f64) {
                return Err(io::ErrorKind::Interrupted.into());
            }
            let at = Time((u128::from(film_frames.end.0) * u128::from(number) / u128::from(frames)) as u64);
            let is_last = number == frames;
            let image = film_frames.at(at, is_last).map_err(io::Error::other)?;
            animation.show(&image, if is_last { END_CENTISECONDS } else { FRAME_CENTISECONDS })?;
        }
        film_frames.look.1 = 0.0;
        animation.show(&film_frames.at(film_frames.end, true).map_err(io::Error::other)?, RENDER_CENTISECONDS)?;
        animation.end()
    }
}

impl Layout {
    fn new(width: u32, size: Size) -> Self {
        let scale = f64::from(width) / f64::from(size.width().max(size.height()));
        let side = |pixels: u32| ((f64::from(pixels) * scale).round() as u32).max(1);
        let [width, height] = [side(size.width()), side(size.height())];
        let tall = height.max(320);
        // The ring needs a little more width than height, for its labels.
        let ring = [tall + tall / 6, tall];
        let whole = [width + ring[0] + 3 * GAP_PX, tall + CAPTION_HEIGHT_PX + 2 * GAP_PX];
        Self {
            whole,
            picture: [GAP_PX, GAP_PX + (tall - height) / 2, width, height],
            ring: [2 * GAP_PX + width, GAP_PX, ring[0], ring[1]],
            caption: [GAP_PX, GAP_PX + tall + GAP_PX / 2, whole[0] - 2 * GAP_PX, CAPTION_HEIGHT_PX],
        }
    }
}

/// Steps through a run and draws its frames.
struct FilmFrames<'a> {
    log: &'a RunLog,
    look: (Layer, f32),
    snapshot: Snapshot,
    canvas: Canvas,
    raster: Raster,
    layout: Layout,
    outcome: Option<Summary>,
    /// When the picture was complete, or else the last record.
    end: Time,
    /// Seconds of the run in a second of the animation.
    rate: f64,
    /// The last caption, and its image.
    caption: (String, RgbImage),
}

impl<'a> FilmFrames<'a> {
    fn new(log: &'a RunLog, frame: &Frame, film: Film, layout: Layout) -> Self {
        let header = &log.header;
        let colours = node_colours(header.speeds.len());
        let mut canvas = Canvas::new(header.size, header.division, colours, PRINT.ground);
        canvas.take(0..header.division.atoms(), frame.pixels());
        let finished = log.records().iter().rfind(|record| record.kind == crate::record::RecordKind::Finished);
        let end = finished.map_or_else(|| log.end(), |finished| finished.at);
        Self {
            look: film.look,
            snapshot: Snapshot::new(header),
            canvas,
            raster: Raster::new(""),
            layout,
            outcome: Summary::of(log),
            end,
            rate: end.secs() / film.length.as_secs_f64().max(1e-3),
            caption: Default::default(),
            log,
        }
    }

    /// Draws the frame of a time, which is not before that of the last frame; in the last one all messages have
    /// arrived.
    fn at(&mut self, at: Time, is_last: bool) -> Result<RgbImage, ExportError> {
        let records = if is_last { self.log.records().len() } else { self.log.until(at) };
        for record in &self.log.records()[self.snapshot.records().min(records)..records] {
            self.snapshot.apply(record);
        }
        let state = &mut self.snapshot.state;
        state.set_rate(self.rate);
        for atoms in state.take_touched() {
            self.canvas.show(atoms, state);
        }
        self.canvas.set_look(self.look, PRINT.ground, state);
        let [width, height] = self.layout.whole;
        let mut image = RgbImage::from_pixel(width, height, image::Rgb(PRINT.ground));
        paste(&mut image, self.layout.picture, &self.picture());
        let ring = self.ring(at, is_last)?;
        paste(&mut image, self.layout.ring, &ring);
        self.draw_caption(at, is_last)?;
        paste(&mut image, self.layout.caption, &self.caption.1);
        Ok(image)
    }

    fn picture(&self) -> RgbImage {
        let size = self.canvas.size();
        let (width, height) = (size.width(), size.height());
        let pixels = self.canvas.rows(0..height).as_flattened().to_vec();
        // The canvas has as many pixels as its size says.
        let whole = RgbImage::from_raw(width, height, pixels).unwrap_or_default();
        let [_, _, across, down] = self.layout.picture;
        if (across, down) == (width, height) { whole } else { resize(&whole, across, down, FilterType::CatmullRom) }
    }

    fn ring(&self, at: Time, is_last: bool) -> Result<RgbImage, ExportError> {
        /// Longer than the last message is drawn.
        const LINGER: Duration = Duration::from_secs(5);
        let overlay = RingOverlay { summary: self.outcome.filter(|_| is_last), ..RingOverlay::default() };
        let at = if is_last { at + LINGER.mul_f64(self.rate.max(1.0)) } else { at };
        let [_, _, width, height] = self.layout.ring;
        let state = &self.snapshot.state;
        let layout = RingLayout::new(state.nodes().len(), [width as f32, height as f32], Language::English);
        self.draw(&ring(&layout, state, &overlay, at, Language::English), [width, height])
    }

    /// Draws time and sentence, if they differ from the last caption.
    fn draw_caption(&mut self, at: Time, is_last: bool) -> Result<(), ExportError> {
        let time = time_words(at, TimeScale::of_length(self.end), Language::English);
        let sentence = match self.outcome.filter(|_| is_last) {
            Some(_) => format!("Complete after {time}"),
            None => self.snapshot.narrator.sentence(&self.snapshot.state, at, Language::English),
        };
        let both = format!("{time} {sentence}");
        if self.caption.0 == both {
            return Ok(());
        }
        let [_, _, width, height] = self.layout.caption;
        let y = height as f32 / 2.0;
        let label = |x: f32, anchor: Anchor, text: String, size: f32, hue: Hue| Mark::Label {
            at: [x, y],
            anchor,
            text,
            size: TextSize::Fit(size),
            ink: hue.full(),
        };
        // A time with more decimals is longer.
        let clock = (9.5 * time.chars().count() as f32).max(64.0);
        // Text size at which the sentence fits: this font's letters are a little more than half as wide as high.
        let fits = (width as f32 - clock - 12.0) / (0.54 * sentence.chars().count().max(1) as f32);
        let marks = [
            label(clock, Anchor::Right, time, 17.0, Hue::Quiet),
            label(clock + 12.0, Anchor::Left, sentence, fits.min(17.0), Hue::Text),
        ];
        self.caption = (both, self.draw(&marks, [width, height])?);
        Ok(())
    }

    fn draw(&self, marks: &[Mark], [width, height]: [u32; 2]) -> Result<RgbImage, ExportError> {
        let svg = to_svg(marks, [width as f32, height as f32]);
        let (size, rgb) = self.raster.draw(&svg, 1.0)?;
        RgbImage::from_raw(size.width(), size.height(), rgb).ok_or(ExportError::TooFewPixels(size))
    }
}

fn paste(image: &mut RgbImage, [x, y, ..]: [u32; 4], piece: &RgbImage) {
    overlay(image, piece, x.into(), y.into());
}
