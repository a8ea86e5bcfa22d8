//! A scene for POV-Ray 3.7 with the same shading, to compare pictures and times.
//!
//! POV-Ray weakens pigment by the surface's transmission (the article's equation does not), multiplies ambient and
//! diffuse by the pigment, and has left-handed coordinates unless `right` is negative.

mod limit;
mod medium;
mod placing;
mod primitive;
mod unit;

pub use limit::PovLimit;

use std::fmt::Write;

use glam::DVec3;

use crate::csg::{MaterialTag, Solid};
use crate::picture::{Quality, Size};
use crate::scene::{Camera, Light, Material, Scene};
use limit::{is_coloured, material_limits};
use medium::{Part, parts};
use primitive::{body, vector};
use unit::Unit;

/// A scene for POV-Ray.
#[derive(Clone, Debug)]
pub struct PovScene {
    /// The text of the file.
    pub text: String,
    /// What POV-Ray shows in another way than this program; comments in the text say it too.
    pub limits: Vec<PovLimit>,
}

/// Writes a scene for POV-Ray 3.7. Its picture may have any size; `size` is that of the example in the first comment.
pub fn to_pov(scene: &Scene, size: Size, quality: &Quality) -> PovScene {
    let unit = Unit::of(scene);
    let scene = &unit.apply(scene);
    let (parts, mut limits) = parts(scene);
    let mut used: Vec<MaterialTag> = parts.iter().flat_map(Part::tags).collect();
    used.sort();
    used.dedup();
    let used = used.into_iter().map(MaterialTag::index);
    limits.extend(used.flat_map(|tag| material_limits(&scene.names[tag], &scene.materials[tag])));
    let mut text = String::new();
    put_comments(&mut text, size, unit, &limits);
    put_camera(&mut text, &scene.camera, scene.background, quality);
    for light in &scene.lights {
        put_light(&mut text, light, scene.camera.look_at);
    }
    for (tag, material) in scene.materials.iter().enumerate() {
        put_texture(&mut text, tag, material, scene.ambient);
    }
    // POV-Ray takes the last of the media around the eye for the innermost one. Where media are in each other, the
    // inner one comes first in the scene.
    let (media, opaque): (Vec<&Part>, Vec<&Part>) = parts.iter().partition(|part| part.ior.is_some());
    for part in opaque.into_iter().chain(media.into_iter().rev()) {
        put_part(&mut text, part, scene);
    }
    PovScene { text, limits }
}

fn put_comments(text: &mut String, size: Size, unit: Unit, limits: &[PovLimit]) {
    put(
        text,
        format_args!(
            "// Written by anel for POV-Ray 3.7, for example: povray +W{} +H{} -A File_Gamma=srgb SCENE.pov\n\
             // Any +W and +H are right: the vertical field of view stays.\n\
             // All coordinates are those of the scene times {unit}: POV-Ray's tolerances do not follow the scale.\n",
            size.width(),
            size.height(),
        ),
    );
    for limit in limits {
        put(text, format_args!("// POV-Ray's picture differs: {limit}.\n"));
    }
}

fn put_camera(text: &mut String, camera: &Camera, background: DVec3, quality: &Quality) {
    // With `up` of length 1 this is the distance at which the picture's height is 1.
    let distance = 0.5 / libm::tan(camera.field_of_view.to_radians() / 2.0);
    put(
        text,
        format_args!(
            "#version 3.7;\nglobal_settings {{ assumed_gamma 1 max_trace_level {} adc_bailout {:?} ambient_light rgb 1 \
             }}\nbackground {{ rgb {} }}\n\
             camera {{ location {} direction z*{distance:?} right -x*image_width/image_height up y sky {} look_at {} }}\n",
            quality.max_depth,
            quality.cutoff,
            vector(background),
            vector(camera.eye),
            // Unlike `up`, it is never along the line of sight.
            vector(camera.right().cross((camera.look_at - camera.eye).normalize())),
            vector(camera.look_at),
        ),
    );
}

fn put_light(text: &mut String, light: &Light, look_at: DVec3) {
    match light {
        Light::Point { position, colour } => {
            put(text, format_args!("light_source {{ {} rgb {} }}\n", vector(*position), vector(*colour)));
        }
        Light::Directional { direction, colour } => {
            // No solid may lie behind a light, and none does.
            let from = vector(look_at - *direction * Unit::BEYOND_ALL_SOLIDS);
            let (to, colour) = (vector(look_at), vector(*colour));
            put(text, format_args!("light_source {{ {from} rgb {colour} parallel point_at {to} }}\n"));
        }
    }
}

fn put_texture(text: &mut String, tag: usize, material: &Material, ambient: DVec3) {
    let Material { colour, ka, kd, ks, kt, n, .. } = *material;
    let finish = format!("phong {ks:?} phong_size {n:?} reflection {ks:?}");
    if is_coloured(kt) && ka + kd == 0.0 {
        // `filter` is the part that passes, coloured by the pigment, which nothing else shows.
        let kt = vector(kt);
        put(
            text,
            format_args!(
                "#declare T{tag} = texture {{ pigment {{ rgb {kt} filter 1 }}\n\
                 finish {{ ambient rgb 0 diffuse 0 {finish} }} }}\n"
            ),
        );
        return;
    }
    let kt = kt.max_element();
    // At 1 no pigment would be left to compensate for.
    let kt = if ka + kd > 0.0 { kt.min(1.0 - 1e-6) } else { kt };
    let kept = (1.0 - kt).max(1e-6);
    let (ka, kd) = (ka / kept, kd / kept);
    put(
        text,
        format_args!(
            "#declare T{tag} = texture {{ pigment {{ rgb {} transmit {kt:?} }}\n\
             finish {{ ambient rgb {} diffuse {kd:?} {finish} }} }}\n",
            vector(colour),
            vector(ambient * ka),
        ),
    );
}

/// Writes a part with its textures, and its interior if it transmits light.
fn put_part(text: &mut String, part: &Part, scene: &Scene) {
    let solid = &part.solid;
    let transmits = part.tags().iter().any(|tag| scene.materials[tag.index()].transmits());
    // In a `union` the boundaries of the operands inside each other remain, and `merge` takes longer.
    let union = if transmits || solid.contains(scene.camera.eye) { "merge" } else { "union" };
    put_solid(text, solid, union, None);
    if let Some(MaterialTag(tag)) = common_tag(solid) {
        put(text, format_args!("texture {{ T{tag} }}\n"));
    }
    if transmits {
        put(text, format_args!("interior {{ ior {:?} }}\n", part.ior.unwrap_or(1.0)));
    }
    text.push_str("}\n");
}

/// Writes a solid without its closing brace; `outer` is the material of the composition around it, if it has one.
/// `union` is the name of unions.
fn put_solid(text: &mut String, solid: &Solid, union: &str, outer: Option<MaterialTag>) {
    let (operation, solids) = match solid {
        Solid::Placed { primitive, scene_from_local, .. } => {
            return put(text, format_args!("{}\n", body(primitive, scene_from_local)));
        }
        Solid::Union(solids) => (union, solids),
        Solid::Intersection(solids) => ("intersection", solids),
        Solid::Difference(solids) => ("difference", solids),
    };
    if let [only] = &solids[..] {
        // POV-Ray warns of compositions of one solid.
        return put_solid(text, only, union, outer);
    }
    put(text, format_args!("{operation} {{\n"));
    let outer = outer.or(common_tag(solid));
    for solid in solids {
        put_solid(text, solid, union, outer);
        if let (None, Some(MaterialTag(tag))) = (outer, common_tag(solid)) {
            put(text, format_args!("texture {{ T{tag} }}\n"));
        }
        text.push_str("}\n");
    }
}

/// Returns the tag of all primitives of a solid, if they share one.
fn common_tag(solid: &Solid) -> Option<MaterialTag> {
    match solid {
        Solid::Placed { tag, .. } => Some(*tag),
        Solid::Union(solids) | Solid::Intersection(solids) | Solid::Difference(solids) => {
            let (first, others) = solids.split_first()?;
            common_tag(first).filter(|&tag| others.iter().all(|solid| common_tag(solid) == Some(tag)))
        }
    }
}

fn put(text: &mut String, what: std::fmt::Arguments<'_>) {
    text.write_fmt(what).expect("writing to a String cannot fail");
}
