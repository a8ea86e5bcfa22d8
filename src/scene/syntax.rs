//! The grammar of a scene file, as serde reads it.

use std::collections::BTreeMap;
use std::fmt;

use glam::DVec3;
use serde::de::{self, Deserialize, Deserializer, MapAccess, Visitor};
use thiserror::Error;

use super::{Camera, Light, Material, validate};

/// A scene file as written.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, rename = "Scene")]
pub(super) struct SceneFile {
    pub camera: Camera,
    #[serde(default, deserialize_with = "validate::light")]
    pub background: DVec3,
    #[serde(default, deserialize_with = "validate::light")]
    pub ambient: DVec3,
    #[serde(default)]
    pub lights: Vec<Light>,
    #[serde(default)]
    pub materials: UniqueNames<Material>,
    #[serde(default)]
    pub solids: UniqueNames<SolidFields>,
    pub objects: Vec<SolidFields>,
}

/// A map from names in which no name may occur twice.
pub(super) struct UniqueNames<T>(pub BTreeMap<String, T>);

impl<T> Default for UniqueNames<T> {
    fn default() -> Self {
        Self(BTreeMap::new())
    }
}

/// A solid as written. Its parts have its material unless they have their own. Transforms act in the order written.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, remote = "Self", rename = "Solid")]
pub(super) enum SolidFields {
    Sphere {
        #[serde(default, deserialize_with = "validate::vector")]
        centre: DVec3,
        #[serde(deserialize_with = "validate::positive")]
        radius: f64,
        material: Option<String>,
        #[serde(default)]
        transform: Vec<Transform>,
    },
    HalfSpace {
        #[serde(deserialize_with = "validate::direction")]
        normal: DVec3,
        #[serde(default, deserialize_with = "validate::number")]
        offset: f64,
        material: Option<String>,
        #[serde(default)]
        transform: Vec<Transform>,
    },
    Box {
        #[serde(deserialize_with = "validate::vector")]
        min: DVec3,
        #[serde(deserialize_with = "validate::vector")]
        max: DVec3,
        material: Option<String>,
        #[serde(default)]
        transform: Vec<Transform>,
    },
    Cylinder {
        #[serde(deserialize_with = "validate::vector")]
        from: DVec3,
        #[serde(deserialize_with = "validate::vector")]
        to: DVec3,
        #[serde(deserialize_with = "validate::positive")]
        radius: f64,
        material: Option<String>,
        #[serde(default)]
        transform: Vec<Transform>,
    },
    Cone {
        #[serde(deserialize_with = "validate::vector")]
        from: DVec3,
        #[serde(deserialize_with = "validate::vector")]
        to: DVec3,
        #[serde(deserialize_with = "validate::base_radius")]
        radius: f64,
        /// The radius at `to`: 0 for a whole cone, more for a truncated one.
        #[serde(default, deserialize_with = "validate::number")]
        to_radius: f64,
        material: Option<String>,
        #[serde(default)]
        transform: Vec<Transform>,
    },
    Torus {
        #[serde(default, deserialize_with = "validate::vector")]
        centre: DVec3,
        /// The axis of rotation.
        #[serde(default = "upwards", deserialize_with = "validate::direction")]
        axis: DVec3,
        /// The radius of the circle at the centre of the tube.
        #[serde(deserialize_with = "validate::positive")]
        radius: f64,
        /// The radius of the tube.
        #[serde(deserialize_with = "validate::positive")]
        tube: f64,
        material: Option<String>,
        #[serde(default)]
        transform: Vec<Transform>,
    },
    Quadric {
        #[serde(default, deserialize_with = "validate::vector")]
        squares: DVec3,
        #[serde(default, deserialize_with = "validate::vector")]
        products: DVec3,
        #[serde(default, deserialize_with = "validate::vector")]
        linear: DVec3,
        #[serde(default, deserialize_with = "validate::number")]
        constant: f64,
        material: Option<String>,
        #[serde(default)]
        transform: Vec<Transform>,
    },
    Union {
        of: Vec<SolidFields>,
        material: Option<String>,
        #[serde(default)]
        transform: Vec<Transform>,
    },
    Intersection {
        of: Vec<SolidFields>,
        material: Option<String>,
        #[serde(default)]
        transform: Vec<Transform>,
    },
    Difference {
        of: Vec<SolidFields>,
        material: Option<String>,
        #[serde(default)]
        transform: Vec<Transform>,
    },
    /// Copies of a solid: the first as it is, each other one `step` further than the one before.
    Repeat {
        #[serde(deserialize_with = "validate::count")]
        count: usize,
        step: Vec<Transform>,
        of: Box<SolidFields>,
        material: Option<String>,
        #[serde(default)]
        transform: Vec<Transform>,
    },
    Use {
        solid: String,
        material: Option<String>,
        #[serde(default)]
        transform: Vec<Transform>,
    },
}

/// A step of a solid's transform.
#[derive(serde::Deserialize)]
pub(super) enum Transform {
    Translate(#[serde(deserialize_with = "validate::vector")] DVec3),
    /// By degrees about x, then y, then z.
    Rotate(#[serde(deserialize_with = "validate::vector")] DVec3),
    Scale(#[serde(deserialize_with = "validate::factors")] DVec3),
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields, rename = "Camera")]
pub(super) struct CameraFields {
    #[serde(deserialize_with = "validate::vector")]
    eye: DVec3,
    #[serde(deserialize_with = "validate::vector")]
    look_at: DVec3,
    #[serde(default = "upwards", deserialize_with = "validate::direction")]
    up: DVec3,
    #[serde(default = "usual_angle", deserialize_with = "validate::angle_of_view")]
    field_of_view: f64,
}

/// Why a camera has no line of sight.
#[derive(Debug, Error)]
pub(super) enum CameraError {
    #[error("eye and look_at must be different points")]
    NoDirection,
}

impl TryFrom<CameraFields> for Camera {
    type Error = CameraError;

    fn try_from(fields: CameraFields) -> Result<Self, Self::Error> {
        let CameraFields { eye, look_at, up, field_of_view } = fields;
        let sight = (look_at - eye).normalize_or_zero();
        if sight == DVec3::ZERO {
            return Err(CameraError::NoDirection);
        }
        Ok(Self { eye, look_at, up, field_of_view })
    }
}

impl<'de> Deserialize<'de> for SolidFields {
    /// Checks conditions between fields here, where the parser still knows the position in the file.
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let solid = Self::deserialize(from)?;
        let wrong = match &solid {
            Self::Box { min, max, .. } if !min.cmplt(*max).all() => "min must be below max in x, y and z",
            Self::Cylinder { from, to, .. } | Self::Cone { from, to, .. } if (*to - *from).length() < 1e-12 => {
                "from and to must be different points"
            }
            Self::Cone { to_radius, .. } if *to_radius < 0.0 => "to_radius must not be negative",
            Self::Torus { radius, tube, .. } if tube >= radius => "tube must be less than radius",
            Self::Quadric { squares, products, linear, .. }
                if [squares, products, linear].iter().all(|&&v| v == DVec3::ZERO) =>
            {
                "squares, products and linear must not all be 0"
            }
            Self::Union { of, .. } | Self::Intersection { of, .. } | Self::Difference { of, .. } if of.is_empty() => {
                "of must name at least one solid"
            }
            _ => return Ok(solid),
        };
        Err(de::Error::custom(wrong))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for UniqueNames<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Entries<T>(std::marker::PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Entries<T> {
            type Value = UniqueNames<T>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a map from names")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<UniqueNames<T>, A::Error> {
                let mut named = BTreeMap::new();
                while let Some(name) = entries.next_key::<String>()? {
                    if named.contains_key(&name) {
                        return Err(de::Error::custom(format_args!("`{name}` is defined twice")));
                    }
                    named.insert(name, entries.next_value()?);
                }
                Ok(UniqueNames(named))
            }
        }
        from.deserialize_map(Entries(std::marker::PhantomData))
    }
}

fn upwards() -> DVec3 {
    DVec3::Y
}

fn usual_angle() -> f64 {
    40.0
}
