//! A scene for POV-Ray 3.7 with the same shading, to compare pictures and times.
//!
//! POV-Ray weakens pigment by the surface's transmission (the article's equation does not), multiplies ambient and
//! diffuse by the pigment, and has left-handed coordinates unless `right` is negative.

use std::fmt::Write;

use glam::{DAffine3, DVec3};

use crate::csg::{MaterialTag, Primitive, Solid};
use crate::picture::{Quality, Size};
use crate::scene::{Light, Material, Scene};

/// Returns the text of a POV-Ray scene file for a picture with the aspect ratio of `size`.
pub fn to_pov(scene: &Scene, size: Size, quality: &Quality) -> String {
    let mut text = String::from("// Written by anel; render it with +W… +H… in the proportions it was written for.\n");
    let camera = &scene.camera;
    let aspect = f64::from(size.width()) / f64::from(size.height());
    let across = 2.0 * ((camera.field_of_view.to_radians() / 2.0).tan() * aspect).atan();
    put(
        &mut text,
        format_args!(
            "#version 3.7;\nglobal_settings {{ assumed_gamma 1 max_trace_level {} adc_bailout {} ambient_light rgb 1 }}\n\
             background {{ rgb {} }}\n\
             camera {{ location {} right -x*{aspect} up y angle {} sky {} look_at {} }}\n",
            quality.max_depth,
            quality.cutoff,
            vector(scene.background),
            vector(camera.eye),
            across.to_degrees(),
            vector(camera.up),
            vector(camera.look_at),
        ),
    );
    for light in &scene.lights {
        match light {
            Light::Point { position, colour } => {
                put(&mut text, format_args!("light_source {{ {} rgb {} }}\n", vector(*position), vector(*colour)));
            }
            Light::Directional { direction, colour } => {
                let from = vector(camera.look_at - *direction * 1e6);
                let to = vector(camera.look_at);
                let colour = vector(*colour);
                put(&mut text, format_args!("light_source {{ {from} rgb {colour} parallel point_at {to} }}\n"));
            }
        }
    }
    for (tag, material) in scene.materials.iter().enumerate() {
        put_material(&mut text, tag, material, scene.ambient);
    }
    for solid in &scene.solids {
        put_solid(&mut text, solid);
    }
    text
}

fn put_material(text: &mut String, tag: usize, material: &Material, ambient: DVec3) {
    let Material { colour, ka, kd, ks, kt, n, ior } = *material;
    let kt = kt.max_element();
    // At 1 no pigment would be left to compensate for.
    let kt = if ka + kd > 0.0 { kt.min(1.0 - 1e-6) } else { kt };
    let kept = (1.0 - kt).max(1e-6);
    let (ka, kd) = (ka / kept, kd / kept);
    put(
        text,
        format_args!(
            "#declare M{tag} = material {{ texture {{ pigment {{ rgb {} transmit {kt} }}\n\
             finish {{ ambient rgb {} diffuse {kd} phong {ks} phong_size {n} reflection {ks} }} }}\n\
             interior {{ ior {ior} }} }}\n",
            vector(colour),
            vector(ambient * ka),
        ),
    );
}

/// Writes a solid. It has one interior in POV-Ray, so the material is at the outermost composition whose parts all have
/// it.
fn put_solid(text: &mut String, solid: &Solid) {
    put_parts(text, solid, common_tag(solid));
    if let Some(MaterialTag(tag)) = common_tag(solid) {
        put(text, format_args!("material {{ M{tag} }}\n"));
    }
    text.push_str("}\n");
}

/// Writes a solid without its closing brace; `outer` is the material of the composition around it.
fn put_parts(text: &mut String, solid: &Solid, outer: Option<MaterialTag>) {
    let (operation, solids) = match solid {
        Solid::Placed { primitive, scene_from_local, .. } => {
            return put(text, format_args!("{}\n", body(primitive, scene_from_local)));
        }
        Solid::Union(solids) => ("union", solids),
        Solid::Intersection(solids) => ("intersection", solids),
        Solid::Difference(solids) => ("difference", solids),
    };
    if let [only] = &solids[..] {
        // POV-Ray warns of compositions of one solid.
        return put_parts(text, only, outer);
    }
    put(text, format_args!("{operation} {{\n"));
    for solid in solids {
        if outer.is_some() {
            put_parts(text, solid, outer);
            text.push_str("}\n");
        } else {
            put_solid(text, solid);
        }
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

/// Returns the placed primitive without its closing brace.
fn body(primitive: &Primitive, scene_from_local: &DAffine3) -> String {
    let own = match primitive {
        Primitive::Sphere => "sphere { 0, 1".into(),
        Primitive::HalfSpace { normal, offset } => return plane(*normal, *offset, scene_from_local),
        Primitive::Cube => "box { -1, 1".into(),
        Primitive::Cylinder => "cylinder { -y, y, 1".into(),
        Primitive::Cone { bottom, top } => format!("cone {{ -y, {bottom}, y, {top}"),
        // POV-Ray's default solver loses roots.
        Primitive::Torus { tube } => format!("torus {{ 1, {tube} sturm"),
        Primitive::Quadric(q) => format!(
            "quadric {{ {}, {}, {}, {}",
            vector(q.squares),
            // POV-Ray's order is xy, xz, yz.
            vector(DVec3::new(q.products.x, q.products.z, q.products.y)),
            vector(q.linear),
            q.constant
        ),
    };
    format!("{own} {}", matrix(scene_from_local))
}

/// Returns a half-space in scene coordinates: POV-Ray computes wrong bounds for a composition if a matrix scales a
/// plane in it, and the composition disappears.
fn plane(normal: DVec3, offset: f64, scene_from_local: &DAffine3) -> String {
    let outward = (scene_from_local.matrix3.inverse().transpose() * normal).normalize();
    let point = scene_from_local.transform_point3(normal * offset);
    format!("plane {{ {}, {}", vector(outward), outward.dot(point))
}

fn matrix(map: &DAffine3) -> String {
    let numbers: Vec<_> = map.to_cols_array().iter().map(f64::to_string).collect();
    format!("matrix <{}>", numbers.join(", "))
}

fn vector(v: DVec3) -> String {
    format!("<{}, {}, {}>", v.x, v.y, v.z)
}

fn put(text: &mut String, what: std::fmt::Arguments<'_>) {
    text.write_fmt(what).expect("writing to a String cannot fail");
}
