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

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::csg::Passes;
use crate::geometry::Aabb;
use crate::picture::{Colour, Quality, Size};
use crate::scene::Scene;
use camera::RayCamera;
use compiled_scene::CompiledScene;
use observer::{Note, Observer};
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
            size,
            quality,
            preview: None,
        }
    }

    /// Width and height of the picture.
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
        self.scene.bounded.roots().flat_map(|root| self.scene.tree.boxes_of(root)).collect()
    }

    /// Traces `pixels` (positions in scan order) and appends their colours to `out`.
    ///
    /// A pixel's colour depends only on the scene, the size, the quality and the pixel's position.
    pub fn trace(&self, pixels: Range<u32>, scratch: &mut Scratch, out: &mut Vec<Colour>) {
        out.extend(pixels.map(|pixel| self.previewed_or_traced(pixel, scratch)));
    }

    fn pixel(&self, pixel: u32, scratch: &mut Scratch, observer: &mut impl Observer) -> Colour {
        let (x, y) = (pixel % self.size.width(), pixel / self.size.width());
        let mut at = |place| self.sample(&self.camera.ray(x, y, place), scratch, observer);
        let Quality { samples, threshold, .. } = self.quality;
        let pattern = || SamplePattern::new(x, y, self.quality.pattern);
        let (colour, corners_count) = match samples {
            1 => (at([0.5; 2]), true),
            _ if threshold > 0.0 => adaptive_mean(samples.pow(2), threshold, pattern(), at),
            _ => {
                let pattern = pattern();
                let all = (0..samples.pow(2)).map(|index| at(pattern.sample(index)));
                (all.sum::<DVec3>() / f64::from(samples.pow(2)), true)
            }
        };
        observer.note(|| Note::CornersCount(corners_count));
        colour.as_vec3().to_array()
    }
}

/// Takes samples until their mean is good enough, at most `max_samples` (at least 4). Returns the mean, and whether it
/// includes the corners.
///
/// The first samples are the four corners and four of the pattern: an edge through the pixel separates the corners,
/// however little it cuts off (Whitted 1980 compares corners too), and the other four probably hit small details. If
/// all eight agree within `threshold`, they suffice. Otherwise the pattern goes on, with four times as many samples
/// each time, until the estimated error of its mean is at most `threshold`.
fn adaptive_mean(
    max_samples: u32,
    threshold: f64,
    pattern: SamplePattern,
    mut at: impl FnMut([f64; 2]) -> DVec3,
) -> (DVec3, bool) {
    let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]].map(&mut at);
    let within = [0, 1, 2, 3].map(|index| at(pattern.sample(index)));
    let all = || corners.iter().chain(&within);
    let greatest = all().fold(DVec3::NEG_INFINITY, |greatest, colour| greatest.max(*colour));
    let least = all().fold(DVec3::INFINITY, |least, colour| least.min(*colour));
    if (greatest - least).max_element() <= threshold {
        return (all().sum::<DVec3>() / 8.0, true);
    }
    let mut sum: DVec3 = within.iter().sum();
    let mut squares: DVec3 = within.iter().map(|&colour| colour * colour).sum();
    let mut count = 4;
    while count < max_samples {
        for index in count..max_samples.min(4 * count) {
            let colour = at(pattern.sample(index));
            sum += colour;
            squares += colour * colour;
        }
        count = max_samples.min(4 * count);
        let samples = f64::from(count);
        // The estimate assumes independent samples. These are spread more evenly, so it is too large rather than too
        // small.
        let variance = (squares - sum * sum / samples).max_element() / (samples - 1.0);
        if variance <= threshold * threshold * samples {
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
