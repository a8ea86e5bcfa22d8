//! The passes of the compiler: each saves work and keeps the picture, and each can be switched off to measure what it
//! saves.

/// A pass of the compiler, for speed alone: none changes the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pass {
    /// Drops solids that are proved empty, and operands that lie outside the solid that they are subtracted from.
    CullEmpty,
    /// Finds a box for what is bounded only by what it is intersected with or subtracted from.
    FoundBounds,
    /// Makes a union of many operands a tree of unions of neighbours.
    UnionTrees,
    /// Computes the intersection of convex primitives as one span.
    ConvexSpans,
    /// Stores balls and axis-aligned boxes in scene coordinates.
    SceneShapes,
    /// Tests a composition only with rays that meet its bounding box.
    CompositionBounds,
    /// Splits an opaque union into its operands.
    SplitUnions,
    /// Splits also the unions inside an opaque difference or intersection.
    LocalParts,
    /// Puts the solids into a hierarchy of bounding boxes.
    Bvh,
    /// Computes integer powers by multiplication.
    IntegerPowers,
}

impl Pass {
    /// All passes.
    pub const ALL: [Self; 10] = [
        Self::CullEmpty,
        Self::FoundBounds,
        Self::UnionTrees,
        Self::ConvexSpans,
        Self::SceneShapes,
        Self::CompositionBounds,
        Self::SplitUnions,
        Self::LocalParts,
        Self::Bvh,
        Self::IntegerPowers,
    ];

    /// What the pass does, for reports.
    pub fn description(self) -> &'static str {
        match self {
            Self::CullEmpty => "empty solids and subtrahends out of reach are dropped",
            Self::FoundBounds => "quadrics and half-spaces get boxes from what they are composed with",
            Self::UnionTrees => "a union of many is a tree of unions of neighbours",
            Self::ConvexSpans => "an intersection of convex primitives is one span",
            Self::SceneShapes => "balls and axis-aligned boxes are stored in scene coordinates",
            Self::CompositionBounds => "a composition is tested only with rays that meet its box",
            Self::SplitUnions => "an opaque union is split into its operands",
            Self::LocalParts => "unions inside an opaque difference or intersection are split, too",
            Self::Bvh => "solids are in a hierarchy of boxes",
            Self::IntegerPowers => "integer powers are computed by multiplication",
        }
    }
}

/// A set of passes; all of them by default.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Passes(u16);

impl Passes {
    /// The set without this pass.
    pub fn without(self, pass: Pass) -> Self {
        Self(self.0 & !(1 << pass as u16))
    }

    /// Whether the set contains this pass.
    pub fn has(self, pass: Pass) -> bool {
        self.0 >> pass as u16 & 1 == 1
    }
}

impl Default for Passes {
    fn default() -> Self {
        Self(u16::MAX)
    }
}
