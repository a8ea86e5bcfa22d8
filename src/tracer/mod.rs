//! Traces pixels: a scene compiled to only what it needs, and the article's equation (§3).

mod bvh;
mod camera;
mod hit;
mod media;
mod path;
mod shade;
mod world;

pub use path::{Path, RayKind};
pub use shade::Scratch;

use std::ops::{AddAssign, Range};

use serde::{Deserialize, Serialize};

use crate::geometry::Aabb;
use crate::picture::{Colour, Size};
use crate::scene::Scene;
use camera::Camera;
use path::{Nobody, Watch};
use world::World;

/// How good the picture is to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// n × n samples a pixel, on a regular grid.
    pub samples: u32,
    /// The limit of the tree of rays (§3: "for example 10 levels"); a primary ray is level 1.
    pub max_depth: u32,
    /// A ray that can contribute no more than this to its pixel is not followed (§3: "irrelevant").
    pub cutoff: f64,
}

impl Default for Quality {
    fn default() -> Self {
        Self { samples: 1, max_depth: 10, cutoff: 1.0 / 255.0 }
    }
}

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
        let camera = Camera::new(&scene.camera, size, quality.samples.max(1));
        Self { world: World::new(scene), camera, size, quality }
    }

    /// What the compiled scene kept, in figures.
    pub fn compiled(&self) -> Compiled {
        self.world.compiled()
    }

    /// Width and height of the picture.
    pub fn size(&self) -> Size {
        self.size
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
        let samples = self.camera.rays(x, y).map(|ray| self.sample(&ray, scratch, watch));
        let mean = samples.reduce(|sum, colour| sum + colour).unwrap_or_default() / self.camera.rays_a_pixel();
        mean.as_vec3().to_array()
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
