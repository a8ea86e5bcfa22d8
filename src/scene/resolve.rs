//! Resolution of a scene file: replaces names by what they refer to, and transforms by affine maps.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DAffine3, DMat3, DVec3};
use thiserror::Error;

use super::repeat::Step;
use super::syntax::{SceneFile, SolidFields, Transform};
use super::validate::MAX_LEAVES;
use super::{Material, Scene};
use crate::csg::{MaterialTag, Primitive, QuadricCoefficients, Solid};
use crate::geometry::turn_y_to;
use crate::sentence;

/// An error in a scene's names, nesting or transforms.
#[derive(Debug, Error)]
#[error("{}{problem}", object.map(|index| format!("object {}: ", index + 1)).unwrap_or_default())]
pub(super) struct ResolveError {
    /// The name whose place in the text is the place of the error, if there is one.
    pub name: Option<String>,
    /// The index of the object with the error, if no name gives its place.
    object: Option<usize>,
    problem: Problem,
}

#[derive(Debug, Error)]
enum Problem {
    #[error("there is no {what} `{name}`; {known}")]
    UnknownName { what: &'static str, name: String, known: String },
    #[error("a solid uses itself: {0}")]
    Circle(String),
    #[error("solids are nested more than {MAX_DEPTH} deep; use fewer levels")]
    TooDeep,
    #[error("the scene has more than {MAX_LEAVES} primitives once its named solids and copies are put in; use fewer")]
    TooManyPrimitives,
    #[error("its transforms make a solid too large or too small to be computed with; check the factors of Scale")]
    OutOfRange,
}

impl ResolveError {
    fn new(name: Option<&str>, problem: Problem) -> Self {
        Self { name: name.map(str::to_owned), object: None, problem }
    }
}

/// The greatest depth of solids in solids, uses of named solids included.
const MAX_DEPTH: usize = 100;
/// The tag of solids without a material.
const NO_MATERIAL: MaterialTag = MaterialTag(0);

pub(super) fn resolve(file: SceneFile) -> Result<Scene, ResolveError> {
    let mut materials: Vec<Material> = vec![Material::default()];
    let mut tags = BTreeMap::new();
    let mut material_names = vec![String::new()];
    for (name, material) in file.materials.0 {
        material_names.push(name.clone());
        tags.insert(name, MaterialTag(materials.len() as u32));
        materials.push(material);
    }
    let mut names =
        NameResolver { tags, solids: &file.solids.0, used: BTreeSet::new(), path: Vec::new(), leaves: 0, depth: 0 };
    let mut solids = Vec::new();
    for (index, object) in file.objects.iter().enumerate() {
        let solid = names.solid(object, DAffine3::IDENTITY, NO_MATERIAL);
        // An error without a name gives at least the object's number.
        solids.push(solid.map_err(|error| match error.name {
            None => ResolveError { object: Some(index), ..error },
            Some(_) => error,
        })?);
    }
    // Solids that no object uses must be valid too.
    for (name, solid) in &file.solids.0 {
        if names.used.contains(name.as_str()) {
            continue;
        }
        names.path = vec![name];
        names.solid(solid, DAffine3::IDENTITY, NO_MATERIAL)?;
    }
    let SceneFile { camera, background, ambient, lights, .. } = file;
    Ok(Scene { camera, background, ambient, lights, materials, names: material_names, solids })
}

struct NameResolver<'a> {
    tags: BTreeMap<String, MaterialTag>,
    solids: &'a BTreeMap<String, SolidFields>,
    used: BTreeSet<&'a str>,
    /// The chain of named solids that contain the current one.
    path: Vec<&'a str>,
    leaves: usize,
    depth: usize,
}

impl<'a> NameResolver<'a> {
    /// Resolves a solid. `outer` and `tag` are the transform and the material of the solid around it.
    fn solid(&mut self, solid: &'a SolidFields, outer: DAffine3, tag: MaterialTag) -> Result<Solid, ResolveError> {
        use SolidFields as S;
        let (S::Sphere { material, transform, .. }
        | S::HalfSpace { material, transform, .. }
        | S::Box { material, transform, .. }
        | S::Cylinder { material, transform, .. }
        | S::Cone { material, transform, .. }
        | S::Torus { material, transform, .. }
        | S::Quadric { material, transform, .. }
        | S::Union { material, transform, .. }
        | S::Intersection { material, transform, .. }
        | S::Difference { material, transform, .. }
        | S::Repeat { material, transform, .. }
        | S::Use { material, transform, .. }) = solid;
        let tag = match material {
            None => tag,
            Some(name) => *self.tags.get(name).ok_or_else(|| unknown("material", name, self.tags.keys()))?,
        };
        let outer = outer * Transform::map_of(transform);
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return Err(ResolveError::new(self.path.last().copied(), Problem::TooDeep));
        }
        let placed = match solid {
            S::Union { of, .. } => Solid::Union(self.all(of, outer, tag)?),
            S::Intersection { of, .. } => Solid::Intersection(self.all(of, outer, tag)?),
            S::Difference { of, .. } => Solid::Difference(self.all(of, outer, tag)?),
            // The copies are counted as they are made, so that nested ones end with an error before they fill memory.
            S::Repeat { count, step, of, .. } => {
                let maps = Step::new(step).maps().take(*count);
                Solid::Union(maps.map(|map| self.solid(of, outer * map, tag)).collect::<Result<_, _>>()?)
            }
            S::Use { solid: name, .. } => self.used(name, outer, tag)?,
            leaf => self.leaf(leaf, outer, tag)?,
        };
        self.depth -= 1;
        Ok(placed)
    }

    fn all(
        &mut self,
        solids: &'a [SolidFields],
        outer: DAffine3,
        tag: MaterialTag,
    ) -> Result<Vec<Solid>, ResolveError> {
        solids.iter().map(|solid| self.solid(solid, outer, tag)).collect()
    }

    fn used(&mut self, name: &'a str, outer: DAffine3, tag: MaterialTag) -> Result<Solid, ResolveError> {
        let solid = self.solids.get(name).ok_or_else(|| unknown("solid", name, self.solids.keys()))?;
        if let Some(from) = self.path.iter().position(|&user| user == name) {
            let circle: Vec<_> = self.path[from..].iter().chain([&name]).map(|name| shown(name)).collect();
            return Err(ResolveError::new(Some(name), Problem::Circle(circle.join(" → "))));
        }
        self.used.insert(name);
        self.path.push(name);
        let placed = self.solid(solid, outer, tag)?;
        self.path.pop();
        Ok(placed)
    }

    fn leaf(&mut self, leaf: &SolidFields, outer: DAffine3, tag: MaterialTag) -> Result<Solid, ResolveError> {
        self.leaves += 1;
        if self.leaves > MAX_LEAVES {
            return Err(ResolveError::new(self.path.last().copied(), Problem::TooManyPrimitives));
        }
        let (primitive, outer_from_local) = primitive(leaf);
        let scene_from_local = outer * outer_from_local;
        // If the determinant overflowed, the inverse would be 0.
        let is_normal = scene_from_local.matrix3.determinant().is_normal();
        if !is_normal || !scene_from_local.is_finite() || !scene_from_local.inverse().is_finite() {
            return Err(ResolveError::new(self.path.last().copied(), Problem::OutOfRange));
        }
        Ok(Solid::Placed { primitive, scene_from_local, tag })
    }
}

/// The primitive of a leaf, and the map from its own coordinates to those of the scene file.
fn primitive(leaf: &SolidFields) -> (Primitive, DAffine3) {
    match *leaf {
        SolidFields::Sphere { centre, radius, .. } => {
            let outer_from_local =
                DAffine3 { matrix3: DMat3::from_diagonal(DVec3::splat(radius)), translation: centre };
            (Primitive::Sphere, outer_from_local)
        }
        SolidFields::HalfSpace { normal, offset, .. } => (Primitive::HalfSpace { normal, offset }, DAffine3::IDENTITY),
        SolidFields::Box { min, max, .. } => {
            let outer_from_local =
                DAffine3 { matrix3: DMat3::from_diagonal((max - min) / 2.0), translation: (min + max) / 2.0 };
            (Primitive::Cube, outer_from_local)
        }
        SolidFields::Cylinder { from, to, radius, .. } => (Primitive::Cylinder, along(from, to, radius)),
        SolidFields::Cone { from, to, radius, to_radius, .. } => {
            // In the cone's own coordinates the wider end has radius 1.
            let wider = radius.max(to_radius);
            (Primitive::Cone { bottom: radius / wider, top: to_radius / wider }, along(from, to, wider))
        }
        SolidFields::Torus { centre, axis, radius, tube, .. } => {
            let outer_from_local = DAffine3 { matrix3: turn_y_to(axis) * radius, translation: centre };
            (Primitive::Torus { tube: tube / radius }, outer_from_local)
        }
        SolidFields::Quadric { squares, products, linear, constant, .. } => {
            (Primitive::Quadric(QuadricCoefficients { squares, products, linear, constant }), DAffine3::IDENTITY)
        }
        SolidFields::Union { .. }
        | SolidFields::Intersection { .. }
        | SolidFields::Difference { .. }
        | SolidFields::Repeat { .. }
        | SolidFields::Use { .. } => unreachable!("these are no leaves: `solid` handles them"),
    }
}

/// Maps the y axis from −1 to 1 to the line between two points, and radius 1 to `radius`.
fn along(from: DVec3, to: DVec3, radius: f64) -> DAffine3 {
    let half = (to - from) / 2.0;
    let turn = turn_y_to(half.normalize());
    let matrix3 = turn * DMat3::from_diagonal(DVec3::new(radius, half.length(), radius));
    DAffine3 { matrix3, translation: from + half }
}

fn unknown<'k>(what: &'static str, name: &str, known: impl Iterator<Item = &'k String>) -> ResolveError {
    const MAX_SHOWN_NAMES: usize = 12;
    let mut known: Vec<_> = known.map(|name| shown(name)).collect();
    let more = if known.len() > MAX_SHOWN_NAMES { " and others" } else { "" };
    known.truncate(MAX_SHOWN_NAMES);
    let known = if known.is_empty() {
        "no name is defined".into()
    } else {
        format!("the known names are {}{more}", known.join(", "))
    };
    ResolveError::new(Some(name), Problem::UnknownName { what, name: shown(name), known })
}

fn shown(name: &str) -> String {
    const MAX_NAME_CHARS: usize = 40;
    sentence::shown(name, MAX_NAME_CHARS)
}
