//! A cylinder with a bore whose ends coincide with its own: the bore is open, and rays pass through it.

use glam::DVec3;

use crate::geometry::rotation;
use crate::picture::{Difference, Quality, Size, max_channel_difference, srgb8};
use crate::ron_file::FileError;
use crate::scene::{Opened, Scene};
use crate::tracer::{RayKind, Scratch, Tracer};

/// The scene; its rotation makes the two cylinders round differently.
const SCENE: &str = r#"Scene(
    camera: (eye: (1.5, -0.1, 7.8), look_at: (0, 0, 0), field_of_view: 19),
    background: (0.05, 0.35, 0.65),
    ambient: (0.2, 0.2, 0.2),
    lights: [Point(position: (6, 8, 9))],
    materials: {"brass": (colour: (0.72, 0.38, 0.07))},
    objects: [
        Difference(material: "brass", transform: [Rotate((3, 11, 5))], of: [
            Cylinder(from: (0, 0, -1), to: (0, 0, 1), radius: 1),
            Cylinder(from: (0, 0, -1), to: (0, 0, 1), radius: 0.7),
        ]),
    ],
)"#;
const ROTATION_DEGREES: DVec3 = DVec3::new(3.0, 11.0, 5.0);
const BORE_RADIUS: f64 = 0.7;

/// Parses the scene, which has no file.
///
/// # Errors
/// A [`FileError`], if its text is wrong.
pub(super) fn scene() -> Result<Opened, FileError> {
    Opened::from_text("bored-cylinder", SCENE)
}

/// The pixels whose rays pass through the bore without touching anything.
pub(super) struct Bore {
    through: Vec<bool>,
    background: [u8; 3],
}

impl Bore {
    /// Finds the pixels in the scene of [`scene`]: a ray passes if it crosses the planes of both ends within the bore.
    pub fn of(scene: &Scene, size: Size) -> Self {
        let tracer = Tracer::new(scene, size, Quality::default());
        let local_from_scene = rotation(ROTATION_DEGREES).transpose();
        let mut through = Vec::new();
        tracer.paths(0..size.pixels(), &mut Scratch::default(), |path| {
            if path.kind == RayKind::Primary {
                let (origin, direction) = (local_from_scene * path.ray.origin, local_from_scene * path.ray.direction);
                through.push([-1.0, 1.0].into_iter().all(|end| {
                    let crossing = origin + direction * ((end - origin.z) / direction.z);
                    crossing.truncate().length() < BORE_RADIUS
                }));
            }
        });
        Self { through, background: srgb8(scene.background.as_vec3().to_array()) }
    }

    /// Returns the number of these pixels.
    pub fn pixels(&self) -> u32 {
        self.through.iter().filter(|&&through| through).count() as u32
    }

    /// Returns how many of these pixels do not show the background in `picture`.
    pub fn wrong(&self, picture: &[[u8; 3]]) -> u32 {
        let through = self.through.iter().zip(picture).filter(|&(&through, _)| through);
        through.filter(|(_, pixel)| max_channel_difference(**pixel, self.background) > Difference::TOLERANCE).count()
            as u32
    }
}
