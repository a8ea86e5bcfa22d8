//! What is known of a file before it is written: its format, its size, and what is missing in it.

use std::path::Path;

use super::preview::png_size;
use crate::gui::session::{Export, Phase, Session};
use crate::gui::widgets::path_input::TypedPath;
use crate::language::{Language, comma, say, word};
use crate::view::{count, percent};

/// Describes the file of an export in a line. `whole` is the size of a drawing in its own units, once it is known.
pub(super) fn of(export: &Export, path: &TypedPath, whole: Option<[u32; 2]>, session: &Session) -> String {
    let language = session.language();
    let own = session.header().size;
    let records = || count(session.stage().log.records().len() as u32);
    let facts = match export {
        Export::Shown(_) => vec!["PNG".into(), pixels([own.width(), own.height()], language)],
        Export::Picture(picture) => {
            let size = picture.region.map_or(picture.size, |region| region.size);
            let samples = picture.quality.samples;
            let samples = say!(language, "{samples} × {samples} samples", "{samples} × {samples} amostras");
            vec!["PNG".into(), pixels([size.width(), size.height()], language), samples]
        }
        Export::Drawing(_) | Export::Bars(_) => drawing(path, whole, language),
        Export::Film(film) => {
            let seconds = comma(language, film.duration().as_secs_f64().to_string());
            let seconds = say!(language, "{seconds} s with its end", "{seconds} s com o final");
            vec!["GIF".into(), pixels(film.size(own), language), seconds]
        }
        Export::Run | Export::Chrome => {
            let (format, records) = (if *export == Export::Run { "ANEL" } else { "JSON" }, records());
            vec![format.into(), say!(language, "{records} records", "{records} registros")]
        }
        Export::Table => {
            let rows = records();
            vec!["CSV".into(), say!(language, "{rows} rows", "{rows} linhas")]
        }
        Export::Rows(comparison) => {
            let rows = comparison.runs.len();
            vec!["CSV".into(), say!(language, "{rows} rows", "{rows} linhas")]
        }
    };
    let state = session.stage().latest();
    let depends_on_run = !matches!(export, Export::Picture(_) | Export::Bars(_) | Export::Rows(_));
    let is_partial = depends_on_run && session.stage().phase != Phase::Finished;
    let done = percent(state.done(), state.atoms());
    let so_far = is_partial.then(|| say!(language, "so far: {done} of the run", "até agora: {done} da execução"));
    facts.into_iter().chain(so_far).collect::<Vec<_>>().join(" · ")
}

/// Describes the file of a drawing: SVG has no pixels.
fn drawing(path: &TypedPath, whole: Option<[u32; 2]>, language: Language) -> Vec<String> {
    let ending = Path::new(path.text().trim()).extension();
    if ending.is_some_and(|ending| ending.eq_ignore_ascii_case("png")) {
        let size = whole.map(|whole| pixels(png_size(whole), language));
        return std::iter::once("PNG".into()).chain(size).collect();
    }
    let sharp = word!(language, "sharp at any size; .png for pixels", "nítido em qualquer tamanho; .png para pixels");
    vec!["SVG".into(), sharp.into()]
}

fn pixels([width, height]: [u32; 2], language: Language) -> String {
    say!(language, "{width} × {height} pixels", "{width} × {height} pixels")
}
