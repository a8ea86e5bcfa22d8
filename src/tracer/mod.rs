//! Traces pixels: a scene compiled to only what it needs, and the article's equation (§3).

mod bvh;
mod camera;
mod hit;
mod media;
mod path;
mod pattern;
mod shade;
mod world;

pub use path::{Path, RayKind};
pub use shade::Scratch;

use std::ops::{AddAssign, Range};

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::geometry::Aabb;
use crate::picture::{Colour, Quality, Size};
use crate::scene::Scene;
use camera::Camera;
use path::{Nobody, Watch};
use pattern::Pattern;
use world::World;

/// How many rays of each kind were traced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct RayCounts {
    /// From the camera.
    pub primary: u64,
    /// Towards lights.
    pub shadow: u64,
    /// Reflected.
    pub reflected: u64,
    /// Refracted.
    pub refracted: u64,
}

impl RayCounts {
    /// Rays of all kinds.
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

/// A compiled scene, seen by its camera at one size and quality; shared by all threads.
#[derive(Debug)]
pub struct Tracer {
    world: World,
    camera: Camera,
    size: Size,
    quality: Quality,
}

impl Tracer {
    /// Compiles `scene`.
    pub fn new(scene: &Scene, size: Size, quality: Quality) -> Self {
        Self { world: World::new(scene), camera: Camera::new(&scene.camera, size), size, quality }
    }

    /// What the compiled scene kept, in figures.
    pub fn compiled(&self) -> Compiled {
        self.world.compiled()
    }

    /// Width and height of the picture.
    pub fn size(&self) -> Size {
        self.size
    }

    /// How good the picture is.
    pub fn quality(&self) -> Quality {
        self.quality
    }

    /// The boxes of all primitives of solids with bounds, each no larger than its solid's. Outside of its box a
    /// primitive cannot matter.
    pub fn boxes(&self) -> Vec<Aabb> {
        self.world.bounded.roots().flat_map(|root| self.world.tree.boxes_of(root)).collect()
    }

    /// Traces `pixels` (positions in scan order) and appends their colours to `out`.
    ///
    /// The colour of a pixel depends on nothing but the scene, the size, the quality and its position.
    pub fn trace(&self, pixels: Range<u32>, scratch: &mut Scratch, out: &mut Vec<Colour>) {
        out.extend(pixels.map(|pixel| self.pixel(pixel, scratch, &mut Nobody)));
    }

    fn pixel(&self, pixel: u32, scratch: &mut Scratch, watch: &mut impl Watch) -> Colour {
        let (x, y) = (pixel % self.size.width(), pixel / self.size.width());
        let colour = if self.quality.samples == 1 {
            self.sample(&self.camera.ray(x, y, [0.5; 2]), scratch, watch)
        } else {
            let pattern = Pattern::new(x, y, self.quality.pattern);
            let sample = |index| self.sample(&self.camera.ray(x, y, pattern.sample(index)), scratch, watch);
            mean(self.quality.samples.pow(2), self.quality.threshold, sample)
        };
        colour.as_vec3().to_array()
    }
}

/// The mean of at most so many samples: of the first 4, and then of four times as many until its error is estimated as
/// no more than `threshold`. A threshold of 0 takes them all.
fn mean(most: u32, threshold: f64, mut sample: impl FnMut(u32) -> DVec3) -> DVec3 {
    let (mut sum, mut squares, mut count) = (DVec3::ZERO, DVec3::ZERO, 0);
    let mut enough = if threshold > 0.0 { most.min(4) } else { most };
    loop {
        while count < enough {
            let colour = sample(count);
            sum += colour;
            squares += colour * colour;
            count += 1;
        }
        let samples = f64::from(count);
        // As if the samples were independent. They are spread better than that, so that this is too much rather than
        // too little, unless all of them miss what is there.
        let variance = (squares - sum * sum / samples).max_element() / (samples - 1.0);
        if count == most || variance <= threshold * threshold * samples {
            return sum / samples;
        }
        enough = most.min(4 * count);
    }
}

/// What a compiled scene kept of its solids: tells why it costs what it costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Compiled {
    /// Solids that a ray is tested against one by one.
    pub solids: usize,
    /// Solids of these that are made of several primitives.
    pub compositions: usize,
    /// Solids without bounds, which every ray has to be tested against.
    pub unbounded: usize,
    /// Solids that were proved empty and dropped.
    pub dropped: usize,
    /// Lights.
    pub lights: usize,
    /// Whether any surface reflects other solids: if not, no reflection code runs.
    pub reflects: bool,
    /// Whether any surface transmits: if not, no refraction code runs and a shadow ray ends at the first solid.
    pub transmits: bool,
}
