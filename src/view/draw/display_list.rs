//! Display lists: marks to be drawn, for the window, SVG and films.

use crate::balance::NodeId;
use crate::palette::Rgb;

/// A point of a drawing: x to the right, y down, in the units of the size that the list was made for.
pub type Point = [f32; 2];

/// One thing to be drawn. Later marks lie on top.
#[derive(Clone, Debug, PartialEq)]
pub enum Mark {
    /// A filled circle.
    Disc {
        /// The centre.
        centre: Point,
        /// The radius.
        radius: f32,
        /// The colour.
        ink: Ink,
    },
    /// A filled box with round corners.
    Box {
        /// The centre.
        centre: Point,
        /// Half the width and half the height.
        half: Point,
        /// Radius of the corners.
        round: f32,
        /// The colour.
        ink: Ink,
    },
    /// A line through points.
    Line {
        /// At least two points.
        points: Vec<Point>,
        /// Width of the line.
        width: f32,
        /// The colour.
        ink: Ink,
    },
    /// A line whose width grows from 0 at its first point to `width` at its last.
    Trail {
        /// At least two points.
        points: Vec<Point>,
        /// Width at the last point.
        width: f32,
        /// The colour at the last point.
        ink: Ink,
    },
    /// Text on one line.
    Label {
        /// The anchor's position.
        at: Point,
        /// Which point of the text is at `at`.
        anchor: Anchor,
        /// The text.
        text: String,
        /// The size of the text.
        size: TextSize,
        /// The colour.
        ink: Ink,
    },
}

impl Mark {
    /// Moves the mark to the right and down.
    pub(crate) fn moved(mut self, [right, down]: Point) -> Self {
        let shift = |[x, y]: &mut Point| (*x, *y) = (*x + right, *y + down);
        match &mut self {
            Self::Disc { centre, .. } | Self::Box { centre, .. } => shift(centre),
            Self::Line { points, .. } | Self::Trail { points, .. } => points.iter_mut().for_each(shift),
            Self::Label { at, .. } => shift(at),
        }
        self
    }
}

/// Point of a text that is at a label's position, always at the middle of its height.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// The left end.
    Left,
    /// The middle.
    Centre,
    /// The right end.
    Right,
}

/// Size of a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TextSize {
    /// A label beside something, as a multiple of [`TextSize::SMALL`].
    Small(f32),
    /// A text to be read, as a multiple of [`TextSize::BODY`].
    Body(f32),
    /// A text that has to fit a shape, in the units of the list.
    Fit(f32),
}

impl Anchor {
    /// Left end of a text of `width` whose anchor is at `x`.
    pub fn left(self, x: f32, width: f32) -> f32 {
        match self {
            Self::Left => x,
            Self::Centre => x - width / 2.0,
            Self::Right => x - width,
        }
    }
}

impl TextSize {
    /// Usual size of labels, in the units of the list.
    pub const SMALL: f32 = 13.0;
    /// Usual size of texts to be read, in the units of the list.
    pub const BODY: f32 = 16.0;

    /// The size in the units of the list.
    pub fn units(self) -> f32 {
        match self {
            Self::Small(times) => Self::SMALL * times,
            Self::Body(times) => Self::BODY * times,
            Self::Fit(size) => size,
        }
    }

    /// Height of a line.
    pub(crate) fn line(self) -> f32 {
        1.2 * self.units()
    }

    /// Width of a number of letters, estimated rather too large than too small.
    pub(crate) fn width(self, letters: usize) -> f32 {
        0.6 * self.units() * letters as f32
    }
}

/// A colour's name and its opacity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ink {
    /// The colour.
    pub hue: Hue,
    /// Opacity, 0 to 1.
    pub alpha: f32,
}

/// A colour by its purpose, so that a theme can choose it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hue {
    /// A node's own colour.
    Node(NodeId),
    /// Text on a node's own colour.
    OnNode(NodeId),
    /// Text.
    Text,
    /// Text that explains.
    Quiet,
    /// Something selected.
    Accent,
    /// Lines of a grid.
    Hairline,
    /// The background.
    Ground,
    /// A given colour that no theme changes: of a material, or of light.
    Fixed(Rgb),
}

impl Hue {
    /// The colour, opaque.
    pub fn full(self) -> Ink {
        Ink { hue: self, alpha: 1.0 }
    }

    /// The colour with an opacity, 0 to 1.
    pub fn faint(self, alpha: f32) -> Ink {
        Ink { hue: self, alpha }
    }
}
