//! Why a drawing fails.

use thiserror::Error;

use crate::picture::Size;

/// Why a drawing could not become pixels.
#[derive(Debug, Error)]
pub enum ExportError {
    /// The text is not SVG.
    #[error("the drawing is not SVG: {0}")]
    Svg(#[from] resvg::usvg::Error),
    /// The drawing cannot have this size.
    #[error("the drawing cannot have this size: {0}")]
    Size(#[source] Box<dyn std::error::Error + Send + Sync>),
    /// The drawing has more pixels than fit in memory.
    #[error("a drawing of {0} pixels is too large; choose a smaller size, or save it as .svg")]
    TooLarge(Size),
    /// A side of an animation is too long for the format.
    #[error(
        "an animation of {0} pixels is too large: a GIF is at most 65,535 pixels wide and high; choose a smaller width"
    )]
    GifSide(u32),
    /// The renderer returned fewer pixels than the drawing has.
    #[error("a drawing of {0} pixels came out with too few pixels")]
    TooFewPixels(Size),
}
