//! Widgets that stay the same widgets when others before them come or go.
//!
//! egui numbers the widgets of a place in their order. With such an id, a press is lost whose widget gets another
//! number before the release, and a field loses the focus with a number half typed.

use egui::{Align2, Id, Rect, Response, Sense, Ui, Vec2};

/// Returns the id of the widget with this name, or of the scope of its parts. No other in the same place has the name;
/// what follows a colon in it is a value, which may change.
pub fn steady_id(ui: &Ui, name: &str) -> Id {
    ui.scope_id().with(("steady", name.split(':').next()))
}

/// Allocates `rect` for the widget with this name.
pub fn allocate_rect(ui: &mut Ui, rect: Rect, name: &str, sense: Sense) -> Response {
    ui.advance_cursor_after_rect(rect);
    ui.interact(rect, steady_id(ui, name), sense)
}

/// Allocates room of exactly this size for the widget with this name.
pub fn allocate_size(ui: &mut Ui, size: Vec2, name: &str, sense: Sense) -> (Rect, Response) {
    let (_, room) = ui.allocate_space(size);
    let response = ui.interact(room, steady_id(ui, name), sense);
    (Align2::CENTER_CENTER.align_size_within_rect(size, room), response)
}

#[cfg(test)]
mod tests {
    use egui::{Event, Pos2, Role, Ui};
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable;

    use crate::gui::widgets::slider::{Scale, slider};
    use crate::gui::widgets::{Emphasis, button, number_field, theme};
    use crate::language::Language;

    /// What a user has done to widgets below a line that comes and goes.
    #[derive(Default)]
    struct Below {
        has_line: bool,
        presses: u32,
        number: u32,
        share: f64,
    }

    fn show(ui: &mut Ui, state: &mut Below) {
        theme::install(ui.ctx());
        if state.has_line {
            ui.label("Saved to a.png");
        }
        ui.horizontal(|ui| {
            if button(ui, None, "Press", true, Emphasis::Quiet).clicked() {
                state.presses += 1;
            }
            number_field(ui, &mut state.number, 0..=1000, "", 80.0, ("Number", Language::English));
            slider(ui, &mut state.share, Scale::Whole(0.0, 100.0), 200.0, egui::Color32::RED, "Share");
        });
    }

    fn window() -> Harness<'static, Below> {
        let mut window = Harness::new_ui_state(show, Below { has_line: true, ..Below::default() });
        window.run_steps(3);
        window
    }

    fn press(at: Pos2, pressed: bool) -> Event {
        let button = egui::PointerButton::Primary;
        Event::PointerButton { pos: at, button, pressed, modifiers: egui::Modifiers::NONE }
    }

    #[test]
    fn press_counts_when_a_line_above_goes_before_the_release() {
        let mut window = window();
        let at = window.get_by_label("Press").rect().center();
        for event in [Event::PointerMoved(at), press(at, true)] {
            window.event(event);
            window.step();
        }
        window.state_mut().has_line = false;
        window.step();
        window.event(press(at, false));
        window.run_steps(2);
        assert_eq!(window.state().presses, 1);
    }

    #[test]
    fn number_is_typed_on_when_a_line_above_goes() {
        let mut window = window();
        window.get_by_role_and_label(Role::SpinButton, "Number").click();
        window.run_steps(3);
        window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
        for digit in ["5", "2", "1"] {
            window.event(Event::Text(digit.into()));
            window.step();
            window.state_mut().has_line ^= true;
            window.step();
        }
        window.key_press(egui::Key::Enter);
        window.run_steps(3);
        assert_eq!(window.state().number, 521);
    }

    #[test]
    fn drag_goes_on_when_a_line_above_comes() {
        let mut window = window();
        let bar = window.get_by_label("Share").rect();
        let place = |share: f32| egui::pos2(bar.left() + bar.width() * share, bar.center().y);
        window.drag_at(place(0.2));
        window.step();
        window.state_mut().has_line = false;
        window.step();
        window.drop_at(place(0.75));
        window.run_steps(3);
        assert!((window.state().share - 75.0).abs() < 5.0, "{}", window.state().share);
    }
}
