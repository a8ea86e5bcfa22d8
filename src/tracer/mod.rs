//! Traces pixels: a scene compiled to only what it needs, and the article's equation (§3).

use std::ops::{AddAssign, Range};

use serde::{Deserialize, Serialize};

use crate::picture::{Colour, Size};
use crate::scene::Scene;

/// How good the picture is to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// n × n samples a pixel.
    pub samples: u32,
    /// The article's limit of the tree of rays; a primary ray is level 1.
    pub max_depth: u32,
    /// A ray that can contribute no more than this to its pixel is not followed.
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
    size: Size,
}

/// What a thread needs to trace, kept from pixel to pixel so that nothing is allocated; it counts the rays.
#[derive(Debug, Default)]
pub struct Scratch {
    /// Rays traced with this scratch so far.
    pub rays: RayCounts,
}

impl Tracer {
    /// Compiles `scene`.
    pub fn new(_scene: &Scene, size: Size, _quality: Quality) -> Self {
        Self { size }
    }

    /// The picture's size.
    pub fn size(&self) -> Size {
        self.size
    }

    /// Traces `pixels` (positions in scan order) and appends their colours to `out`.
    ///
    /// The colour of a pixel depends on nothing but the scene, the size, the quality and its position.
    pub fn trace(&self, pixels: Range<u32>, scratch: &mut Scratch, out: &mut Vec<Colour>) {
        // STUB: replaced by the real tracer; costs about 0.2 µs a pixel.
        for pixel in pixels {
            let mut x = f64::from(pixel) * 1e-3;
            for _ in 0..20 {
                x = (x + 1.3).sin() * 1.7;
            }
            scratch.rays.primary += 1;
            out.push([x as f32, (pixel % 256) as f32 / 256.0, 0.5]);
        }
    }
}
