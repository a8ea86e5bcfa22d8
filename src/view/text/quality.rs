//! A quality, and its measured time and errors, in words.

use std::time::Duration;

use super::format::{counted, duration, two_digits};
use crate::language::{Language, comma, decimal, say, word};
use crate::picture::{Difference, Quality, Size};

/// Describes a quality for a sentence.
pub fn quality_words(quality: &Quality, language: Language) -> String {
    let lines = quality_lines(quality, language);
    lines.into_iter().map(|(_, words)| words).collect::<Vec<_>>().join(", ")
}

/// Describes a quality, one option on each line.
pub fn quality_lines(quality: &Quality, language: Language) -> Vec<(&'static str, String)> {
    let Quality { samples, threshold, max_depth, cutoff, .. } = *quality;
    let error = comma(language, threshold.to_string());
    let taken = match (samples, threshold) {
        (1, _) => word!(language, "1 sample a pixel", "1 amostra por pixel").into(),
        (_, 0.0) => say!(language, "{samples} × {samples} samples a pixel", "{samples} × {samples} amostras por pixel"),
        _ => say!(
            language,
            "up to {samples} × {samples} samples a pixel, until the estimated error is {error}",
            "até {samples} × {samples} amostras por pixel, até o erro estimado ser {error}"
        ),
    };
    let part = two_digits(100.0 * cutoff, language);
    let left_out = if cutoff > 0.0 {
        say!(language, "weak rays left out up to {part} % of a pixel", "raios fracos omitidos até {part} % de um pixel")
    } else {
        word!(language, "no weak rays left out", "nenhum raio fraco omitido").into()
    };
    let levels = counted(max_depth, word!(language, "level", "nível"), language);
    vec![
        (word!(language, "Samples", "Amostras"), taken),
        (word!(language, "Rays", "Raios"), say!(language, "{levels} of rays", "{levels} de raios")),
        (word!(language, "Cutoff", "Corte"), left_out),
    ]
}

/// Describes a measured quality: its time on one core for a picture of `size`, and the difference from the reference of
/// a picture of size `measured`.
pub fn measured_lines(
    time: Duration,
    size: Size,
    difference: &Difference,
    measured: Size,
    language: Language,
) -> Vec<(&'static str, String)> {
    let wrong = decimal(language, 100.0 * f64::from(difference.wrong_pixels) / f64::from(measured.pixels()), 1);
    let limit = Difference::TOLERANCE;
    let (took, width, height) = (duration(time, language), size.width(), size.height());
    let worst = decimal(language, difference.worst_ssim, 3);
    vec![
        (
            word!(language, "Time", "Tempo"),
            say!(
                language,
                "{took} of one core for {width} × {height} pixels",
                "{took} de um núcleo para {width} × {height} pixels"
            ),
        ),
        (word!(language, "Error", "Erro"), two_digits(difference.rmse, language)),
        (
            word!(language, "Wrong", "Errados"),
            say!(
                language,
                "{wrong} % of the pixels: a channel differs by more than {limit} of 255",
                "{wrong} % dos pixels: um canal difere em mais de {limit} de 255"
            ),
        ),
        (
            word!(language, "Worst", "Pior"),
            say!(
                language,
                "{worst} is the similarity of the worst block; 1 is the same (SSIM)",
                "{worst} é a semelhança do pior bloco; 1 é igual (SSIM)"
            ),
        ),
    ]
}

/// Compares a time with that of the present settings.
pub fn times_words(time: f64, than: f64, language: Language) -> String {
    let times = time / than;
    let [faster, longer] = [1.0 / times, times].map(|times| decimal(language, times, 1));
    if !times.is_finite() || (0.95..1.05).contains(&times) {
        word!(language, "about as long as the present settings", "quase o mesmo tempo que o ajuste atual").into()
    } else if times < 1.0 {
        say!(
            language,
            "{faster} times as fast as the present settings",
            "{faster} vezes mais rápido que o ajuste atual"
        )
    } else {
        say!(language, "{longer} times as long as the present settings", "{longer} vezes o tempo do ajuste atual")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quality_is_described_by_its_options() {
        let language = Language::English;
        assert_eq!(
            quality_words(&Quality::default(), language),
            "1 sample a pixel, 10 levels of rays, weak rays left out up to 0.39 % of a pixel"
        );
        let best = Quality { samples: 8, max_depth: 1, cutoff: 0.0, ..Quality::default() };
        assert_eq!(quality_words(&best, language), "8 × 8 samples a pixel, 1 level of rays, no weak rays left out");
        let adaptive = Quality { samples: 4, threshold: 0.02, ..Quality::default() };
        assert!(
            quality_words(&adaptive, language)
                .starts_with("up to 4 × 4 samples a pixel, until the estimated error is 0.02, 10 levels")
        );
    }

    #[test]
    fn times_are_compared_in_the_direction_of_the_gain() {
        let language = Language::English;
        let said =
            [(1.0, 1.01), (1.0, 2.5), (3.0, 1.0), (0.0, 0.0)].map(|(one, other)| times_words(one, other, language));
        let now = "as the present settings";
        assert_eq!(
            said,
            [
                format!("about as long {now}"),
                format!("2.5 times as fast {now}"),
                format!("3.0 times as long {now}"),
                format!("about as long {now}")
            ]
        );
    }

    #[test]
    fn measured_quality_has_units() {
        let language = Language::English;
        let difference = Difference { rmse: 0.0123, wrong_pixels: 30, worst_ssim: 0.5 };
        let size = |width, height| Size::new(width, height).unwrap();
        let said = measured_lines(Duration::from_millis(1234), size(640, 480), &difference, size(20, 15), language);
        let said: Vec<String> = said.into_iter().map(|(what, words)| format!("{what}: {words}")).collect();
        assert_eq!(said[0], "Time: 1.2 s of one core for 640 × 480 pixels");
        assert!(said[2].starts_with("Wrong: 10.0 % of the pixels") && said[3].contains("0.500"), "{said:?}");
    }
}
