//! The media of a solid: what light passes through, where a solid has several materials.
//!
//! A medium has one index of refraction. So a union with several indices is several solids: one for the operands of
//! each index, and one for those that do not transmit, in the order in which they come first. Where they overlap, the
//! first fills the space, as for any solids of a scene. A core that does not transmit is thus seen inside its glass. In
//! an intersection or a difference the first operand gives the medium; the operand whose surface is hit gives the
//! colour, Kd, Ks and Kt.

use std::borrow::Cow;

use super::Scene;
use crate::csg::Solid;

/// Returns the index of refraction of a solid: that of its first primitive that transmits; none if none does.
pub fn ior(solid: &Solid, scene: &Scene) -> Option<f64> {
    match solid {
        Solid::Placed { tag, .. } => {
            let material = &scene.materials[tag.index()];
            material.transmits().then_some(material.ior)
        }
        Solid::Union(of) | Solid::Intersection(of) | Solid::Difference(of) => {
            of.iter().find_map(|operand| ior(operand, scene))
        }
    }
}

/// Divides a solid into its media: solids that together fill the same space, at most one for each index of refraction,
/// and one that does not transmit.
pub fn media_of<'a>(solid: &'a Solid, scene: &Scene) -> Vec<Cow<'a, Solid>> {
    let media = if ior(solid, scene).is_some() { divided(solid, scene) } else { Vec::new() };
    if media.len() > 1 { media.into_iter().map(Cow::Owned).collect() } else { vec![Cow::Borrowed(solid)] }
}

/// Returns the numbers, from 1, of the objects of a scene that are divided into several media.
pub fn objects_of_several_media(scene: &Scene) -> Vec<usize> {
    let several = |solid: &Solid| media_of(solid, scene).len() > 1;
    (1..).zip(&scene.solids).filter(|(_, solid)| several(solid)).map(|(number, _)| number).collect()
}

fn divided(solid: &Solid, scene: &Scene) -> Vec<Solid> {
    match solid {
        Solid::Placed { .. } => vec![solid.clone()],
        Solid::Union(of) => {
            let mut media: Vec<(Option<f64>, Vec<Solid>)> = Vec::new();
            for part in of.iter().flat_map(|operand| divided(operand, scene)) {
                let index = ior(&part, scene);
                match media.iter_mut().find(|(known, _)| *known == index) {
                    Some((_, parts)) => parts.push(part),
                    None => media.push((index, vec![part])),
                }
            }
            media.into_iter().map(|(_, parts)| Solid::Union(parts)).collect()
        }
        Solid::Intersection(of) => with_first_divided(of, scene).map(Solid::Intersection).collect(),
        Solid::Difference(of) => with_first_divided(of, scene).map(Solid::Difference).collect(),
    }
}

/// The operands once for each medium of the first one.
fn with_first_divided<'a>(of: &'a [Solid], scene: &Scene) -> impl Iterator<Item = Vec<Solid>> + use<'a> {
    let (first, rest) = of.split_first().map_or((Vec::new(), of), |(first, rest)| (divided(first, scene), rest));
    first.into_iter().map(move |part| [&[part], rest].concat())
}
