//! Changes of a scene, for both programs alike, that each remove a cause of differences.

use fastrand::Rng;
use glam::{DAffine3, DVec3};

use crate::csg::Solid;
use crate::picture::Quality;
use crate::scene::Scene;

/// The steps, in the order in which they are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// No change.
    AsItIs,
    /// Coincident faces are moved apart.
    Apart,
    /// Ks + Kt = 1 for transparent materials, so that total reflection is total in both programs.
    Lossless,
    /// Every ray is followed down to the limit of the tree, whatever it contributes.
    NoCutoff,
}

/// Greatest move of a primitive, as a fraction of the distance from the eye to the point it looks at.
const MAX_MOVE: f64 = 1e-5;

impl Step {
    pub const ALL: [Self; 4] = [Self::AsItIs, Self::Apart, Self::Lossless, Self::NoCutoff];

    pub fn name(self) -> &'static str {
        match self {
            Self::AsItIs => "as it is",
            Self::Apart => "faces apart",
            Self::Lossless => "lossless",
            Self::NoCutoff => "no cutoff",
        }
    }

    /// Returns the cause that the step removes, and which program is right and why.
    pub fn cause(self) -> Option<[&'static str; 2]> {
        Some(match self {
            Self::AsItIs => return None,
            Self::Apart => [
                "coincident faces",
                "POV-Ray tests each crossing against the other solids, and on a shared face rounding decides the \
                 result. So a face with two colours shows specks of either, and cutters that end together with their \
                 solid leave skins behind. anel treats crossings within 10⁻¹² of each other as one, and shows the \
                 face that comes first in the scene. *anel is right*: a solid that ends where its cutter ends is cut, \
                 and a face has one colour.",
            ],
            Self::Lossless => [
                "total internal reflection",
                "Where no light is transmitted, POV-Ray's surface reflects all of it, even if Ks + Kt is less than 1; \
                 anel's surface reflects Ks + Kt. The article does not specify this. *anel is consistent*: a surface \
                 absorbs the same share of light at every angle.",
            ],
            Self::NoCutoff => [
                "the cutoff",
                "POV-Ray drops each ray that counts less than 1/255, however many there are; anel drops the weakest \
                 rays of a sample, as long as they count no more than 1/255 together. Under total internal reflection \
                 POV-Ray also weights a ray by Kt of the ray before it, though it adds all of its light, and drops it \
                 too soon. *anel is closer*: it weights a ray by the factor that multiplies its light.",
            ],
        })
    }

    pub fn apply(self, scene: &mut Scene, quality: &mut Quality) {
        let distance = scene.camera.eye.distance(scene.camera.look_at);
        match self {
            Self::AsItIs => {}
            Self::Apart => {
                let mut chance = Rng::with_seed(1);
                let mut component = || (2.0 * chance.f64() - 1.0) * MAX_MOVE * distance;
                move_primitives(&mut scene.solids, &mut |map| {
                    map.translation += DVec3::new(component(), component(), component());
                });
            }
            Self::Lossless => {
                for material in scene.materials.iter_mut().filter(|material| material.transmits()) {
                    material.ks = 1.0 - material.kt.max_element();
                }
            }
            Self::NoCutoff => quality.cutoff = 0.0,
        }
    }
}

fn move_primitives(solids: &mut [Solid], change: &mut impl FnMut(&mut DAffine3)) {
    for solid in solids {
        match solid {
            Solid::Placed { scene_from_local, .. } => change(scene_from_local),
            Solid::Union(solids) | Solid::Intersection(solids) | Solid::Difference(solids) => {
                move_primitives(solids, change);
            }
        }
    }
}
