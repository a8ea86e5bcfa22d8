//! A Tab in a frame of its own: egui moves the focus before the field has taken what was typed in the same frame.

use egui::{Context, Event, Key, Plugin, RawInput};

/// Adds the plugin to `ctx`.
pub fn install(ctx: &Context) {
    ctx.add_plugin(TabOrder::default());
}

/// Holds back a Tab, or what follows it, until the next frame.
#[derive(Default)]
struct TabOrder {
    held: Vec<Event>,
}

impl Plugin for TabOrder {
    fn debug_name(&self) -> &'static str {
        "tab order"
    }

    fn input_hook(&mut self, ctx: &Context, input: &mut RawInput) {
        let mut events = std::mem::take(&mut self.held);
        events.append(&mut input.events);
        let is_tab = |event: &Event| matches!(event, Event::Key { key: Key::Tab, pressed: true, .. });
        let is_text = |event: &Event| matches!(event, Event::Text(_) | Event::Paste(_));
        if let Some(tab) = events.iter().position(is_tab) {
            let (before, after) = (events[..tab].iter().any(is_text), events[tab + 1..].iter().any(is_text));
            if before || after {
                self.held = events.split_off(if before { tab } else { tab + 1 });
                ctx.request_repaint();
            }
        }
        input.events = events;
    }
}
