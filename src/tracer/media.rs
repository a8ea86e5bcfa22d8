//! The media that a ray travels in, where transmitting solids overlap or touch.
//!
//! Where several solids overlap, the first in the scene fills the space, and the boundaries of the others do not exist
//! there (C. M. Schmidt and B. Budge, *Simple Nested Dielectrics in Ray Traced Images*, 2002; priority is scene order
//! here). So glass that overlaps the water in it leaves no gap of air between them.

use crate::csg::RootId;

/// A transmitting solid: its root and its index of refraction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Medium {
    pub root: RootId,
    pub ior: f64,
}

/// The set of media that a ray is in, stored in [`MediaSets`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Media {
    start: usize,
    end: usize,
}

/// All sets of media of a sample's rays.
#[derive(Debug, Default)]
pub(super) struct MediaSets {
    all: Vec<Medium>,
    sets: Vec<Media>,
}

impl MediaSets {
    /// Removes all sets, and starts with the media that the eye is in.
    pub fn restart(&mut self, eye: &[Medium]) -> Media {
        self.all.clear();
        self.sets.clear();
        self.all.extend_from_slice(eye);
        let media = Media { start: 0, end: eye.len() };
        self.sets.push(media);
        media
    }

    /// The media of a set.
    pub fn get(&self, media: Media) -> &[Medium] {
        &self.all[media.start..media.end]
    }

    /// The medium on the outer side of the boundary of `root`: the first in the scene of all others that the ray is in.
    pub fn surrounding(&self, media: Media, root: RootId) -> Option<Medium> {
        self.get(media).iter().filter(|medium| medium.root != root).min_by_key(|medium| medium.root).copied()
    }

    /// The media that a ray is in after it has entered or left `medium`.
    pub fn after_crossing(&mut self, media: Media, medium: Medium, enters: bool) -> Media {
        let start = self.all.len();
        for index in media.start..media.end {
            if self.all[index].root != medium.root {
                self.all.push(self.all[index]);
            }
        }
        if enters {
            self.all.push(medium);
        }
        self.intern(start)
    }

    /// Makes the media from `start` on a set, or returns an equal one among the most recent sets. So a ray that enters
    /// and leaves the same solids any number of times takes no memory.
    fn intern(&mut self, start: usize) -> Media {
        const RECENT_SETS: usize = 16;
        let new = Media { start, end: self.all.len() };
        let known = self.sets.iter().rev().take(RECENT_SETS).find(|known| self.get(**known) == self.get(new));
        match known.copied() {
            Some(known) => {
                self.all.truncate(start);
                known
            }
            None => {
                self.sets.push(new);
                new
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn medium(root: u32) -> Medium {
        Medium { root: RootId(root), ior: 1.0 + f64::from(root) }
    }

    #[test]
    fn first_medium_in_scene_fills_overlap() {
        let mut sets = MediaSets::default();
        let start = sets.restart(&[medium(7)]);
        let around = |sets: &MediaSets, media, root| sets.surrounding(media, RootId(root));
        assert_eq!((around(&sets, start, 3), around(&sets, start, 7)), (Some(medium(7)), None));
        let three = sets.after_crossing(start, medium(3), true);
        let inside = sets.after_crossing(three, medium(5), true);
        assert_eq!([3, 5, 9].map(|root| around(&sets, inside, root)), [5, 3, 3].map(|root| Some(medium(root))));
        assert_eq!(sets.get(start), [medium(7)]);
        assert_eq!(sets.get(three), [medium(7), medium(3)]);
    }

    #[test]
    fn repeated_sets_take_no_memory() {
        let mut sets = MediaSets::default();
        let start = sets.restart(&[medium(0)]);
        let mut media = start;
        for root in 0..1000 {
            media = sets.after_crossing(media, medium(1 + root % 3), true);
            media = sets.after_crossing(media, medium(1 + root % 3), false);
            assert_eq!(media, start);
        }
        assert_eq!(sets.all.len(), 1 + 3 * 2);
        media = sets.after_crossing(media, medium(0), false);
        assert_eq!((sets.get(media), sets.get(start)), (&[][..], &[medium(0)][..]));
    }
}
