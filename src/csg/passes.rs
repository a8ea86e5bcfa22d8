//! What compiling does to need less work for the same picture, piece by piece, so that it can be asked what each piece saves.

/// One thing that compiling does for speed alone. None changes what is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pass {
    /// What is proved empty is dropped, and what reaches none of that which it would be taken from.
    CullEmpty,
    /// A union of many is a tree of unions of neighbours.
    UnionTrees,
    /// Convex primitives that are intersected are one span.
    ConvexSpans,
    /// Balls, and boxes along the axes, are kept in the scene's coordinates.
    SceneShapes,
    /// Compositions are tested only by rays that meet their boxes.
    CompositionBounds,
    /// An opaque union is as many solids as it has parts.
    SplitUnions,
    /// Solids are in a hierarchy of boxes.
    Bvh,
    /// Whole exponents are powers by multiplication.
    IntegerPowers,
}

impl Pass {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::CullEmpty,
        Self::UnionTrees,
        Self::ConvexSpans,
        Self::SceneShapes,
        Self::CompositionBounds,
        Self::SplitUnions,
        Self::Bvh,
        Self::IntegerPowers,
    ];

    /// What it does, as a sentence.
    pub fn description(self) -> &'static str {
        match self {
            Self::CullEmpty => "what is empty or out of reach is dropped",
            Self::UnionTrees => "a union of many is a tree of unions of neighbours",
            Self::ConvexSpans => "convex primitives that are intersected are one span",
            Self::SceneShapes => "balls, and boxes along the axes, are kept in the scene's coordinates",
            Self::CompositionBounds => "compositions are tested only by rays that meet their boxes",
            Self::SplitUnions => "an opaque union is as many solids as it has parts",
            Self::Bvh => "solids are in a hierarchy of boxes",
            Self::IntegerPowers => "whole exponents are powers by multiplication",
        }
    }
}

/// Some of the passes; all of them by default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Passes(u16);

impl Passes {
    /// All but this one.
    pub fn without(self, pass: Pass) -> Self {
        Self(self.0 & !(1 << pass as u16))
    }

    /// Whether this one is among them.
    pub fn has(self, pass: Pass) -> bool {
        self.0 >> pass as u16 & 1 == 1
    }
}

impl Default for Passes {
    fn default() -> Self {
        Self(u16::MAX)
    }
}
