//! A scene compiled for tracing.

use glam::DVec3;

use super::bvh::Bvh;
use super::media::Medium;
use super::scene_stats::SourceCounts;
use crate::csg::{Pass, Passes, RootId, Solid, Surface, Tree};
use crate::scene::{Light, Material, Scene};

#[derive(Debug)]
pub(super) struct CompiledScene {
    pub tree: Tree,
    /// The roots with finite bounds.
    pub bounded: Bvh,
    /// The roots without finite bounds.
    pub unbounded: Vec<RootId>,
    pub background: DVec3,
    pub lights: Vec<Light>,
    /// The transmitting solids that contain the eye.
    pub eye_media: Vec<Medium>,
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
    pub kt: f64,
    pub exponent: Exponent,
    pub ior: f64,
}

/// Phong's exponent. Whole exponents, the usual case, need no logarithm.
#[derive(Debug)]
pub(super) enum Exponent {
    Whole(i32),
    Real(f64),
}

impl Exponent {
    pub fn raise(&self, base: f64) -> f64 {
        match *self {
            Self::Whole(n) => base.powi(n),
            Self::Real(n) => base.powf(n),
        }
    }
}

impl CompiledScene {
    pub fn new(scene: &Scene, passes: Passes) -> Self {
        let mut tree = Tree::new(passes);
        let (mut bounded, mut unbounded, mut dropped) = (Vec::new(), Vec::new(), 0);
        let (mut solids, mut eye_media) = (Vec::new(), Vec::new());
        for solid in &scene.solids {
            if passes.has(Pass::SplitUnions) {
                split_unions(solid, scene, &mut solids);
            } else {
                solids.push(solid);
            }
        }
        for solid in solids {
            let Some((root, bounds)) = tree.add(solid) else {
                dropped += 1;
                continue;
            };
            if bounds.is_finite() {
                bounded.push((root, bounds));
            } else {
                unbounded.push(root);
            }
            let materials = tree.leaves_of(root).into_iter().map(|leaf| &scene.materials[leaf.tag.index()]);
            let transmitting = materials.into_iter().find(|material| material.kt > 0.0);
            if let Some(material) = transmitting.filter(|_| solid.contains(scene.camera.eye)) {
                eye_media.push(Medium { root, ior: material.ior });
            }
        }
        tree.finish();
        Self {
            tree,
            bounded: if passes.has(Pass::Bvh) { Bvh::new(bounded) } else { Bvh::flat(bounded) },
            unbounded,
            background: scene.background,
            lights: scene.lights.clone(),
            eye_media,
            shadings: scene.materials.iter().map(|material| Shading::new(material, scene.ambient, passes)).collect(),
            source: SourceCounts::of(&scene.solids),
            dropped,
        }
    }

    /// All roots: the unbounded ones first, then those of the hierarchy.
    pub fn roots(&self) -> impl Iterator<Item = RootId> {
        self.unbounded.iter().copied().chain(self.bounded.roots())
    }

    pub fn shading(&self, surface: Surface) -> &Shading {
        &self.shadings[self.tree.leaf(surface).tag.index()]
    }
}

/// Splits opaque unions that the eye is outside of: these look like their operands one by one, and each operand has
/// closer bounds.
fn split_unions<'a>(solid: &'a Solid, scene: &Scene, parts: &mut Vec<&'a Solid>) {
    match solid {
        Solid::Union(solids) if is_opaque(solid, scene) && !solid.contains(scene.camera.eye) => {
            solids.iter().for_each(|solid| split_unions(solid, scene, parts));
        }
        _ => parts.push(solid),
    }
}

fn is_opaque(solid: &Solid, scene: &Scene) -> bool {
    match solid {
        Solid::Placed { tag, .. } => scene.materials[tag.index()].kt == 0.0,
        Solid::Union(solids) | Solid::Intersection(solids) | Solid::Difference(solids) => {
            solids.iter().all(|solid| is_opaque(solid, scene))
        }
    }
}

impl Shading {
    fn new(material: &Material, ambient: DVec3, passes: Passes) -> Self {
        let Material { colour, ka, kd, ks, kt, n, ior } = *material;
        Self {
            ambient: colour * ambient * ka,
            diffuse: colour * kd,
            ks,
            kt,
            exponent: if n.fract() == 0.0 && passes.has(Pass::IntegerPowers) {
                Exponent::Whole(n as i32)
            } else {
                Exponent::Real(n)
            },
            ior,
        }
    }
}
