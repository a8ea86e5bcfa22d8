//! `anel inspect`: explains one pixel, as text or as JSON.

use serde_json::{Value, json};

use super::args::InspectArgs;
use super::{Failure, open, print};
use crate::csg::{MaterialTag, RootId, SolidKind, SpanDiagram};
use crate::language::Language;
use crate::picture::srgb8;
use crate::scene::Scene;
use crate::tracer::{ExplainedRay, ExplainedSample, Intersection, RayKind, Tracer};
use crate::view::{Inspected, Term};

pub(super) fn inspect(args: &InspectArgs) -> Result<(), Failure> {
    let opened = open(&args.scene)?;
    let (size, [x, y]) = (args.size, args.pixel);
    let tracer = Tracer::new(&opened.scene, size, args.quality.quality());
    let Some(inspected) = Inspected::new(&tracer, &opened.scene, args.pixel) else {
        let (right, bottom) = (size.width() - 1, size.height() - 1);
        let sentence =
            format!("there is no pixel {x},{y} in a picture of {size}; the lower right pixel is {right},{bottom}");
        return Err(Failure::Refused(sentence));
    };
    if args.json {
        print(&json(&inspected, &tracer, &opened.scene).to_string())
    } else {
        print(inspected.text(Language::English).trim_end())
    }
}

/// The JSON form of the pixel: colours in linear light, distances in units of the scene, infinite distances as null.
fn json(inspected: &Inspected, tracer: &Tracer, scene: &Scene) -> Value {
    let colour = inspected.colour();
    let sample = |sample: &ExplainedSample| sample_json(sample, sample.share(&inspected.samples), scene);
    let samples: Vec<_> = inspected.samples.iter().map(sample).collect();
    let term = |term: Term| {
        let colour = term.colour.to_array();
        json!({ "formula": term.formula, "meaning": term.meaning, "colour": colour, "part_of_pixel": term.part })
    };
    let terms: Vec<_> = inspected.terms(Language::English).into_iter().map(term).collect();
    let spans: Vec<_> = inspected.diagrams.iter().map(|(root, diagram)| solid_json(*root, diagram, scene)).collect();
    json!({
        "width": tracer.size().width(),
        "height": tracer.size().height(),
        "quality": tracer.quality(),
        "pixel": inspected.pixel,
        "colour": colour.to_array(),
        "srgb": srgb8(colour.as_vec3().to_array()),
        "rays": inspected.rays,
        "samples": samples,
        // Terms and spans are those of the first ray of the first sample that counts.
        "terms": terms,
        "spans": spans,
    })
}

fn sample_json(sample: &ExplainedSample, share: f64, scene: &Scene) -> Value {
    let rays: Vec<_> = sample.rays.iter().map(|ray| ray_json(ray, scene)).collect();
    json!({
        "part_of_pixel": share,
        "rays_left_out": sample.rays_left_out,
        "left_out": sample.left_out,
        "rays": rays,
    })
}

fn ray_json(ray: &ExplainedRay, scene: &Scene) -> Value {
    let kind = match ray.path.kind {
        RayKind::Primary => "primary",
        RayKind::Shadow => "shadow",
        RayKind::Reflected => "reflected",
        RayKind::Refracted => "refracted",
    };
    let met = |met: Intersection| {
        let (solid, name) = (met.start.root, name(met.tag, scene));
        json!({ "solid": solid, "material": name, "enters": met.enters, "normal": met.normal.to_array() })
    };
    let lights = ray.lights.iter().map(|lit| {
        let (diffuse, specular) = (lit.diffuse().to_array(), lit.specular().to_array());
        json!({ "light": lit.light, "arriving": lit.arriving.max_element(), "arriving_rgb": lit.arriving.to_array(),
            "diffuse": diffuse, "specular": specular })
    });
    json!({
        "kind": kind,
        "level": ray.path.level,
        "from": ray.path.from,
        "weight": ray.path.weight,
        "factor": ray.path.factor.to_array(),
        "origin": ray.path.ray.origin.to_array(),
        "direction": ray.path.ray.direction.to_array(),
        "to": ray.path.to,
        "inside": ray.inside,
        "met": ray.met.map(met),
        "ambient": ray.ambient.to_array(),
        "lights": lights.collect::<Vec<_>>(),
        "too_deep": ray.too_deep,
    })
}

fn solid_json(root: RootId, figure: &SpanDiagram, scene: &Scene) -> Value {
    let mut solid = figure_json(figure, scene);
    solid["solid"] = json!(root);
    solid
}

fn figure_json(figure: &SpanDiagram, scene: &Scene) -> Value {
    let (what, material) = match figure.kind {
        SolidKind::Primitive { tag, kind } => (kind.to_owned(), name(tag, scene)),
        SolidKind::Composition(operation) => (format!("{operation:?}").to_lowercase(), None),
    };
    let operands: Vec<_> = figure.operands.iter().map(|operand| figure_json(operand, scene)).collect();
    json!({ "what": what, "material": material, "stays": figure.spans, "operands": operands })
}

fn name(tag: MaterialTag, scene: &Scene) -> Option<&str> {
    scene.names.get(tag.index()).map(String::as_str).filter(|name| !name.is_empty())
}
