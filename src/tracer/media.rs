//! What a ray travels in, where solids that transmit overlap or touch.
//!
//! Where several are at one place, the one that stands first in the scene fills it, and the boundaries of the others are
//! not there (C. M. Schmidt and B. Budge, *Simple Nested Dielectrics in Ray Traced Images*, 2002, whose priorities are the
//! order of the scene here). So glass that overlaps the water in it leaves no gap of air between them.

use std::iter::successors;

/// A solid that transmits, by its root, and its index of refraction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Medium {
    pub root: u32,
    pub ior: f64,
}

/// The solids that a ray is in, as a history of the boundaries that it has passed.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Media<'a>(Option<&'a Passage<'a>>);

/// A boundary that a ray passes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Passage<'a> {
    pub medium: Medium,
    pub enters: bool,
    /// What the ray was in before.
    pub before: Media<'a>,
}

impl<'a> Media<'a> {
    /// Those beyond a passage.
    pub fn beyond(passage: &'a Passage<'a>) -> Self {
        Self(Some(passage))
    }

    /// What fills the place around the boundary of `root`: of all others that the ray is in, the first in the scene.
    pub fn around(self, root: u32) -> Option<Medium> {
        self.iter().filter(|medium| medium.root != root).min_by_key(|medium| medium.root)
    }

    /// All that the ray is in.
    pub fn iter(self) -> impl Iterator<Item = Medium> {
        let passages = move || successors(self.0, |passage| passage.before.0);
        // What was passed last decides.
        let is_old = move |index: usize, root: u32| passages().take(index).any(|newer| newer.medium.root == root);
        let entered = passages().enumerate().filter(|(_, passage)| passage.enters);
        entered
            .map(|(index, passage)| (index, passage.medium))
            .filter_map(move |(index, medium)| (!is_old(index, medium.root)).then_some(medium))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_in_the_scene_fills_a_place() {
        let medium = |root| Medium { root, ior: 1.0 + f64::from(root) };
        let pass = |medium, enters, before| Passage { medium, enters, before };
        let seven = pass(medium(7), true, Media::default());
        let start = Media::beyond(&seven);
        assert_eq!((start.around(3), start.around(7)), (Some(medium(7)), None));
        let three = pass(medium(3), true, start);
        let five = pass(medium(5), true, Media::beyond(&three));
        let inside = Media::beyond(&five);
        assert_eq!([3, 5, 9].map(|root| inside.around(root)), [5, 3, 3].map(|root| Some(medium(root))));
        let left = pass(medium(3), false, inside);
        let out = pass(medium(7), false, Media::beyond(&left));
        let roots: Vec<u32> = Media::beyond(&out).iter().map(|medium| medium.root).collect();
        assert_eq!(roots, [5]);
        let again = pass(medium(3), true, Media::beyond(&out));
        assert_eq!(Media::beyond(&again).around(5), Some(medium(3)));
    }
}
