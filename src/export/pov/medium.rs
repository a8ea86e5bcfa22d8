//! The media of a scene. Where several solids that transmit light overlap, the first in the scene fills the place.
//! POV-Ray instead takes the solid that the ray entered last.

use std::borrow::Cow;

use super::limit::PovLimit;
use super::placing::{Placing, placing};
use crate::csg::{MaterialTag, Passes, Primitive, Solid, Tree};
use crate::geometry::Aabb;
use crate::scene::{Scene, ior, media_of};

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
        for solid in media_of(solid, scene).into_iter().map(Cow::into_owned) {
            let ior = ior(&solid, scene);
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
                Placing::SecondInFirst if part.tags().iter().all(|tag| scene.materials[tag.index()].transmits()) => {
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
