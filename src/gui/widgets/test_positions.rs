//! Positions of the named widgets, for a test that drives the real window with a mouse.
//!
//! With `ANEL_PLACES` set, each widget with an accessible name is written to standard error when it appears or moves:
//! `place: NAME: X Y WIDTH HEIGHT`, in pixels from the window's corner.

use std::collections::BTreeMap;

use egui::{Context, FullOutput, Plugin};

/// Adds the plugin to `ctx` if `ANEL_PLACES` is set.
pub fn install(ctx: &Context) {
    if std::env::var_os("ANEL_PLACES").is_some() {
        ctx.enable_accesskit();
        ctx.add_plugin(TestPositions::default());
    }
}

#[derive(Default)]
struct TestPositions {
    written: BTreeMap<String, [i64; 4]>,
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
            let rect = [bounds.x0, bounds.y0, bounds.width(), bounds.height()].map(|v| (v * scale).round() as i64);
            if self.written.insert(name.to_owned(), rect) != Some(rect) {
                let [x, y, width, height] = rect;
                eprintln!("place: {name}: {x} {y} {width} {height}");
            }
        }
    }
}
