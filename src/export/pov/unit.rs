//! The unit of length for POV-Ray, whose tolerances are fixed: it ignores hits nearer than 10⁻⁴ (for a ray to a light
//! 10⁻³) and farther than 10⁷, whatever the scale of the scene.

use std::fmt;

use glam::{DAffine3, DVec3};

use crate::csg::{Passes, Solid, Tree};
use crate::geometry::Aabb;
use crate::scene::{Light, Scene};

/// A factor for all coordinates, a power of two, so that no digit changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Unit {
    exponent: i32,
}

/// The distance to the nearest bounded solid becomes 2¹¹ to 2¹²: many times the tolerances.
const NEAR_EXPONENT: i32 = 11;

/// The distance to the farthest bounded solid becomes less than 2²³, which is less than 10⁷.
const FAR_EXPONENT: i32 = 22;

impl Unit {
    /// A distance at which there is no bounded solid.
    pub const BEYOND_ALL_SOLIDS: f64 = 1e7;

    /// Chooses the unit for a scene. A scene that is 2ⁿ times as large gets a unit that is 2ⁿ times as small.
    pub fn of(scene: &Scene) -> Self {
        let eye = scene.camera.eye;
        let mut tree = Tree::new(Passes::default());
        let bounds = scene.solids.iter().filter_map(|solid| tree.add(solid).map(|(_, bounds)| bounds));
        let farthest = |bounds: Aabb| (bounds.min - eye).abs().max((bounds.max - eye).abs()).length();
        let mut distances: Vec<f64> = bounds.filter(|bounds| bounds.is_finite()).map(farthest).collect();
        if distances.is_empty() {
            distances.push(eye.distance(scene.camera.look_at));
        }
        let near = distances.iter().copied().fold(f64::INFINITY, f64::min);
        let far = distances.iter().copied().fold(0.0, f64::max);
        Self { exponent: (NEAR_EXPONENT - exponent(near)).min(FAR_EXPONENT - exponent(far)) }
    }

    /// Returns the scene with all its coordinates in this unit.
    pub fn apply(self, scene: &Scene) -> Scene {
        let factor = f64::from(self.exponent).exp2();
        let mut scene = scene.clone();
        scene.camera.eye *= factor;
        scene.camera.look_at *= factor;
        for light in &mut scene.lights {
            if let Light::Point { position, .. } = light {
                *position *= factor;
            }
        }
        scene.solids.iter_mut().for_each(|solid| enlarge(solid, factor));
        scene
    }
}

impl fmt::Display for Unit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "2^{}", self.exponent)
    }
}

/// Returns ⌊log₂ x⌋ of a normal positive number, exactly.
fn exponent(x: f64) -> i32 {
    (x.to_bits() >> 52) as i32 - 1023
}

fn enlarge(solid: &mut Solid, factor: f64) {
    match solid {
        Solid::Placed { scene_from_local, .. } => {
            *scene_from_local = DAffine3::from_scale(DVec3::splat(factor)) * *scene_from_local;
        }
        Solid::Union(solids) | Solid::Intersection(solids) | Solid::Difference(solids) => {
            solids.iter_mut().for_each(|solid| enlarge(solid, factor));
        }
    }
}
