//! Kinds of files that the save sheet writes, with their texts and file names.

use std::path::Path;

use crate::language::{Language, say, word};
use crate::output::{as_file_name, check_ending};
use crate::picture::Size;
use crate::runlog::Header;

/// Kind of a saved file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SaveKind {
    /// The picture as the tracer made it.
    #[default]
    Render,
    /// The picture in the colours of the machines that traced it.
    Owners,
    /// The picture in the colours of the atoms' costs.
    Costs,
    /// The picture in the colours of the atoms' arrival times.
    Arrival,
    /// The picture as it is shown, blended with a layer.
    Blend,
    /// The picture at another size, traced again.
    Large,
    /// The ring as it is shown.
    Ring,
    /// The timeline of the whole run.
    Timeline,
    /// The run as an animation.
    Film,
    /// The run's records, to be played again.
    Run,
    /// The run's records as a table.
    Table,
    /// The run's records for Perfetto.
    Chrome,
    /// The time budgets of the compared runs as bars.
    Bars,
    /// The compared runs as a table.
    Rows,
}

/// A heading in English and in Portuguese, and the kinds below it.
pub type KindGroup = ((&'static str, &'static str), &'static [SaveKind]);

impl SaveKind {
    /// Groups of kinds for a run, each with its heading.
    pub const OF_RUN: [KindGroup; 3] = [
        (
            ("The picture", "A imagem"),
            &[Self::Render, Self::Owners, Self::Costs, Self::Arrival, Self::Blend, Self::Large],
        ),
        (("The course of the run", "O curso da execução"), &[Self::Ring, Self::Timeline, Self::Film]),
        (("The records", "Os registros"), &[Self::Run, Self::Table, Self::Chrome]),
    ];

    /// Kinds for compared runs, and for the run that is their subject.
    pub const OF_COMPARISON: [KindGroup; 1] =
        [(("The compared runs", "As execuções comparadas"), &[Self::Bars, Self::Rows, Self::Run])];

    /// Returns the text of its button.
    pub fn name(self, language: Language) -> &'static str {
        match self {
            Self::Render => word!(language, "render", "imagem"),
            Self::Owners => word!(language, "owners", "donas"),
            Self::Costs => word!(language, "costs", "custos"),
            Self::Arrival => word!(language, "arrival", "chegada"),
            Self::Blend => word!(language, "blend", "mistura"),
            Self::Large => word!(language, "any size", "ampliada"),
            Self::Ring => word!(language, "ring", "anel"),
            Self::Timeline => word!(language, "timeline", "linha do tempo"),
            Self::Film => word!(language, "animation (GIF)", "filme (GIF)"),
            Self::Run => word!(language, "run", "execução"),
            Self::Table | Self::Rows => word!(language, "table", "tabela"),
            Self::Chrome => "Perfetto",
            Self::Bars => word!(language, "bars", "barras"),
        }
    }

    /// Returns its description.
    pub fn hint(self, language: Language) -> &'static str {
        match self {
            Self::Render => word!(language, "The picture as it was traced", "A imagem como foi calculada"),
            Self::Owners => {
                word!(
                    language,
                    "The picture in the colours of the machines that traced it",
                    "A imagem nas cores das máquinas que a calcularam"
                )
            }
            Self::Costs => {
                word!(
                    language,
                    "The picture in the colours of the atoms' costs",
                    "A imagem nas cores dos custos dos átomos"
                )
            }
            Self::Arrival => {
                word!(
                    language,
                    "The picture in the colours of the atoms' arrival",
                    "A imagem nas cores da chegada dos átomos"
                )
            }
            Self::Blend => word!(
                language,
                "The picture as it is shown now, with its layer",
                "A imagem como aparece agora, com sua camada"
            ),
            Self::Large => {
                word!(
                    language,
                    "The picture at any size and quality, traced again",
                    "A imagem em qualquer tamanho e qualidade, calculada de novo"
                )
            }
            Self::Ring => word!(language, "The ring as it is shown: SVG or PNG", "O anel como aparece: SVG ou PNG"),
            Self::Timeline => {
                word!(
                    language,
                    "The timeline of the whole run: SVG or PNG",
                    "A linha do tempo de toda a execução: SVG ou PNG"
                )
            }
            Self::Film => {
                word!(language, "The whole run in some seconds: GIF", "Toda a execução em alguns segundos: GIF")
            }
            Self::Run => word!(
                language,
                "All records of the run, to play it again",
                "Todos os registros da execução, para repeti-la"
            ),
            Self::Table => word!(language, "All records of the run: CSV", "Todos os registros da execução: CSV"),
            Self::Chrome => {
                word!(
                    language,
                    "What each machine did, for ui.perfetto.dev",
                    "O que cada máquina fez, para ui.perfetto.dev"
                )
            }
            Self::Bars => word!(
                language,
                "Where the time of the compared runs went: SVG or PNG",
                "Para onde foi o tempo das execuções comparadas: SVG ou PNG"
            ),
            Self::Rows => word!(language, "A row for each compared run: CSV", "Uma linha por execução comparada: CSV"),
        }
    }

    /// Returns the name of its format.
    pub fn format(self) -> &'static str {
        match self.ending() {
            "png" => "PNG",
            "svg" => "SVG",
            "gif" => "GIF",
            "csv" => "CSV",
            "json" => "JSON",
            _ => "ANEL",
        }
    }

    /// Checks that the extension of the path does not stand for another format.
    ///
    /// # Errors
    /// A sentence with the possible extension.
    pub fn check_ending(self, path: &Path, language: Language) -> Result<(), String> {
        let (format, own) = (self.format(), self.ending());
        let also: &[&str] = match self {
            Self::Ring | Self::Timeline | Self::Bars => &["svg", "png"],
            Self::Run => &["anel", "json", "jsonl"],
            _ => &[own],
        };
        check_ending(path, format, also).map_err(|_| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let endings = also.iter().take(if self == Self::Run { 1 } else { 2 }).map(|ending| format!(".{ending}"));
            let endings: Vec<_> = endings.collect();
            let endings = endings.join(word!(language, " or ", " ou "));
            say!(
                language,
                "{name}: this is no name for such a file. Let it end in {endings}",
                "{name}: este nome não serve para um arquivo assim. Termine com {endings}"
            )
        })
    }

    /// Returns the extension of its file.
    pub fn ending(self) -> &'static str {
        match self {
            Self::Render | Self::Owners | Self::Costs | Self::Arrival | Self::Blend | Self::Large => "png",
            Self::Ring | Self::Timeline | Self::Bars => "svg",
            Self::Film => "gif",
            Self::Run => "anel",
            Self::Table | Self::Rows => "csv",
            Self::Chrome => "json",
        }
    }

    /// Returns a file name that says what is saved. `own` tells a picture that is traced again or an animation from
    /// others: its size and so on.
    pub fn file_name(self, header: &Header, done: bool, own: &str) -> String {
        let scene = as_file_name(&header.scene);
        let of_run = format!("-{}-{}", header.scheduler().name(), header.speeds.len());
        let content = match self {
            Self::Render | Self::Large => String::new(),
            Self::Owners => "-owners".into(),
            Self::Costs => "-costs".into(),
            Self::Arrival => "-arrival".into(),
            Self::Blend => "-blend".into(),
            Self::Run | Self::Film | Self::Table => of_run,
            Self::Ring => of_run + "-moment",
            Self::Timeline => of_run + "-timeline",
            Self::Chrome => of_run + "-perfetto",
            Self::Bars | Self::Rows => "-comparison".into(),
        };
        let size = header.size.to_string();
        let size = if matches!(self, Self::Large | Self::Film) { own } else { &size };
        let is_whole = done || matches!(self, Self::Large | Self::Bars | Self::Rows);
        let unfinished = if is_whole { "" } else { "-unfinished" };
        format!("{scene}-{size}{content}{unfinished}.{}", self.ending())
    }
}

/// What people call 1080p: the pixels of a screen, 16 : 9.
pub const FULL_HD: [u32; 2] = [1920, 1080];

/// What people call 4K: the pixels of a screen, 16 : 9.
pub const FOUR_K: [u32; 2] = [3840, 2160];

/// Whether two sizes have the same shape, up to one pixel.
pub fn has_same_shape([width, height]: [u32; 2], [w, h]: [u32; 2]) -> bool {
    let (width, height) = (f64::from(width), f64::from(height));
    (width * f64::from(h) / f64::from(w) - height).abs() <= 1.0
        || (height * f64::from(w) / f64::from(h) - width).abs() <= 1.0
}

/// Longest side of a picture that is traced again, in pixels.
pub const MAX_SIDE_PX: u32 = 16_384;

/// Returns the size of a picture that is traced again.
///
/// # Errors
/// A sentence, if a side is 0 or there are too many pixels.
pub fn large([width, height]: [u32; 2]) -> Result<Size, String> {
    Ok(Size::new(width.min(MAX_SIDE_PX), height.min(MAX_SIDE_PX))?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::settings::Settings;

    #[test]
    fn sizes_of_one_shape_differ_by_a_pixel_at_most() {
        assert!(has_same_shape([1280, 720], FOUR_K));
        assert!(has_same_shape([641, 480], [2885, 2160]) && has_same_shape([640, 480], [333, 250]));
        assert!(!has_same_shape([640, 480], [3840, 2160]) && !has_same_shape([640, 480], [480, 640]));
    }

    #[test]
    fn file_names_are_distinct_and_say_what_is_saved() {
        let header = Settings::default().header("my scene", "", Default::default(), 2);
        let named = |kind: SaveKind, done| kind.file_name(&header, done, "3840x2160");
        assert_eq!(named(SaveKind::Render, true), "my-scene-640x480.png");
        assert_eq!(named(SaveKind::Owners, false), "my-scene-640x480-owners-unfinished.png");
        assert_eq!(named(SaveKind::Run, true), "my-scene-640x480-ring-8.anel");
        assert_eq!(named(SaveKind::Film, true), "my-scene-3840x2160-ring-8.gif");
        assert_eq!(named(SaveKind::Large, false), "my-scene-3840x2160.png");
        assert_eq!(named(SaveKind::Timeline, true), "my-scene-640x480-ring-8-timeline.svg");
        assert_eq!(named(SaveKind::Bars, false), "my-scene-640x480-comparison.svg");
        for groups in [&SaveKind::OF_RUN[..], &SaveKind::OF_COMPARISON[..]] {
            let kinds = || groups.iter().flat_map(|(_, kinds)| *kinds);
            let names: std::collections::BTreeSet<String> = kinds().map(|kind| named(*kind, true)).collect();
            assert_eq!(names.len(), kinds().count(), "file names differ");
        }
    }
}
