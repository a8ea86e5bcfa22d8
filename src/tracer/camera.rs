//! Primary rays: from the eye through a point of the picture's plane (§3).

use glam::DVec3;

use crate::geometry::Ray;
use crate::picture::Size;
use crate::scene;

#[derive(Debug)]
pub(super) struct Camera {
    eye: DVec3,
    /// From the eye to the upper left corner of the picture's plane.
    corner: DVec3,
    /// From one pixel to the next on its right, and to the next below.
    right: DVec3,
    down: DVec3,
    /// Samples a pixel are n × n.
    n: u32,
}

impl Camera {
    pub fn new(camera: &scene::Camera, size: Size, n: u32) -> Self {
        let forward = (camera.look_at - camera.eye).normalize();
        let right = forward.cross(camera.up).normalize();
        let up = right.cross(forward);
        let (width, height) = (f64::from(size.width()), f64::from(size.height()));
        // The plane is at distance 1.
        let plane_height = 2.0 * (camera.field_of_view.to_radians() / 2.0).tan();
        let pixel = plane_height / height;
        Self {
            eye: camera.eye,
            corner: forward - right * (pixel * width / 2.0) + up * (plane_height / 2.0),
            right: right * pixel,
            down: -up * pixel,
            n,
        }
    }

    /// One ray through the middle of each of the n × n equal parts of a pixel.
    pub fn rays(&self, x: u32, y: u32) -> impl Iterator<Item = Ray> {
        let step = 1.0 / f64::from(self.n);
        (0..self.n * self.n).map(move |sample| {
            let part = |index: u32| (f64::from(index) + 0.5) * step;
            let across = self.right * (f64::from(x) + part(sample % self.n));
            let along = self.down * (f64::from(y) + part(sample / self.n));
            Ray::new(self.eye, (self.corner + across + along).normalize())
        })
    }

    pub fn rays_a_pixel(&self) -> f64 {
        f64::from(self.n * self.n)
    }
}
