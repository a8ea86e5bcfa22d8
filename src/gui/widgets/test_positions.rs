//! Tells where the named widgets are, so that a test can drive the real window without guessing.
//!
//! With `ANEL_PLACES` set, every widget that has an accessible name is written to standard error when it comes or
//! moves: `place: NAME: X Y WIDTH HEIGHT`, in pixels from the window's corner.

use std::collections::BTreeMap;

use egui::{Context, FullOutput, Plugin};

/// Adds the plugin to `ctx` if the environment asks for it.
pub fn install(ctx: &Context) {
    if std::env::var_os("ANEL_PLACES").is_some() {
        ctx.enable_accesskit();
        ctx.add_plugin(TestPositions::default());
    }
}

#[derive(Default)]
struct TestPositions {
    told: BTreeMap<String, [i64; 4]>,
}

impl Plugin for TestPositions {
    fn debug_name(&self) -> &'static str {
        "places"
    }

    fn output_hook(&mut self, ctx: &Context, output: &mut FullOutput) {
        let Some(update) = &output.platform_output.accesskit_update else { return };
        let scale = f64::from(ctx.pixels_per_point());
        for (_, node) in &update.nodes {
            let (Some(name), Some(bounds)) = (node.label(), node.bounds()) else { continue };
            let place = [bounds.x0, bounds.y0, bounds.width(), bounds.height()].map(|v| (v * scale).round() as i64);
            if self.told.insert(name.to_owned(), place) != Some(place) {
                let [x, y, width, height] = place;
                eprintln!("place: {name}: {x} {y} {width} {height}");
            }
        }
    }
}
