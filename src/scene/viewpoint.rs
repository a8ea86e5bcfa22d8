//! Camera moves, and scene texts with a new camera.

use glam::{DQuat, DVec3};

use super::{Camera, Opened};
use crate::ron_file::comment_or_string_length;

/// The smallest angle between the line of sight and straight up or straight down. It cannot be seen; it keeps the
/// direction from which the camera came, which is the top of the picture.
const MIN_POLE_ANGLE_DEGREES: f64 = 1e-4;

impl Camera {
    /// The direction to the right in the picture, of length 1: square to the line of sight and to `up`.
    ///
    /// A camera that looks along `up` or against it has the top of its picture where it would be if it had looked along
    /// −z and had then been tilted: −z looking down, z looking up (if z is up, it had looked along y).
    pub fn right(&self) -> DVec3 {
        const MIN_SINE: f64 = 1e-9;
        let (sight, up) = ((self.look_at - self.eye).normalize(), self.up.normalize());
        let right = sight.cross(up);
        if right.length() >= MIN_SINE {
            return right.normalize();
        }
        let ahead = if up.z.abs() < 0.9 { DVec3::NEG_Z } else { DVec3::Y };
        ahead.cross(up).normalize()
    }

    /// The largest coordinate of the eye and the point that it looks at. Rounding errors near the eye are relative to
    /// it, even if the eye lies at the origin.
    pub fn scale(&self) -> f64 {
        self.eye.abs().max(self.look_at.abs()).max_element()
    }

    /// Rotates the camera around the point that it looks at, by angles in degrees: to the right, and up.
    pub fn orbit(&self, right: f64, up: f64) -> Self {
        let axis = self.up.normalize();
        let away = self.eye - self.look_at;
        let height = axis.angle_between(away).to_degrees();
        // Upwards the angle to the pole decreases.
        let new_height = (height - up).clamp(MIN_POLE_ANGLE_DEGREES, 180.0 - MIN_POLE_ANGLE_DEGREES);
        let turned = DQuat::from_axis_angle(self.right(), (new_height - height).to_radians()) * away;
        let turned = DQuat::from_axis_angle(axis, right.to_radians()) * turned;
        Self { eye: self.look_at + turned, ..*self }
    }

    /// Moves the camera to the right and up without turning it. The unit is the height of the picture at the distance
    /// of the point that it looks at.
    pub fn pan(&self, right: f64, up: f64) -> Self {
        let sight = self.look_at - self.eye;
        let right_direction = self.right();
        let upwards = right_direction.cross(sight).normalize();
        let height = 2.0 * sight.length() * libm::tan(self.field_of_view.to_radians() / 2.0);
        let by = (right_direction * right + upwards * up) * height;
        Self { eye: self.eye + by, look_at: self.look_at + by, ..*self }
    }

    /// Moves the camera towards the point that it looks at (`factor` below 1) or away from it.
    pub fn dolly(&self, factor: f64) -> Self {
        Self { eye: self.look_at + (self.eye - self.look_at) * factor, ..*self }
    }
}

impl Opened {
    /// The same scene with another camera and the same home, and with a text that states this camera; `None` if the
    /// text cannot be changed.
    pub fn with_camera(&self, camera: Camera) -> Option<Self> {
        let range = camera_range(&self.text)?;
        let vector = |DVec3 { x, y, z }: DVec3| format!("({x:?}, {y:?}, {z:?})");
        let camera_text = format!(
            "(eye: {}, look_at: {}, up: {}, field_of_view: {:?})",
            vector(camera.eye),
            vector(camera.look_at),
            vector(camera.up),
            camera.field_of_view
        );
        let text = format!("{}{camera_text}{}", &self.text[..range.start], &self.text[range.end..]);
        let opened = Self::from_text(&self.name, &text).ok()?;
        let read = &opened.scene.camera;
        let is_exact =
            read.eye == camera.eye && read.look_at == camera.look_at && read.field_of_view == camera.field_of_view;
        is_exact.then(|| Self { path: self.path.clone(), home_camera: self.home_camera, ..opened })
    }
}

/// The byte range of the camera's fields in a scene's text, brackets included.
fn camera_range(text: &str) -> Option<std::ops::Range<usize>> {
    let bytes = text.as_bytes();
    let (mut at, mut depth, mut start) = (0, 0_i32, None);
    while at < bytes.len() {
        let rest = &text[at..];
        if let Some(length) = comment_or_string_length(rest) {
            at += length;
            continue;
        }
        match bytes[at] {
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' => {
                depth -= 1;
                if let Some(start) = start
                    && depth == 1
                {
                    return Some(start..at + 1);
                }
            }
            b'c' if depth == 1 && start.is_none() && camera_begins(text, at) => {
                at += rest.find('(')?;
                (start, depth) = (Some(at), depth + 1);
            }
            _ => {}
        }
        at += rest.chars().next().map_or(1, char::len_utf8);
    }
    None
}

/// Whether the field `camera` begins here.
fn camera_begins(text: &str, at: usize) -> bool {
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    let before = text[..at].chars().next_back().is_some_and(is_word);
    let after = text[at..].strip_prefix("camera").is_some_and(|rest| rest.trim_start().starts_with(':'));
    !before && after
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::BUILT_IN;
    use super::*;

    fn opened(name: &str) -> Opened {
        Opened::new(name).unwrap()
    }

    proptest! {
        #[test]
        fn orbit_keeps_distance_and_is_invertible(right in -180.0..180.0f64, up in -20.0..20.0f64) {
            let camera = opened("ten-objects").scene.camera;
            let turned = camera.orbit(right, up);
            let distance = |camera: &Camera| (camera.eye - camera.look_at).length();
            prop_assert!((distance(&turned) - distance(&camera)).abs() < 1e-9);
            let back = turned.orbit(0.0, -up).orbit(-right, 0.0);
            prop_assert!((back.eye - camera.eye).length() < 1e-9, "{:?}", back.eye);
        }

        #[test]
        fn orbit_never_crosses_pole(ways in prop::collection::vec((-200.0..200.0f64, -200.0..200.0f64), 1..20)) {
            let mut camera = opened("corner").scene.camera;
            for (right, up) in ways {
                camera = camera.orbit(right, up);
                let angle = camera.up.angle_between(camera.eye - camera.look_at).to_degrees();
                let least = MIN_POLE_ANGLE_DEGREES - 1e-6;
                prop_assert!((least..=180.0 - least).contains(&angle), "{angle}");
            }
        }

        #[test]
        fn with_camera_changes_every_built_in_scene(
            scene in 0..BUILT_IN.len(), right in -90.0..90.0f64, up in -30.0..30.0f64, factor in 0.3..3.0f64,
            by in -1.0..1.0f64,
        ) {
            let opened = opened(BUILT_IN[scene].0);
            let camera = opened.scene.camera.orbit(right, up).dolly(factor).pan(by, -by);
            let moved = opened.with_camera(camera).unwrap();
            prop_assert_eq!(moved.scene.camera.eye, camera.eye);
            prop_assert_eq!(moved.home_camera.eye, opened.scene.camera.eye);
            prop_assert_eq!(moved.scene.solids.len(), opened.scene.solids.len());
            // The text can be changed again.
            prop_assert!(moved.with_camera(opened.scene.camera).is_some());
        }
    }

    #[test]
    fn pan_of_1_moves_by_height_of_picture() {
        let camera = opened("ten-objects").scene.camera;
        let moved = camera.pan(0.0, 1.0);
        let half = (camera.field_of_view.to_radians() / 2.0).tan();
        let sight = camera.look_at - camera.eye;
        assert!(((moved.eye - camera.eye).length() - 2.0 * half * sight.length()).abs() < 1e-9);
        assert!((moved.look_at - moved.eye).dot(moved.eye - camera.eye).abs() < 1e-9);
    }

    #[test]
    fn camera_in_comments_and_strings_is_ignored() {
        let text = "// camera: (no)\nScene(/* camera: ( */ materials: {\"camera: (\": (ka: 0)}, solids: {\"(\": Sphere(radius: 1)},\n\
                    camera : Camera(eye: (0, 1, 5), look_at: (0, 0, 0)), objects: [Use(solid: \"(\")])";
        let opened = Opened::from_text("tricky", text).unwrap();
        let camera = opened.scene.camera.dolly(2.0);
        let moved = opened.with_camera(camera).unwrap();
        assert_eq!(moved.scene.camera.eye, DVec3::new(0.0, 2.0, 10.0));
        assert!(moved.text.starts_with("// camera: (no)\nScene(/* camera: ( */ materials: {\"camera: (\""));
    }
}
