//! Primary rays, from the eye through a point of the image plane (§3).

use glam::DVec3;

use crate::geometry::Ray;
use crate::picture::Size;
use crate::scene;

#[derive(Debug)]
pub(super) struct RayCamera {
    eye: DVec3,
    /// From the eye to the upper left corner of the image plane.
    corner: DVec3,
    /// From one pixel to the next on the right, and to the next below.
    right: DVec3,
    down: DVec3,
    /// The largest number that the eye's place in the scene is computed from.
    scale: f64,
}

impl RayCamera {
    pub fn new(camera: &scene::Camera, size: Size) -> Self {
        let forward = (camera.look_at - camera.eye).normalize();
        let right = camera.right();
        let up = right.cross(forward);
        let (width, height) = (f64::from(size.width()), f64::from(size.height()));
        // The image plane is at distance 1.
        let plane_height = 2.0 * libm::tan(camera.field_of_view.to_radians() / 2.0);
        let pixel = plane_height / height;
        Self {
            eye: camera.eye,
            corner: forward - right * (pixel * width / 2.0) + up * (plane_height / 2.0),
            right: right * pixel,
            down: -up * pixel,
            scale: camera.scale(),
        }
    }

    /// The ray through a point of a pixel: `[0, 0]` is the pixel's upper left corner, `[1, 1]` its lower right one.
    pub fn ray(&self, x: u32, y: u32, [u, v]: [f64; 2]) -> Ray {
        let (across, along) = (self.right * (f64::from(x) + u), self.down * (f64::from(y) + v));
        let mut ray = Ray::new(self.eye, (self.corner + across + along).normalize());
        ray.scale = self.scale;
        ray
    }
}
