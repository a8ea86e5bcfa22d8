//! Fonts, sizes and colours: an 8-point grid, three text sizes, one neutral surface, one accent.

use std::sync::Arc;

use egui::epaint::text::{FallbackRequest, FontInsert, FontTweak, VariationCoords};
use egui::style::{HandleShape, ScrollStyle, WidgetVisuals, Widgets};
use egui::{Color32, CornerRadius, FontData, FontDefinitions, FontFamily, FontId, Stroke, TextStyle, Theme, Visuals};

use crate::font::{PLEX, SystemFont, system_font};
use crate::palette::{self, Rgb};

/// Unit of all distances, in points.
pub const GRID: f32 = 8.0;

/// Text size of labels and explanations, in points.
pub const SMALL: f32 = 13.0;
/// Text size of running text, in points.
pub const BODY: f32 = 16.0;
/// Text size of titles and results, in points: legible from the back of a room.
pub const LARGE: f32 = 26.0;

/// Colours of one theme. Hues are for the nodes; the only other ones are the accent and the colour of errors.
#[derive(Clone, Copy, Debug)]
pub struct Look {
    /// Background.
    pub ground: Color32,
    /// Background of buttons and fields.
    pub raised: Color32,
    /// Thin lines between parts.
    pub hairline: Color32,
    /// Usual text.
    pub text: Color32,
    /// Secondary text.
    pub quiet: Color32,
    /// Main action, and keyboard focus.
    pub accent: Color32,
    /// Text on the accent.
    pub on_accent: Color32,
    /// Text of errors.
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

/// Strong colours for a projector: black and white, nothing pale.
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
    /// Returns the colours of the present theme.
    pub fn of(ctx: &egui::Context) -> Self {
        Self::with(ctx.theme(), Self::is_strong(ctx))
    }

    /// Whether the strong colours are on.
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

    /// Switches between the strong colours, legible from afar and by daylight, and the usual ones.
    pub fn set_strong(ctx: &egui::Context, strong: bool) {
        ctx.data_mut(|data| data.insert_temp(strong_id(), strong));
        for theme in [Theme::Dark, Theme::Light] {
            ctx.style_mut_of(theme, |style| style.visuals = visuals(theme, Self::with(theme, strong)));
        }
    }
}

/// Installs the fonts and both themes.
pub fn install(ctx: &egui::Context) {
    ctx.set_fonts(fonts());
    ctx.add_font_provider(Arc::new(font_of_the_system));
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
            // Visible without hovering, so that the user sees that there is more.
            style.spacing.scroll = ScrollStyle { dormant_handle_opacity: 0.6, ..ScrollStyle::thin() };
            style.interaction.selectable_labels = false;
        });
    }
}

/// Returns the regular font; its digits have one width.
pub fn regular(size: f32) -> FontId {
    FontId::proportional(size)
}

/// Returns the bold font, for numbers and names.
pub fn strong(size: f32) -> FontId {
    FontId::new(size, FontFamily::Name(STRONG.into()))
}

/// Converts a palette colour to egui's type.
pub const fn colour([r, g, b]: Rgb) -> Color32 {
    Color32::from_rgb(r, g, b)
}

/// Converts an egui colour to the palette's type.
pub fn rgb(colour: Color32) -> Rgb {
    [colour.r(), colour.g(), colour.b()]
}

const STRONG: &str = "strong";

/// Finds a font of the computer for a letter that the program's own fonts lack, as in a title in another script.
fn font_of_the_system(request: &FallbackRequest<'_>) -> Option<FontInsert> {
    let letter = request.cluster.chars().next()?;
    let SystemFont { data, index } = system_font(letter)?;
    let name = format!("system: {letter}");
    Some(FontInsert { name, data: FontData::from_blob(Arc::new(data), index), families: Vec::new() })
}

/// Returns IBM Plex Sans in two weights of one variable font, with egui's fonts for missing glyphs.
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
