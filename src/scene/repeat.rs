//! The maps of repeated solids: the step applied 0, 1, 2 … times.
//!
//! A product of many maps would carry the rounding of each into all that follow: after three turns by 30° a face would
//! no longer be exactly at a right angle. So a map is computed from the number of its copy where that is possible: a
//! shift is multiplied, and turns about one axis are one turn by a multiple of the angle, which is exact at right
//! angles. Only the shifts between turns are added up. Steps that scale, or that turn about several axes, are
//! multiplied one by one; their relative error grows by about 10⁻¹⁶ a copy.

use glam::{DAffine3, DVec3};

use super::syntax::Transform;
use crate::geometry::rotation;

/// The step from one copy of a solid to the next.
pub(super) enum Step {
    /// A shift.
    Shift(DVec3),
    /// Turns by `degrees` about one axis of coordinates, with shifts: x ↦ R x + `shift`.
    Turn { degrees: DVec3, shift: DVec3 },
    /// Any other map.
    Other(DAffine3),
}

impl Step {
    pub fn new(step: &[Transform]) -> Self {
        let map = Transform::map_of(step);
        let mut degrees = DVec3::ZERO;
        for part in step {
            match *part {
                Transform::Translate(_) => {}
                Transform::Rotate(by) => degrees += by,
                Transform::Scale(_) => return Self::Other(map),
            }
        }
        let turns = step.iter().filter_map(|part| if let Transform::Rotate(by) = part { Some(*by) } else { None });
        let mut axes = [false; 3];
        turns.for_each(|by| (0..3).for_each(|axis| axes[axis] |= by[axis] != 0.0));
        match axes.iter().filter(|&&turns| turns).count() {
            0 => Self::Shift(map.translation),
            1 => Self::Turn { degrees, shift: map.translation },
            _ => Self::Other(map),
        }
    }

    /// The maps of the copies, without end.
    pub fn maps(self) -> impl Iterator<Item = DAffine3> {
        let mut last = DAffine3::IDENTITY;
        (0_u32..).map(move |copy| {
            let number = f64::from(copy);
            let map = match self {
                Self::Shift(shift) => DAffine3::from_translation(shift * number),
                Self::Turn { degrees, .. } => {
                    DAffine3 { matrix3: rotation(degrees * number), translation: last.translation }
                }
                Self::Other(_) => last,
            };
            last = match self {
                Self::Shift(_) => map,
                Self::Turn { shift, .. } => DAffine3 { translation: map.transform_point3(shift), ..map },
                Self::Other(step) => step * map,
            };
            map
        })
    }
}

impl Transform {
    /// The map of transforms that act one after the other.
    pub fn map_of(transforms: &[Self]) -> DAffine3 {
        transforms.iter().fold(DAffine3::IDENTITY, |before, transform| transform.map() * before)
    }

    fn map(&self) -> DAffine3 {
        match *self {
            Self::Translate(by) => DAffine3::from_translation(by),
            Self::Rotate(degrees) => DAffine3::from_mat3(rotation(degrees)),
            Self::Scale(factors) => DAffine3::from_scale(factors),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn copy(step: &[Transform], number: usize) -> DAffine3 {
        Step::new(step).maps().nth(number).expect("without end")
    }

    #[test]
    fn repeated_turns_are_exact_at_right_angles() {
        let turn = [Transform::Rotate(DVec3::new(0.0, 22.5, 0.0))];
        let quarter = DAffine3::from_mat3(rotation(DVec3::new(0.0, 90.0, 0.0)));
        assert_eq!((copy(&turn, 0), copy(&turn, 4), copy(&turn, 1_604)), (DAffine3::IDENTITY, quarter, quarter));
    }

    #[test]
    fn map_of_a_copy_is_the_step_applied_so_many_times() {
        let shift = || Transform::Translate(DVec3::new(1.0, 0.5, -2.0));
        let turn = |x, y, z| Transform::Rotate(DVec3::new(x, y, z));
        for step in [
            vec![],
            vec![shift()],
            vec![turn(0.0, 0.0, 17.0), shift(), turn(0.0, 0.0, -40.0)],
            vec![turn(10.0, 20.0, 0.0), shift()],
            vec![shift(), Transform::Scale(DVec3::new(0.9, -1.0, 1.1))],
        ] {
            let product = (0..25).fold(DAffine3::IDENTITY, |before, _| Transform::map_of(&step) * before);
            assert!(copy(&step, 25).abs_diff_eq(product, 1e-12), "{product:?}");
        }
    }
}
