//! Bars and texts of progress.

use egui::{ProgressBar, Role, Ui, WidgetInfo};

use super::theme::{GRID, Look};
use crate::language::{Language, say};
use crate::view::fraction;

/// Shows a bar of a `share` (0 to 1) that is done; `name` says of what.
pub fn bar(ui: &mut Ui, share: f64, name: &str) {
    let look = Look::of(ui.ctx());
    ui.scope(|ui| {
        ui.visuals_mut().extreme_bg_color = look.hairline;
        let bar = ProgressBar::new(share as f32).desired_width(16.0 * GRID).desired_height(GRID).fill(look.accent);
        let name = format!("{name}: {}", fraction(share));
        ui.add(bar).widget_info(|| WidgetInfo::labeled(Role::ProgressIndicator, true, &name));
    });
}

/// Returns the share that is done, and the time that is left if it can be estimated.
pub fn words(share: f64, elapsed_s: f64, language: Language) -> String {
    let done = fraction(share);
    match time_left(elapsed_s, share, language) {
        Some(left) => format!("{done} · {left}"),
        None => done,
    }
}

/// Returns a text of the time that is left; `None` while there is too little to estimate it from.
fn time_left(secs: f64, share: f64, language: Language) -> Option<String> {
    let left = (secs / share - secs).ceil();
    if secs < 1.5 || share < 0.01 || left < 1.0 {
        return None;
    }
    let minutes = (left / 60.0).round();
    Some(if left < 90.0 {
        say!(language, "about {left} s left", "faltam cerca de {left} s")
    } else {
        say!(language, "about {minutes} min left", "faltam cerca de {minutes} min")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_left_is_estimated_from_the_share() {
        let language = Language::English;
        assert_eq!(time_left(10.0, 0.25, language).as_deref(), Some("about 30 s left"));
        assert_eq!(time_left(60.0, 0.25, language).as_deref(), Some("about 3 min left"));
        assert_eq!(
            [time_left(1.0, 0.25, language), time_left(10.0, 0.0, language), time_left(10.0, 1.0, language)],
            [None, None, None]
        );
    }
}
