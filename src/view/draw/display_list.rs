//! A display list: what is to be drawn, without a word on how.

use crate::balance::NodeId;
use crate::palette::Rgb;

/// A place in the picture: x to the right, y down, in the units of the size that the list was made for.
pub type Point = [f32; 2];

/// One thing to be drawn; later ones lie on top.
#[derive(Clone, Debug, PartialEq)]
pub enum Mark {
    /// A filled circle.
    Disc {
        /// Its middle.
        centre: Point,
        /// Its radius.
        radius: f32,
        /// Its colour.
        ink: Ink,
    },
    /// A filled box with round corners.
    Box {
        /// Its middle.
        centre: Point,
        /// Half its width and height.
        half: Point,
        /// Radius of its corners.
        round: f32,
        /// Its colour.
        ink: Ink,
    },
    /// A line through points.
    Line {
        /// At least two points.
        points: Vec<Point>,
        /// How broad the line is.
        width: f32,
        /// Its colour.
        ink: Ink,
    },
    /// A line that grows from nothing at its first point to `width` at its last.
    Trail {
        /// At least two points.
        points: Vec<Point>,
        /// How broad it is at its head.
        width: f32,
        /// Its colour at its head.
        ink: Ink,
    },
    /// Text on one line.
    Label {
        /// Where it stands.
        at: Point,
        /// What of it stands there.
        anchor: Anchor,
        /// What it says.
        text: String,
        /// How large it is.
        size: TextSize,
        /// Its colour.
        ink: Ink,
    },
}

impl Mark {
    /// The same, so far to the right and down.
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

/// Which point of a text its place names; it is always the middle of its height.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Its left end.
    Left,
    /// Its middle.
    Centre,
    /// Its right end.
    Right,
}

/// How large text is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TextSize {
    /// For what stands beside something, so many times its usual size.
    Small(f32),
    /// For what is read, so many times its usual size.
    Body(f32),
    /// In the units of the list: for text that has to fit a shape.
    Fit(f32),
}

impl Anchor {
    /// The left end of a text of `width` whose place is `x`.
    pub fn left(self, x: f32, width: f32) -> f32 {
        match self {
            Self::Left => x,
            Self::Centre => x - width / 2.0,
            Self::Right => x - width,
        }
    }
}

impl TextSize {
    /// The usual size of what stands beside something, in the units of the list.
    pub const SMALL: f32 = 13.0;
    /// The usual size of what is read.
    pub const BODY: f32 = 16.0;

    /// The size in the units of the list, if the usual sizes are these.
    pub fn units(self) -> f32 {
        match self {
            Self::Small(times) => Self::SMALL * times,
            Self::Body(times) => Self::BODY * times,
            Self::Fit(size) => size,
        }
    }

    /// How high a line is.
    pub(crate) fn line(self) -> f32 {
        1.2 * self.units()
    }

    /// How broad so many letters are, rather too broad than too narrow.
    pub(crate) fn width(self, letters: usize) -> f32 {
        0.6 * self.units() * letters as f32
    }
}

/// A colour's name and how much of it is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ink {
    /// Which colour.
    pub hue: Hue,
    /// From 0 (nothing) to 1.
    pub alpha: f32,
}

/// Colours by what they are for, so that a theme can choose them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hue {
    /// A node's own colour.
    Node(NodeId),
    /// What can be read on a node's own colour.
    OnNode(NodeId),
    /// Text.
    Text,
    /// Text that explains.
    Quiet,
    /// What was chosen.
    Accent,
    /// Lines that order.
    Hairline,
    /// What everything lies on.
    Ground,
    /// A colour that is itself what is told: a material's, or that of light.
    Told(Rgb),
}

impl Hue {
    /// The colour, fully seen.
    pub fn full(self) -> Ink {
        Ink { hue: self, alpha: 1.0 }
    }

    /// The colour, only partly seen.
    pub fn faint(self, alpha: f32) -> Ink {
        Ink { hue: self, alpha }
    }
}
