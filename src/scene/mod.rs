//! The scene: solids, materials, lights and a camera, read from a scene file.

mod file;
mod media;
mod repeat;
mod resolve;
mod syntax;
mod validate;
mod viewpoint;

pub use file::Opened;
pub use media::{ior, media_of, objects_of_several_media};

use glam::DVec3;
use serde::Deserialize;

use crate::csg::Solid;

/// A scene ready to be compiled: names are resolved, and every number is in its range.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The camera.
    pub camera: Camera,
    /// The colour of rays that hit nothing: red, green and blue in linear light.
    pub background: DVec3,
    /// The article's Ia, the ambient light.
    pub ambient: DVec3,
    /// The light sources.
    pub lights: Vec<Light>,
    /// The materials. The tag of a primitive is an index into this list.
    pub materials: Vec<Material>,
    /// The names of the materials, in the same order. The first is that of solids without a material; its name is
    /// empty.
    pub names: Vec<String>,
    /// The solids of the scene.
    pub solids: Vec<Solid>,
}

/// A pinhole camera. y is up unless `up` says otherwise.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields, try_from = "syntax::CameraFields")]
pub struct Camera {
    /// The position of the camera.
    pub eye: DVec3,
    /// The point at the centre of the picture.
    pub look_at: DVec3,
    /// The direction that is up in the picture, see [`Camera::right`].
    pub up: DVec3,
    /// The vertical field of view in degrees, above 0 and below 180.
    pub field_of_view: f64,
}

/// A light source. Its intensity is the article's Ilj: red, green and blue, which may exceed 1.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum Light {
    /// Shines from a point in all directions; its intensity does not decrease with distance.
    Point {
        /// The position of the light.
        #[serde(deserialize_with = "validate::vector")]
        position: DVec3,
        /// Its intensity.
        #[serde(deserialize_with = "validate::light", default = "white")]
        colour: DVec3,
    },
    /// Shines from infinitely far away, as the sun does.
    Directional {
        /// The direction in which its light travels.
        #[serde(deserialize_with = "validate::direction")]
        direction: DVec3,
        /// Its intensity.
        #[serde(deserialize_with = "validate::light", default = "white")]
        colour: DVec3,
    },
}

/// A material: the coefficients of the article's equation (§3).
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Material {
    /// The colour of ambient and diffuse reflection: red, green and blue, 0 to 1.
    #[serde(deserialize_with = "validate::colour")]
    pub colour: DVec3,
    /// Ambient reflection, 0 to 1.
    #[serde(deserialize_with = "validate::fraction")]
    pub ka: f64,
    /// Diffuse reflection, 0 to 1.
    #[serde(deserialize_with = "validate::fraction")]
    pub kd: f64,
    /// Specular reflection of lights (Phong) and of other solids, 0 to 1.
    #[serde(deserialize_with = "validate::fraction")]
    pub ks: f64,
    /// Transmission, 0 to 1: one number, or red, green and blue for coloured glass.
    #[serde(deserialize_with = "validate::fractions")]
    pub kt: DVec3,
    /// Phong's exponent: the larger it is, the smaller is the highlight.
    #[serde(deserialize_with = "validate::exponent")]
    pub n: f64,
    /// Index of refraction; 1 is air.
    #[serde(deserialize_with = "validate::index_of_refraction")]
    pub ior: f64,
}

impl Default for Material {
    /// Matt white.
    fn default() -> Self {
        Self { colour: DVec3::ONE, ka: 1.0, kd: 0.8, ks: 0.0, kt: DVec3::ZERO, n: 50.0, ior: 1.0 }
    }
}

impl Material {
    /// Whether light passes its surface.
    pub fn transmits(&self) -> bool {
        self.kt.max_element() > 0.0
    }
}

/// Names and texts of the built-in scenes.
pub const BUILT_IN: &[(&str, &str)] = &[
    ("ten-objects", include_str!("../../scenes/ten-objects.ron")),
    ("csg-primer", include_str!("../../scenes/csg-primer.ron")),
    ("glass", include_str!("../../scenes/glass.ron")),
    ("machine-part", include_str!("../../scenes/machine-part.ron")),
    ("corner", include_str!("../../scenes/corner.ron")),
    ("rings", include_str!("../../scenes/rings.ron")),
    ("chessmen", include_str!("../../scenes/chessmen.ron")),
    ("engine", include_str!("../../scenes/engine.ron")),
    ("pits", include_str!("../../scenes/pits.ron")),
    ("sphereflake", include_str!("../../scenes/sphereflake.ron")),
    ("lattice", include_str!("../../scenes/lattice.ron")),
];

/// The built-in scenes of at most a few hundred primitives, for tests and studies that trace every scene many times.
pub const SMALL_BUILT_IN: &[(&str, &str)] = BUILT_IN.split_at(6).0;

/// The text of a built-in scene.
pub fn built_in(name: &str) -> Option<&'static str> {
    BUILT_IN.iter().find(|(known, _)| *known == name).map(|(_, text)| *text)
}

fn white() -> DVec3 {
    DVec3::ONE
}
