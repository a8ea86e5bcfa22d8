//! The tracer: a compiled scene, and the article's equation (§3).

mod bvh;
mod camera;
mod compiled_scene;
mod explain;
mod intersect;
mod media;
mod observer;
mod paths;
mod pattern;
mod preview;
mod ray_queue;
mod scene_stats;
mod shade;

pub use explain::{ExplainedRay, ExplainedSample};
pub use observer::{Intersection, LightTerm, Path, RayKind};
pub use paths::LostRays;
pub use preview::Preview;
pub use scene_stats::SceneStats;
pub use shade::Scratch;

use std::ops::{AddAssign, Range};

use glam::{DVec3, DVec4};
use serde::{Deserialize, Serialize};

use crate::csg::Passes;
use crate::geometry::{Aabb, Ray};
use crate::picture::{Colour, Quality, Region, Size};
use crate::scene::Scene;
use camera::RayCamera;
use compiled_scene::CompiledScene;
use observer::{Note, Observer, PrimaryHit};
use pattern::SamplePattern;

/// The number of rays of each kind.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct RayCounts {
    /// From the camera.
    pub primary: u64,
    /// Towards a light.
    pub shadow: u64,
    /// From a reflecting surface.
    pub reflected: u64,
    /// Through a transmitting surface.
    pub refracted: u64,
}

impl RayCounts {
    /// The sum over all kinds.
    pub fn total(&self) -> u64 {
        self.primary + self.shadow + self.reflected + self.refracted
    }

    fn count(&mut self, kind: RayKind) {
        *match kind {
            RayKind::Primary => &mut self.primary,
            RayKind::Shadow => &mut self.shadow,
            RayKind::Reflected => &mut self.reflected,
            RayKind::Refracted => &mut self.refracted,
        } += 1;
    }
}

impl AddAssign for RayCounts {
    fn add_assign(&mut self, other: Self) {
        self.primary += other.primary;
        self.shadow += other.shadow;
        self.reflected += other.reflected;
        self.refracted += other.refracted;
    }
}

/// A compiled scene with its camera, at one size and quality; shared by all threads.
#[derive(Debug)]
pub struct Tracer {
    scene: CompiledScene,
    camera: RayCamera,
    /// The first column and row that are traced, and how many.
    corner: [u32; 2],
    size: Size,
    quality: Quality,
    preview: Option<Preview>,
}

impl Tracer {
    /// Compiles `scene`.
    pub fn new(scene: &Scene, size: Size, quality: Quality) -> Self {
        Self::with_passes(scene, size, quality, Passes::default())
    }

    /// Compiles `scene` by some of the passes only. The picture is the same.
    pub fn with_passes(scene: &Scene, size: Size, quality: Quality, passes: Passes) -> Self {
        Self {
            scene: CompiledScene::new(scene, passes),
            camera: RayCamera::new(&scene.camera, size),
            corner: [0; 2],
            size,
            quality,
            preview: None,
        }
    }

    /// The tracer of a region of the picture alone: position 0 is the region's upper left pixel. The pixels are those
    /// of the whole picture.
    #[must_use]
    pub fn of_region(self, region: Region) -> Self {
        Self { corner: [region.x, region.y], size: region.size, preview: None, ..self }
    }

    /// Width and height of the picture, or of its region.
    pub fn size(&self) -> Size {
        self.size
    }

    /// The quality of the picture.
    pub fn quality(&self) -> Quality {
        self.quality
    }

    /// The boxes of all primitives of bounded solids, each clipped to its solid's bounds. Outside its box a primitive
    /// cannot matter.
    pub fn boxes(&self) -> Vec<Aabb> {
        self.scene.bvh.roots().1.iter().flat_map(|&root| self.scene.tree.boxes_of(root)).collect()
    }

    /// Traces `pixels` (positions in scan order) and appends their colours to `out`.
    ///
    /// A pixel's colour depends only on the scene, the size, the quality and the pixel's position.
    pub fn trace(&self, pixels: Range<u32>, scratch: &mut Scratch, out: &mut Vec<Colour>) {
        out.extend(pixels.map(|pixel| self.previewed_or_traced(pixel, scratch)));
    }

    /// Traces `pixels` (positions in scan order) without the background, and appends their colours to `out`. Passes
    /// each pixel's position and the share of it that solids cover to `covered`, 0 to 1; the colours are premultiplied
    /// (see [`Coverage`](crate::picture::Coverage)).
    ///
    /// Only primary rays see no background: reflected and refracted rays do. The threshold holds over any background
    /// with channels from 0 to 1.
    pub fn trace_transparent(
        &self,
        pixels: Range<u32>,
        scratch: &mut Scratch,
        out: &mut Vec<Colour>,
        mut covered: impl FnMut(u32, f32),
    ) {
        out.extend(pixels.map(|pixel| {
            let (mean, _) = self.mean(pixel, |ray| {
                let mut primary = PrimaryHit::default();
                let colour = self.sample(ray, scratch, &mut primary);
                if primary.is_hit() { colour.extend(1.0) } else { DVec4::ZERO }
            });
            covered(pixel, mean.w as f32);
            mean.truncate().as_vec3().to_array()
        }));
    }

    fn pixel(&self, pixel: u32, scratch: &mut Scratch, observer: &mut impl Observer) -> Colour {
        let (mean, corners_count) = self.mean(pixel, |ray| self.sample(ray, scratch, observer).extend(1.0));
        observer.note(|| Note::CornersCount(corners_count));
        mean.truncate().as_vec3().to_array()
    }

    /// Takes samples of a pixel, given by their primary rays: a colour and how much it covers. Returns their mean, and
    /// whether it includes the corners.
    #[inline(always)]
    fn mean(&self, pixel: u32, mut sample: impl FnMut(&Ray) -> DVec4) -> (DVec4, bool) {
        let [left, top] = self.corner;
        let (x, y) = (left + pixel % self.size.width(), top + pixel / self.size.width());
        let mut at = |place| sample(&self.camera.ray(x, y, place));
        let Quality { samples, threshold, .. } = self.quality;
        let pattern = || SamplePattern::new(x, y, self.quality.pattern);
        match samples {
            1 => (at([0.5; 2]), true),
            _ if threshold > 0.0 => adaptive_mean(samples.pow(2), threshold, pattern(), at),
            _ => {
                let pattern = pattern();
                let all = (0..samples.pow(2)).map(|index| at(pattern.sample(index)));
                (all.sum::<DVec4>() / f64::from(samples.pow(2)), true)
            }
        }
    }
}

/// Takes samples until their mean is good enough, at most `max_samples` (at least 4). Returns the mean, and whether it
/// includes the corners.
///
/// The first samples are the four corners and four of the pattern: an edge through the pixel separates the corners,
/// however little it cuts off (Whitted 1980 compares corners too), and the other four probably hit small details. If
/// all eight agree within `threshold`, they suffice. Otherwise the pattern goes on, with four times as many samples
/// each time, until the estimated error of its mean is at most `threshold`.
///
/// A sample is a premultiplied colour with its coverage as the fourth component. Samples are compared over black and
/// over white: the error over any background lies between.
fn adaptive_mean(
    max_samples: u32,
    threshold: f64,
    pattern: SamplePattern,
    mut at: impl FnMut([f64; 2]) -> DVec4,
) -> (DVec4, bool) {
    const BACKGROUNDS: [f64; 2] = [0.0, 1.0];
    // The sum of `samples` samples, or one of them, over a background.
    let over = |sum: DVec4, samples: f64, background: f64| sum.truncate() + background * (samples - sum.w);
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(&mut at);
    let within = [0, 1, 2, 3].map(|index| at(pattern.sample(index)));
    let all = || corners.iter().chain(&within);
    let contrast = |background| {
        let shown = || all().map(|&sample| over(sample, 1.0, background));
        let greatest = shown().fold(DVec3::NEG_INFINITY, DVec3::max);
        let least = shown().fold(DVec3::INFINITY, DVec3::min);
        (greatest - least).max_element()
    };
    if BACKGROUNDS.into_iter().all(|background| contrast(background) <= threshold) {
        return (all().sum::<DVec4>() / 8.0, true);
    }
    let square = |sample: DVec4, background| over(sample, 1.0, background) * over(sample, 1.0, background);
    let mut sum: DVec4 = within.iter().sum();
    let mut squares =
        BACKGROUNDS.map(|background| within.iter().map(|&sample| square(sample, background)).sum::<DVec3>());
    let mut count = 4;
    while count < max_samples {
        for index in count..max_samples.min(4 * count) {
            let sample = at(pattern.sample(index));
            sum += sample;
            for (squares, background) in squares.iter_mut().zip(BACKGROUNDS) {
                *squares += square(sample, background);
            }
        }
        count = max_samples.min(4 * count);
        let samples = f64::from(count);
        // The estimate assumes independent samples. These are spread more evenly, so it is too large rather than too
        // small.
        let variance = |(squares, background): (DVec3, f64)| {
            let sum = over(sum, samples, background);
            (squares - sum * sum / samples).max_element() / (samples - 1.0)
        };
        let variances = squares.into_iter().zip(BACKGROUNDS).map(variance);
        if variances.into_iter().all(|variance| variance <= threshold * threshold * samples) {
            break;
        }
    }
    (sum / f64::from(count), false)
}

/// A step in scan order that takes about `looked_at` pixels of a picture.
///
/// It is odd: an odd number seldom divides the width, so that the pixels lie in many columns.
pub fn sampling_step(size: Size, looked_at: u32) -> u32 {
    (size.pixels() / looked_at) | 1
}
