//! A scene compiled for tracing.

use glam::DVec3;

use super::bvh::Bvh;
use super::media::Medium;
use super::scene_stats::SourceCounts;
use crate::csg::{Pass, Passes, RayStart, RootId, Solid, Surface, Tree};
use crate::geometry::Ray;
use crate::scene::{Light, Material, Scene, ior, media_of};

#[derive(Debug)]
pub(super) struct CompiledScene {
    pub tree: Tree,
    /// The roots, with and without bounds.
    pub bvh: Bvh,
    pub background: DVec3,
    pub lights: Vec<Light>,
    /// The transmitting solids that the eye is in.
    pub eye_media: Vec<Medium>,
    /// The other solids that the eye is in, and with it every ray: none crosses the boundary of such a solid.
    eye_solids: Vec<RootId>,
    /// The index of refraction of each transmitting root, by the number of its node.
    iors: Vec<f64>,
    pub shadings: Vec<Shading>,
    /// Counts of what the scene file states.
    pub source: SourceCounts,
    /// The number of solids that were proved empty.
    pub dropped: usize,
}

/// A material's coefficients for the equation, with the constants multiplied.
#[derive(Debug)]
pub(super) struct Shading {
    /// Ka Ia times the colour.
    pub ambient: DVec3,
    /// Kd times the colour.
    pub diffuse: DVec3,
    pub ks: f64,
    /// The part that is transmitted: red, green and blue.
    pub kt: DVec3,
    /// Whether any of `kt` is above 0.
    pub transmits: bool,
    pub exponent: Exponent,
}

/// Phong's exponent. Whole exponents, the usual case, need no logarithm.
#[derive(Debug)]
pub(super) enum Exponent {
    Whole(u32),
    Real(f64),
}

impl Exponent {
    pub fn raise(&self, base: f64) -> f64 {
        match *self {
            Self::Whole(n) => whole_power(base, n),
            Self::Real(n) => libm::pow(base, n),
        }
    }
}

/// A power by squaring: two multiplications for each bit of the exponent.
fn whole_power(base: f64, exponent: u32) -> f64 {
    let (mut power, mut square, mut rest) = (1.0, base, exponent);
    while rest > 0 {
        if rest & 1 == 1 {
            power *= square;
        }
        square *= square;
        rest >>= 1;
    }
    power
}

impl CompiledScene {
    pub fn new(scene: &Scene, passes: Passes) -> Self {
        let mut tree = Tree::new(passes);
        let (mut bounded, mut unbounded, mut dropped) = (Vec::new(), Vec::new(), 0);
        let mut transmitting = Vec::new();
        let media: Vec<_> = scene.solids.iter().flat_map(|solid| media_of(solid, scene)).collect();
        let mut solids = Vec::new();
        for solid in &media {
            if passes.has(Pass::SplitUnions) {
                split_unions(solid, scene, &mut solids);
            } else {
                solids.push(&**solid);
            }
        }
        for solid in solids {
            let Some((root, bounds)) = tree.add(solid) else {
                dropped += 1;
                continue;
            };
            let (ior, may_contain_eye) = (ior(solid, scene), solid.contains(scene.camera.eye));
            let is_split = ior.is_none() && !may_contain_eye && passes.has(Pass::LocalParts);
            let parts = if is_split { tree.parts(root, bounds) } else { vec![(root, bounds)] };
            for (root, bounds) in parts {
                if bounds.is_finite() {
                    bounded.push((root, bounds));
                } else {
                    unbounded.push(root);
                }
                transmitting.push((root, ior, may_contain_eye));
            }
        }
        tree.finish();
        let mut iors = Vec::new();
        let (mut eye_media, mut eye_solids) = (Vec::new(), Vec::new());
        for (root, ior, may_contain_eye) in transmitting {
            let is_in = may_contain_eye && tree.contains(root, scene.camera.eye, scene.camera.scale());
            match ior {
                Some(ior) => {
                    iors.resize(root.0 as usize + 1, f64::NAN);
                    iors[root.0 as usize] = ior;
                    eye_media.extend(is_in.then_some(Medium { root, ior }));
                }
                None => eye_solids.extend(is_in.then_some(root)),
            }
        }
        Self {
            tree,
            bvh: if passes.has(Pass::Bvh) { Bvh::new(unbounded, bounded) } else { Bvh::flat(unbounded, bounded) },
            background: scene.background,
            lights: scene.lights.clone(),
            eye_media,
            eye_solids,
            iors,
            shadings: scene.materials.iter().map(|material| Shading::new(material, scene.ambient, passes)).collect(),
            source: SourceCounts::of(&scene.solids),
            dropped,
        }
    }

    /// All roots.
    pub fn roots(&self) -> impl Iterator<Item = RootId> {
        let (unbounded, bounded) = self.bvh.roots();
        unbounded.iter().chain(bounded).copied()
    }

    /// Whether a ray in `media` is in the solid `root`.
    #[inline(always)]
    pub fn is_inside(&self, root: RootId, media: &[Medium]) -> bool {
        media.iter().any(|medium| medium.root == root) || self.eye_solids.contains(&root)
    }

    /// Whether a ray is not where its history has it: in a solid that it has not entered, or not in one that it has not
    /// left.
    pub fn is_lost(&self, ray: &Ray, start: Option<RayStart>, media: &[Medium]) -> bool {
        self.roots().any(|root| self.tree.contradicts(root, ray, start, self.is_inside(root, media)))
    }

    /// The transmitting solid `root` as a medium.
    pub fn medium(&self, root: RootId) -> Medium {
        Medium { root, ior: self.iors[root.0 as usize] }
    }

    pub fn shading(&self, surface: Surface) -> &Shading {
        &self.shadings[self.tree.leaf(surface).tag.index()]
    }
}

/// Splits opaque unions that the eye is outside of: these look like their operands one by one, and each operand has
/// closer bounds.
fn split_unions<'a>(solid: &'a Solid, scene: &Scene, parts: &mut Vec<&'a Solid>) {
    match solid {
        Solid::Union(solids) if ior(solid, scene).is_none() && !solid.contains(scene.camera.eye) => {
            solids.iter().for_each(|solid| split_unions(solid, scene, parts));
        }
        _ => parts.push(solid),
    }
}

impl Shading {
    fn new(material: &Material, ambient: DVec3, passes: Passes) -> Self {
        let Material { colour, ka, kd, ks, kt, n, .. } = *material;
        Self {
            ambient: colour * ambient * ka,
            diffuse: colour * kd,
            ks,
            kt,
            transmits: material.transmits(),
            exponent: if n.fract() == 0.0 && passes.has(Pass::IntegerPowers) {
                Exponent::Whole(n as u32)
            } else {
                Exponent::Real(n)
            },
        }
    }
}
