//! The typeface of the window and of exported drawings.

/// IBM Plex Sans (SIL Open Font License 1.1): one variable font of all weights.
pub const PLEX: &[u8] = include_bytes!("../assets/fonts/IBMPlexSans.ttf");

/// The name of the font's family.
pub const PLEX_NAME: &str = "IBM Plex Sans";
