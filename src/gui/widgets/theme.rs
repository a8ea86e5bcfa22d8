//! How the window looks: an 8-pixel grid, three text sizes, one neutral surface, one accent.

use std::sync::Arc;

use egui::epaint::text::{FontTweak, VariationCoords};
use egui::style::{HandleShape, ScrollStyle, WidgetVisuals, Widgets};
use egui::{Color32, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Stroke, TextStyle, Theme, Visuals};

use crate::font::PLEX;
use crate::palette::{self, Rgb};

/// The grid on which everything lies, in points.
pub const GRID: f32 = 8.0;

/// For what stands beside something.
pub const SMALL: f32 = 13.0;
/// For what is read.
pub const BODY: f32 = 16.0;
/// For what is seen from the back of the room.
pub const LARGE: f32 = 26.0;

/// The colours of one theme. Hues belong to the nodes; the accent and what is wrong are the only others.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// What everything lies on.
    pub ground: Color32,
    /// What can be pressed.
    pub raised: Color32,
    /// Lines that order.
    pub hairline: Color32,
    /// Text.
    pub text: Color32,
    /// Text that explains.
    pub quiet: Color32,
    /// What to press first, and what has the focus.
    pub accent: Color32,
    /// Text on the accent.
    pub on_accent: Color32,
    /// Text that says what is wrong.
    pub trouble: Color32,
}

const DARK: Look = Look {
    ground: Color32::from_rgb(0x11, 0x14, 0x19),
    raised: Color32::from_rgb(0x1d, 0x22, 0x2a),
    hairline: Color32::from_rgb(0x2b, 0x32, 0x3c),
    text: Color32::from_rgb(0xec, 0xef, 0xf4),
    quiet: Color32::from_rgb(0x94, 0x9f, 0xae),
    accent: Color32::from_rgb(0xa3, 0x94, 0xff),
    on_accent: Color32::from_rgb(0x16, 0x10, 0x3a),
    trouble: Color32::from_rgb(0xff, 0x8b, 0x80),
};

const LIGHT: Look = Look {
    ground: colour(palette::LIGHT.ground),
    raised: Color32::from_rgb(0xec, 0xef, 0xf3),
    hairline: colour(palette::LIGHT.hairline),
    text: colour(palette::LIGHT.text),
    quiet: colour(palette::LIGHT.quiet),
    accent: colour(palette::LIGHT.accent),
    on_accent: Color32::WHITE,
    trouble: Color32::from_rgb(0xb4, 0x23, 0x18),
};

/// For a room: black and white, and nothing pale.
const STRONG_DARK: Look = Look {
    ground: Color32::BLACK,
    hairline: Color32::from_rgb(0x55, 0x60, 0x6e),
    text: Color32::WHITE,
    quiet: Color32::from_rgb(0xd2, 0xd9, 0xe2),
    accent: Color32::from_rgb(0xc0, 0xb4, 0xff),
    ..DARK
};

const STRONG_LIGHT: Look = Look {
    ground: Color32::WHITE,
    hairline: Color32::from_rgb(0x88, 0x92, 0x9e),
    text: Color32::BLACK,
    quiet: Color32::from_rgb(0x2f, 0x36, 0x40),
    ..LIGHT
};

fn strong_id() -> egui::Id {
    egui::Id::unique("strong colours")
}

impl Look {
    /// The colours of the theme in use.
    pub fn of(ctx: &egui::Context) -> Self {
        Self::with(ctx.theme(), Self::is_strong(ctx))
    }

    /// Whether colours are strong, for a room.
    pub fn is_strong(ctx: &egui::Context) -> bool {
        ctx.data(|data| data.get_temp(strong_id()).unwrap_or(false))
    }

    fn with(theme: Theme, strong: bool) -> Self {
        match (theme, strong) {
            (Theme::Dark, false) => DARK,
            (Theme::Light, false) => LIGHT,
            (Theme::Dark, true) => STRONG_DARK,
            (Theme::Light, true) => STRONG_LIGHT,
        }
    }

    /// Strong colours, which are seen from afar and by daylight, or the usual ones.
    pub fn set_strong(ctx: &egui::Context, strong: bool) {
        ctx.data_mut(|data| data.insert_temp(strong_id(), strong));
        for theme in [Theme::Dark, Theme::Light] {
            ctx.style_mut_of(theme, |style| style.visuals = visuals(theme, Self::with(theme, strong)));
        }
    }
}

/// Puts fonts and both themes in place.
pub fn install(ctx: &egui::Context) {
    ctx.set_fonts(fonts());
    for (theme, look) in [(Theme::Dark, DARK), (Theme::Light, LIGHT)] {
        ctx.style_mut_of(theme, |style| {
            style.visuals = visuals(theme, look);
            let sizes = [
                (TextStyle::Small, SMALL),
                (TextStyle::Body, BODY),
                (TextStyle::Button, BODY),
                (TextStyle::Monospace, BODY),
                (TextStyle::Heading, LARGE),
            ];
            style.text_styles = sizes.map(|(text, size)| (text, FontId::proportional(size))).into();
            let spacing = &mut style.spacing;
            spacing.item_spacing = egui::vec2(GRID, GRID);
            spacing.button_padding = egui::vec2(1.5 * GRID, GRID * 0.75);
            spacing.interact_size = egui::vec2(4.0 * GRID, 4.0 * GRID);
            spacing.slider_rail_height = 4.0;
            // Thin, and seen also where nobody points at it: there is more.
            style.spacing.scroll = ScrollStyle { dormant_handle_opacity: 0.6, ..ScrollStyle::thin() };
            style.interaction.selectable_labels = false;
        });
    }
}

/// The text font: regular, its digits all of one width.
pub fn regular(size: f32) -> FontId {
    FontId::proportional(size)
}

/// The same, bold: for numbers and names.
pub fn strong(size: f32) -> FontId {
    FontId::new(size, FontFamily::Name(STRONG.into()))
}

/// A palette colour as egui takes it.
pub const fn colour([r, g, b]: Rgb) -> Color32 {
    Color32::from_rgb(r, g, b)
}

/// A colour of egui's as the palette has it.
pub fn rgb(colour: Color32) -> Rgb {
    [colour.r(), colour.g(), colour.b()]
}

const STRONG: &str = "strong";

/// IBM Plex Sans in two weights of one variable font; egui's own fonts stand in for what it lacks.
fn fonts() -> FontDefinitions {
    let weighted = |weight: f32| {
        let coords = VariationCoords::new([(b"wght", weight)]);
        Arc::new(FontData::from_static(PLEX).tweak(FontTweak { coords, ..Default::default() }))
    };
    let mut fonts = FontDefinitions::default();
    fonts.font_data.insert("plex".into(), weighted(400.0));
    fonts.font_data.insert("plex strong".into(), weighted(600.0));
    let others = fonts.families.get(&FontFamily::Proportional).cloned().unwrap_or_default();
    for (family, font) in [(FontFamily::Proportional, "plex"), (FontFamily::Name(STRONG.into()), "plex strong")] {
        let list = std::iter::once(font.to_owned()).chain(others.iter().cloned()).collect();
        fonts.families.insert(family, list);
    }
    fonts
}

fn visuals(theme: Theme, look: Look) -> Visuals {
    let mut visuals = if theme == Theme::Dark { Visuals::dark() } else { Visuals::light() };
    let corner_radius = CornerRadius::same(6);
    let widget = |fill: Color32, line: Color32, text: Color32| WidgetVisuals {
        bg_fill: fill,
        weak_bg_fill: fill,
        bg_stroke: Stroke::new(1.0, line),
        corner_radius,
        fg_stroke: Stroke::new(1.5, text),
        expansion: 0.0,
    };
    visuals.widgets = Widgets {
        noninteractive: widget(look.ground, look.hairline, look.text),
        inactive: widget(look.raised, Color32::TRANSPARENT, look.text),
        hovered: widget(look.hairline, Color32::TRANSPARENT, look.text),
        active: widget(look.hairline, look.accent, look.text),
        open: widget(look.raised, look.accent, look.text),
    };
    visuals.override_text_color = None;
    visuals.weak_text_color = Some(look.quiet);
    visuals.panel_fill = look.ground;
    visuals.window_fill = look.ground;
    visuals.window_stroke = Stroke::new(1.0, look.hairline);
    visuals.extreme_bg_color = look.raised;
    visuals.selection.bg_fill = look.accent.gamma_multiply(0.25);
    visuals.selection.stroke = Stroke::new(1.5, look.accent);
    visuals.error_fg_color = look.trouble;
    visuals.hyperlink_color = look.accent;
    visuals.slider_trailing_fill = true;
    visuals.handle_shape = HandleShape::Circle;
    visuals
}
