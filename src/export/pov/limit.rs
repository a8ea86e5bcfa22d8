//! What POV-Ray shows in another way than this program.

use std::fmt;

use glam::DVec3;

use crate::scene::Material;
use crate::sentence::shown;

/// A cause why POV-Ray's picture of a scene differs from this program's.
#[derive(Clone, Debug, PartialEq)]
pub enum PovLimit {
    /// Two solids that transmit light overlap or touch, or it cannot be proved that they do not; given by their numbers
    /// in the scene, from 1.
    Media([usize; 2]),
    /// The eye is in several solids that transmit light, of which an inner one has no box for POV-Ray: their number.
    EyeInMedia(usize),
    /// Coloured glass that also shows ambient or diffuse light: POV-Ray would colour that, too. The name of the
    /// material.
    ColouredKt(String),
    /// A surface that absorbs light: POV-Ray's absorbs none under total internal reflection.
    TotalReflection {
        /// The name of the material.
        material: String,
        /// Ks + Kt.
        reflected: f64,
    },
}

impl fmt::Display for PovLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Media([first, second]) => {
                if first == second {
                    write!(f, "two parts of object {first} transmit light")?;
                } else {
                    write!(f, "objects {first} and {second} transmit light")?;
                }
                f.write_str(
                    " and may overlap or touch, where POV-Ray refracts light at the boundaries of both; leave a gap \
                     between them, or put one into the other",
                )
            }
            Self::EyeInMedia(media) => write!(
                f,
                "the eye is in {media} solids that transmit light, and POV-Ray may take another for the innermost one; \
                 move the eye out of them"
            ),
            Self::ColouredKt(material) => write!(
                f,
                "`{material}` has a coloured Kt beside Ka or Kd, which POV-Ray would colour, too, so that its Kt is \
                 grey there; make Ka and Kd 0"
            ),
            Self::TotalReflection { material, reflected } => write!(
                f,
                "under total internal reflection `{material}` reflects Ks + Kt = {reflected} of the light, but \
                 POV-Ray reflects all of it; make Ks + Kt = 1"
            ),
        }
    }
}

/// Returns what POV-Ray cannot show of a material.
pub(super) fn material_limits(name: &str, material: &Material) -> Vec<PovLimit> {
    const MAX_NAME_CHARS: usize = 40;
    const ROUNDING: f64 = 1e-9;
    let Material { ka, kd, ks, kt, ior, .. } = *material;
    let mut limits = Vec::new();
    if is_coloured(kt) && ka + kd > 0.0 {
        limits.push(PovLimit::ColouredKt(shown(name, MAX_NAME_CHARS)));
    }
    let reflected = ks + kt.min_element();
    if material.transmits() && ior != 1.0 && (reflected - 1.0).abs() > ROUNDING {
        limits.push(PovLimit::TotalReflection { material: shown(name, MAX_NAME_CHARS), reflected });
    }
    limits
}

/// Whether Kt differs for red, green and blue.
pub(super) fn is_coloured(kt: DVec3) -> bool {
    kt != DVec3::splat(kt.x)
}
