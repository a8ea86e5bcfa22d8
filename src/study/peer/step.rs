//! What is changed in a scene, for both programs alike, so that a cause of differences is gone.

use fastrand::Rng;
use glam::{DAffine3, DVec3};

use crate::csg::Solid;
use crate::picture::Quality;
use crate::scene::{Light, Scene};

/// The steps, in the order in which they are taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Step {
    /// Nothing yet.
    AsItIs,
    /// Faces that coincide no longer do.
    Apart,
    /// Everything is so large that POV-Ray's tolerances, which are absolute, are nothing beside it.
    Large,
    /// What transmits and what reflects adds up to 1, so that total reflection is total for both.
    Lossless,
    /// Every ray is followed down to the limit of the tree, whatever it contributes.
    NoCutoff,
}

/// How far a primitive may move, as a part of the distance from the eye to what it looks at.
const MOVE: f64 = 1e-5;

/// How far the eye is from what it looks at, about, when everything is large. Beyond, POV-Ray's tori become inexact.
const LARGE: f64 = 4096.0;

impl Step {
    pub const ALL: [Self; 5] = [Self::AsItIs, Self::Apart, Self::Large, Self::Lossless, Self::NoCutoff];

    pub fn name(self) -> &'static str {
        match self {
            Self::AsItIs => "as it is",
            Self::Apart => "faces apart",
            Self::Large => "large",
            Self::Lossless => "lossless",
            Self::NoCutoff => "no cutoff",
        }
    }

    /// The cause that the step takes away, who is right, and why.
    pub fn cause(self) -> Option<[&'static str; 2]> {
        Some(match self {
            Self::AsItIs => return None,
            Self::Apart => [
                "faces that coincide",
                "POV-Ray asks of each crossing whether it lies inside the other solids, and on a face that they share \
                 rounding answers. So of two colours on one face it shows now this, now that, as specks, and cutters \
                 that end together leave skins behind. anel takes crossings within 10⁻¹² of each other for one, and \
                 shows the face that stands first in the scene. *anel is right*: a thing that ends where its cutter \
                 ends is cut, and a face has one colour.",
            ],
            Self::Large => [
                "absolute tolerances",
                "POV-Ray overlooks what is nearer than 10⁻⁴ to where a ray starts, and 10⁻³ for a ray to a light, \
                 whatever the scene's unit. anel knows on which face a ray starts and overlooks nothing; its picture \
                 of a scene that is 2ⁿ times as large is the same to the bit. *anel is right*: the larger the scene, \
                 the more POV-Ray agrees with the picture that anel had before.",
            ],
            Self::Lossless => [
                "total internal reflection",
                "Where nothing is let through, POV-Ray's surface reflects everything, even if Ks + Kt is less than 1; \
                 anel's reflects Ks + Kt. The article does not say. *anel is consistent*: what a surface keeps of \
                 light it keeps at every angle.",
            ],
            Self::NoCutoff => [
                "the cutoff",
                "POV-Ray drops each ray that counts less than 1/255, however many there are; anel drops the weakest \
                 rays of a sample, as many as count no more than 1/255 together. And under total internal reflection \
                 POV-Ray counts a ray as Kt of the one before it, though it adds all that it brings, and drops it too \
                 soon. *anel is nearer*: it counts a ray as what it is multiplied by.",
            ],
        })
    }

    pub fn take(self, scene: &mut Scene, quality: &mut Quality) {
        let distance = scene.camera.eye.distance(scene.camera.look_at);
        match self {
            Self::AsItIs => {}
            Self::Apart => {
                let mut chance = Rng::with_seed(1);
                let mut component = || (2.0 * chance.f64() - 1.0) * MOVE * distance;
                move_primitives(&mut scene.solids, &mut |map| {
                    map.translation += DVec3::new(component(), component(), component());
                });
            }
            Self::Large => enlarge(scene, (LARGE / distance).log2().round().exp2()),
            Self::Lossless => {
                for material in scene.materials.iter_mut().filter(|material| material.kt > 0.0) {
                    material.ks = 1.0 - material.kt;
                }
            }
            Self::NoCutoff => quality.cutoff = 0.0,
        }
    }
}

fn enlarge(scene: &mut Scene, factor: f64) {
    scene.camera.eye *= factor;
    scene.camera.look_at *= factor;
    for light in &mut scene.lights {
        if let Light::Point { position, .. } = light {
            *position *= factor;
        }
    }
    let larger = DAffine3::from_scale(DVec3::splat(factor));
    move_primitives(&mut scene.solids, &mut |map| *map = larger * *map);
}

fn move_primitives(solids: &mut [Solid], change: &mut impl FnMut(&mut DAffine3)) {
    for solid in solids {
        match solid {
            Solid::Placed { scene_from_own, .. } => change(scene_from_own),
            Solid::Union(solids) | Solid::Intersection(solids) | Solid::Difference(solids) => {
                move_primitives(solids, change);
            }
        }
    }
}
