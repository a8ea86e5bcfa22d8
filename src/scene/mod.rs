//! What is drawn: solids, materials, lights and a camera, read from a scene file.

mod file;
mod resolve;
mod syntax;
mod validate;
mod viewpoint;

pub use file::Opened;

use glam::DVec3;
use serde::Deserialize;

use crate::csg::Solid;

/// A scene, ready to be compiled: names are resolved and every number is in its range.
#[derive(Clone, Debug)]
pub struct Scene {
    /// Who looks.
    pub camera: Camera,
    /// What is seen where no solid is; red, green and blue in linear light.
    pub background: DVec3,
    /// The article's Ia, the light that is everywhere.
    pub ambient: DVec3,
    /// The article's sources of light.
    pub lights: Vec<Light>,
    /// The materials; the tag of a primitive is a place in this list.
    pub materials: Vec<Material>,
    /// What the materials are called, in their order. The first is that of solids without one and has no name.
    pub names: Vec<String>,
    /// The solids that stand in the scene.
    pub solids: Vec<Solid>,
}

/// Who looks, from where to where; y is up unless `up` says otherwise.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields, try_from = "syntax::CameraFields")]
pub struct Camera {
    /// Where the camera is.
    pub eye: DVec3,
    /// The point in the middle of the picture.
    pub look_at: DVec3,
    /// Which way is up in the picture; not along the line of sight.
    pub up: DVec3,
    /// The vertical angle of view, in degrees, above 0 and below 180.
    pub field_of_view: f64,
}

/// A source of light. Its intensity is Ilj in the article: red, green and blue, which may exceed 1.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Light {
    /// Shines from a point in all directions; distance does not weaken it.
    Point {
        /// Where it is.
        #[serde(deserialize_with = "validate::vector")]
        position: DVec3,
        /// Its intensity.
        #[serde(deserialize_with = "validate::light", default = "white")]
        colour: DVec3,
    },
    /// Shines from infinitely far, as the sun does.
    Directional {
        /// Where its light goes.
        #[serde(deserialize_with = "validate::direction")]
        direction: DVec3,
        /// Its intensity.
        #[serde(deserialize_with = "validate::light", default = "white")]
        colour: DVec3,
    },
}

/// What a surface makes of light: the coefficients of the article's equation (§3).
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Material {
    /// What it reflects of ambient and diffuse light: red, green and blue, 0 to 1.
    #[serde(deserialize_with = "validate::colour")]
    pub colour: DVec3,
    /// Ambient reflection, 0 to 1.
    #[serde(deserialize_with = "validate::fraction")]
    pub ka: f64,
    /// Diffuse reflection, 0 to 1.
    #[serde(deserialize_with = "validate::fraction")]
    pub kd: f64,
    /// Specular reflection, of lights (Phong) and of other solids, 0 to 1.
    #[serde(deserialize_with = "validate::fraction")]
    pub ks: f64,
    /// Transmission, 0 to 1.
    #[serde(deserialize_with = "validate::fraction")]
    pub kt: f64,
    /// Phong's exponent: the larger, the smaller the highlight.
    #[serde(deserialize_with = "validate::exponent")]
    pub n: f64,
    /// Index of refraction; that of air is 1.
    #[serde(deserialize_with = "validate::index_of_refraction")]
    pub ior: f64,
}

impl Default for Material {
    /// Matt white.
    fn default() -> Self {
        Self { colour: DVec3::ONE, ka: 1.0, kd: 0.8, ks: 0.0, kt: 0.0, n: 50.0, ior: 1.0 }
    }
}

/// The scenes that are built into the program: their names and texts.
pub const BUILT_IN: &[(&str, &str)] = &[
    ("ten-objects", include_str!("../../scenes/ten-objects.ron")),
    ("csg-primer", include_str!("../../scenes/csg-primer.ron")),
    ("glass", include_str!("../../scenes/glass.ron")),
    ("machine-part", include_str!("../../scenes/machine-part.ron")),
    ("corner", include_str!("../../scenes/corner.ron")),
    ("rings", include_str!("../../scenes/rings.ron")),
];

/// The text of a built-in scene.
pub fn built_in(name: &str) -> Option<&'static str> {
    BUILT_IN.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

fn white() -> DVec3 {
    DVec3::ONE
}
