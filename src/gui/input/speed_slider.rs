//! Slider of a machine's speed, which the wheel and the arrow keys move by steps.

use egui::{Key, Response, Ui};

use crate::balance::NodeId;
use crate::gui::session::Session;
use crate::gui::settings::speed_steps::next_speed;
use crate::gui::settings::undo::Gesture;
use crate::gui::widgets::slider::{Scale, slider, wheel_steps};
use crate::gui::widgets::{hint_above, theme};
use crate::language::{Language, say, word};
use crate::view::{fraction, node_name};

/// Shows the slider. Where rows scroll, the wheel does not change a speed.
pub fn show(ui: &mut Ui, node: NodeId, width: f32, session: &mut Session, takes_wheel: bool) {
    let language = session.language();
    let colour = theme::colour(session.stage().colours[usize::from(node)]);
    let (before, name) = (session.speed(node), node_name(node));
    let name = say!(language, "Speed of machine {name}", "Velocidade da máquina {name}");
    let mut percent = (before * 100.0).round();
    let is_recorded = session.is_recorded();
    let shown = percent;
    let bar = |ui: &mut Ui| slider(ui, &mut percent, Scale::Percent, width, colour, &name);
    let response = ui.add_enabled_ui(!is_recorded, bar).inner;
    let steps = if is_recorded { 0 } else { steps(ui, &response, takes_wheel) };
    if steps != 0 {
        let speed = (0..steps.abs()).fold(before, |speed, _| next_speed(speed, steps > 0));
        session.change(Gesture::Speed(node), |settings| settings.set_speed(node, speed));
    } else if percent != shown {
        session.change(Gesture::Speed(node), |settings| settings.set_speed(node, percent / 100.0));
    }
    hint_above(response, &hint(&name, before, is_recorded, language));
}

/// Returns by how many steps wheel and arrow keys raise the speed; negative if they lower it.
fn steps(ui: &Ui, slider: &Response, takes_wheel: bool) -> i32 {
    let keys = |up, down| ui.input(|input| input.num_presses(up) as i32 - input.num_presses(down) as i32);
    let by_keys = if slider.has_focus() { keys(Key::ArrowRight, Key::ArrowLeft) } else { 0 };
    by_keys + if takes_wheel { wheel_steps(ui, slider) } else { 0 }
}

/// Returns what the slider sets, or why it cannot be moved.
fn hint(name: &str, speed: f64, is_recorded: bool, language: Language) -> String {
    if is_recorded {
        return recorded_hint(language).to_owned();
    }
    let speed = fraction(speed);
    say!(language, "{name}: {speed}. Drag, wheel or arrows", "{name}: {speed}. Arraste, roda ou setas")
}

/// Says why the controls of a recorded run are disabled.
pub fn recorded_hint(language: Language) -> &'static str {
    word!(
        language,
        "A recorded run cannot be changed. Set up, Make it live",
        "Uma execução gravada não pode ser mudada. Ajustar, Executar ao vivo"
    )
}
