//! What a ray travels in, where solids that transmit overlap or touch.
//!
//! Where several are at one place, the one that stands first in the scene fills it, and the boundaries of the others are
//! not there (C. M. Schmidt and B. Budge, *Simple Nested Dielectrics in Ray Traced Images*, 2002, whose priorities are the
//! order of the scene here). So glass that overlaps the water in it leaves no gap of air between them.

use std::ops::Range;

/// A solid that transmits, by its root, and its index of refraction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Medium {
    pub root: u32,
    pub ior: f64,
}

/// All that a ray is in: a part of the [`MediaStack`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Media {
    start: usize,
    end: usize,
}

/// The media of every ray of a sample.
#[derive(Debug, Default)]
pub(super) struct MediaStack(Vec<Medium>);

impl MediaStack {
    /// Begins with what the eye is in.
    pub fn restart(&mut self, eye: &[Medium]) -> Media {
        self.0.clear();
        self.0.extend_from_slice(eye);
        Media { start: 0, end: self.0.len() }
    }

    /// How high it is.
    pub fn height(&self) -> usize {
        self.0.len()
    }

    /// All that a ray is in.
    pub fn get(&self, media: Media) -> &[Medium] {
        &self.0[Range::from(media)]
    }

    /// What fills the place around the boundary of `root`: of all others that the ray is in, the first in the scene.
    pub fn around(&self, media: Media, root: u32) -> Option<Medium> {
        self.get(media).iter().filter(|medium| medium.root != root).min_by_key(|medium| medium.root).copied()
    }

    /// What a ray is in after it has entered or left `medium`. It begins at `height`: if `media` already do, they make way.
    pub fn beyond(&mut self, height: usize, media: Media, medium: Medium, enters: bool) -> Media {
        if media.start < height {
            self.0.truncate(height);
            self.0.extend_from_within(Range::from(media));
        }
        let others = self.0[height..].iter().position(|other| other.root == medium.root);
        if let Some(place) = others {
            self.0.remove(height + place);
        }
        if enters {
            self.0.push(medium);
        }
        Media { start: height, end: self.0.len() }
    }
}

impl From<Media> for Range<usize> {
    fn from(Media { start, end }: Media) -> Self {
        start..end
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn medium(root: u32) -> Medium {
        Medium { root, ior: 1.0 + f64::from(root) }
    }

    #[test]
    fn the_first_in_the_scene_fills_a_place() {
        let mut stack = MediaStack::default();
        let start = stack.restart(&[medium(7)]);
        assert_eq!((stack.around(start, 3), stack.around(start, 7)), (Some(medium(7)), None));
        let three = stack.beyond(stack.height(), start, medium(3), true);
        let inside = stack.beyond(stack.height(), three, medium(5), true);
        assert_eq!([3, 5, 9].map(|root| stack.around(inside, root)), [5, 3, 3].map(|root| Some(medium(root))));
        assert_eq!(stack.get(start), [medium(7)]);
        assert_eq!(stack.get(three), [medium(7), medium(3)], "what starts later leaves the others as they are");
    }

    #[test]
    fn a_ray_that_goes_on_and_on_keeps_one_set() {
        let mut stack = MediaStack::default();
        let start = stack.restart(&[medium(0)]);
        let height = stack.height();
        let mut media = start;
        for root in 1..100 {
            media = stack.beyond(height, media, medium(root), true);
            media = stack.beyond(height, media, medium(root), false);
        }
        assert_eq!((stack.get(media), stack.height()), (&[medium(0)][..], 2));
        media = stack.beyond(height, media, medium(0), false);
        assert_eq!((stack.get(media), stack.get(start)), (&[][..], &[medium(0)][..]));
    }
}
