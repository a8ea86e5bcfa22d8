//! The media of a scene. Where several solids that transmit light overlap, the first in the scene fills the place.
//! POV-Ray instead takes the solid that the ray entered last.

use super::limit::PovLimit;
use super::placing::{Placing, placing};
use crate::csg::{MaterialTag, Passes, Primitive, Solid, Tree};
use crate::geometry::Aabb;
use crate::scene::Scene;

/// A solid of the file: a solid of the scene, or a part of one that is a medium of its own.
#[derive(Clone, Debug)]
pub(super) struct Part {
    /// The number of its object in the scene, from 1.
    pub object: usize,
    pub solid: Solid,
    /// The index of refraction; `None` if it is opaque.
    pub ior: Option<f64>,
    pub bounds: Aabb,
}

impl Part {
    /// Returns the tags of its primitives.
    pub fn tags(&self) -> Vec<MaterialTag> {
        let mut tags = Vec::new();
        collect_tags(&self.solid, &mut tags);
        tags
    }
}

/// Returns the parts of a scene in its order, and the media that POV-Ray shows in another way.
///
/// Media that are apart look the same in both programs, and so does one that is inside another and comes before it in
/// the scene. One inside another that comes before it does not exist and is left out.
pub(super) fn parts(scene: &Scene) -> (Vec<Part>, Vec<PovLimit>) {
    let mut tree = Tree::new(Passes::default());
    let mut parts: Vec<Part> = Vec::new();
    for (index, solid) in scene.solids.iter().enumerate() {
        for (solid, ior) in media_of(solid, scene) {
            // A part without bounds is empty.
            let bounds = tree.add(&solid).map(|(_, bounds)| bounds);
            parts.extend(bounds.map(|bounds| Part { object: index + 1, solid, ior, bounds }));
        }
    }
    let (mut limits, mut hidden) = (Vec::new(), vec![false; parts.len()]);
    let mut unclear = Vec::new();
    for (second, part) in parts.iter().enumerate().filter(|(_, part)| part.ior.is_some()) {
        let before = parts[..second].iter().enumerate().filter(|(_, part)| part.ior.is_some());
        for (first, other) in before {
            match placing([&other.solid, &part.solid], [other.bounds, part.bounds]) {
                Placing::Apart | Placing::FirstInSecond => {}
                // Opaque faces are visible in every medium.
                Placing::SecondInFirst if part.tags().iter().all(|tag| scene.materials[tag.index()].kt > 0.0) => {
                    hidden[second] = true;
                }
                Placing::SecondInFirst | Placing::Unclear => unclear.push([first, second]),
            }
        }
    }
    let exists = |pair: &[usize; 2]| !pair.iter().any(|&part| hidden[part]);
    limits.extend(unclear.into_iter().filter(exists).map(|pair| PovLimit::Media(pair.map(|part| parts[part].object))));
    limits.dedup();
    let mut hidden = hidden.into_iter();
    parts.retain(|_| hidden.next() != Some(true));
    let around_eye = |part: &&Part| part.ior.is_some() && part.solid.contains(scene.camera.eye);
    let eye_media: Vec<&Part> = parts.iter().filter(around_eye).collect();
    // POV-Ray finds the media around the eye in the order of its hierarchy of boxes, where those without a box stand
    // first or last.
    if let [inner @ .., _] = &eye_media[..]
        && inner.iter().any(|part| !has_box(&part.solid))
    {
        limits.push(PovLimit::EyeInMedia(eye_media.len()));
    }
    (parts, limits)
}

/// Returns the media of a solid with their indices of refraction: the operands of a union that are opaque, or have the
/// same index, are one; in the order of their first operands.
fn media_of(solid: &Solid, scene: &Scene) -> Vec<(Solid, Option<f64>)> {
    let mut operands = Vec::new();
    flatten(solid, &mut operands);
    let mut media: Vec<(Vec<Solid>, Option<f64>)> = Vec::new();
    for operand in operands {
        let ior = ior_of(operand, scene);
        match media.iter_mut().find(|(_, known)| *known == ior) {
            Some((solids, _)) => solids.push(operand.clone()),
            None => media.push((vec![operand.clone()], ior)),
        }
    }
    match media.len() {
        1 => vec![(solid.clone(), media[0].1)],
        _ => media.into_iter().map(|(solids, ior)| (Solid::Union(solids), ior)).collect(),
    }
}

/// Adds the operands of a union and of unions in it.
fn flatten<'a>(solid: &'a Solid, operands: &mut Vec<&'a Solid>) {
    match solid {
        Solid::Union(solids) => solids.iter().for_each(|solid| flatten(solid, operands)),
        _ => operands.push(solid),
    }
}

/// Returns the index of refraction of a solid that is one medium, which is its first operand's; `None` if it is
/// opaque.
fn ior_of(solid: &Solid, scene: &Scene) -> Option<f64> {
    match solid {
        Solid::Placed { tag, .. } => {
            Some(&scene.materials[tag.index()]).filter(|material| material.kt > 0.0).map(|material| material.ior)
        }
        Solid::Union(solids) | Solid::Intersection(solids) | Solid::Difference(solids) => {
            ior_of(solids.first()?, scene)
        }
    }
}

/// Whether POV-Ray certainly puts a box around a solid.
fn has_box(solid: &Solid) -> bool {
    match solid {
        Solid::Placed { primitive, .. } => !matches!(primitive, Primitive::HalfSpace { .. } | Primitive::Quadric(_)),
        Solid::Union(solids) => solids.iter().all(has_box),
        Solid::Intersection(solids) => solids.iter().any(has_box),
        Solid::Difference(solids) => solids.first().is_none_or(has_box),
    }
}

fn collect_tags(solid: &Solid, tags: &mut Vec<MaterialTag>) {
    match solid {
        Solid::Placed { tag, .. } => tags.push(*tag),
        Solid::Union(solids) | Solid::Intersection(solids) | Solid::Difference(solids) => {
            solids.iter().for_each(|solid| collect_tags(solid, tags));
        }
    }
}
