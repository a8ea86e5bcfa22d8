//! What compiling does to need less work for the same picture, piece by piece, so that it can be asked what each piece saves.

/// One thing that compiling does for speed alone. None changes what is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pass {
    /// What is proved empty is dropped, and what reaches none of that which it would be taken from.
    Reach,
    /// A union of many is a tree of unions of neighbours.
    Neighbours,
    /// Convex primitives that are intersected are one span.
    Convex,
    /// Balls, and boxes along the axes, are kept in the scene's coordinates.
    Shapes,
    /// Compositions are tested only by rays that meet their boxes.
    Boxes,
    /// An opaque union is as many solids as it has parts.
    Apart,
    /// Solids are in a hierarchy of boxes.
    Hierarchy,
    /// Whole exponents are powers by multiplication.
    Powers,
}

impl Pass {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Reach,
        Self::Neighbours,
        Self::Convex,
        Self::Shapes,
        Self::Boxes,
        Self::Apart,
        Self::Hierarchy,
        Self::Powers,
    ];

    /// What it does, as a sentence.
    pub fn says(self) -> &'static str {
        match self {
            Self::Reach => "what is empty or out of reach is dropped",
            Self::Neighbours => "a union of many is a tree of unions of neighbours",
            Self::Convex => "convex primitives that are intersected are one span",
            Self::Shapes => "balls, and boxes along the axes, are kept in the scene's coordinates",
            Self::Boxes => "compositions are tested only by rays that meet their boxes",
            Self::Apart => "an opaque union is as many solids as it has parts",
            Self::Hierarchy => "solids are in a hierarchy of boxes",
            Self::Powers => "whole exponents are powers by multiplication",
        }
    }
}

/// Some of the reductions; all of them by default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Passes(u16);

impl Passes {
    /// All but this one.
    pub fn without(self, reduction: Pass) -> Self {
        Self(self.0 & !(1 << reduction as u16))
    }

    /// Whether this one is among them.
    pub fn has(self, reduction: Pass) -> bool {
        self.0 >> reduction as u16 & 1 == 1
    }
}

impl Default for Passes {
    fn default() -> Self {
        Self(u16::MAX)
    }
}
