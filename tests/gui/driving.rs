//! Helpers that open and drive a window.

use std::path::Path;
use std::time::Duration;

use anel::gui::{App, Launch, Opening, Session};
use anel::record::RecordKind;
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

pub type Window = Harness<'static, App>;

pub const SIZE: [f32; 2] = [1280.0, 800.0];

/// The text that a window has stored.
#[derive(Clone, Default)]
pub struct Storage(pub Option<String>);

impl eframe::Storage for Storage {
    fn get_string(&self, _key: &str) -> Option<String> {
        self.0.clone()
    }

    fn set_string(&mut self, _key: &str, value: String) {
        self.0 = Some(value);
    }

    fn remove_string(&mut self, _key: &str) {}

    fn flush(&mut self) {}
}

/// Opens a window of this size with the demonstration and waits until its run has started.
pub fn open(size: [f32; 2]) -> Window {
    open_with(size, "ten-objects")
}

/// Opens a window with a scene or a run file and waits until its run has started.
pub fn open_with(size: [f32; 2], argument: &str) -> Window {
    let launch = Launch { opening: Some(Opening::read(argument).expect("it can be read")), ..Launch::default() };
    launch_with(size, &Storage::default(), launch)
}

/// Opens a window that restores this storage and waits until its run has started.
pub fn launch_with(size: [f32; 2], storage: &Storage, launch: Launch) -> Window {
    let build = |creation: &mut eframe::CreationContext<'static>| App::new(&creation.egui_ctx, Some(storage), launch);
    let mut window = Harness::builder().with_size(size).build_eframe(build);
    until(&mut window, "a run", |window| session(window).loading().is_none() && now(window) > 0);
    resize(&mut window, size);
    window
}

/// Gives the window a size in pixels, and waits until its zoom has followed. The harness counts in points, which a zoom
/// makes larger.
pub fn resize(window: &mut Window, size: [f32; 2]) {
    for _ in 0..3 {
        let zoom = window.ctx.zoom_factor();
        window.set_size(egui::Vec2::from(size) / zoom);
        window.run_steps(2);
    }
}

/// Steps the app until `condition` is true.
///
/// # Panics
/// If that takes longer than two minutes.
pub fn until(window: &mut Window, what: &str, condition: impl Fn(&Window) -> bool) {
    for _ in 0..6_000 {
        window.step();
        if condition(window) {
            return;
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    panic!(
        "timeout after two minutes: {what}; the notice is {:?}, the settings are {:?}",
        notice(window),
        session(window).settings()
    );
}

pub fn session(window: &Window) -> &Session {
    window.state().session()
}

/// The run's clock, in nanoseconds.
pub fn now(window: &Window) -> u64 {
    session(window).now().0
}

/// The number of traced atoms.
pub fn done(window: &Window) -> u32 {
    session(window).stage().state().done()
}

/// The values that `of` finds in the records.
pub fn recorded<T>(window: &Window, of: impl Fn(&RecordKind) -> Option<T>) -> Vec<T> {
    session(window).stage().log.records().iter().filter_map(|record| of(&record.kind)).collect()
}

pub fn speeds_set(window: &Window) -> Vec<(u16, f64)> {
    recorded(window, |what| if let RecordKind::SpeedSet { node, speed } = what { Some((*node, *speed)) } else { None })
}

/// The text of the notice.
pub fn notice(window: &Window) -> String {
    session(window).notice().map(|notice| notice.text.clone()).unwrap_or_default()
}

/// Presses the button with this name.
pub fn press(window: &mut Window, name: &str) {
    // A floating area has its position only from its second frame on.
    window.run_steps(2);
    window.get_by_role_and_label(Role::Button, name).click();
    window.run_steps(3);
}

/// Chooses an entry of the list with this name.
pub fn choose(window: &mut Window, list: &str, name: &str) {
    window.run_steps(2);
    window.get_by_role_and_label(Role::ComboBox, list).click();
    window.run_steps(3);
    press(window, name);
}

/// Presses *Virtual* and waits until the picture is traced and the run in virtual time has begun.
pub fn switch_to_virtual_time(window: &mut Window) {
    press(window, "Virtual");
    until(window, "virtual time", |window| session(window).header().driver == anel::runlog::Driver::Sim);
}

/// Presses a key.
pub fn key(window: &mut Window, key: Key) {
    window.key_press(key);
    window.run_steps(3);
}

/// Presses Esc, once more if a text field has the focus: the first Esc leaves the field.
pub fn escape(window: &mut Window) {
    if window.ctx.text_edit_focused() {
        key(window, Key::Escape);
    }
    key(window, Key::Escape);
}

/// Presses a key together with Ctrl.
pub fn ctrl(window: &mut Window, key: Key) {
    window.key_press_modifiers(Modifiers::COMMAND, key);
    window.run_steps(3);
}

/// Types a number into the field with this name, and Enter.
pub fn type_number(window: &mut Window, name: &str, text: &str) {
    window.get_by_role_and_label(Role::SpinButton, name).click();
    window.run_steps(3);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.step();
    window.event(Event::Text(text.into()));
    window.step();
    window.key_press(Key::Enter);
    window.run_steps(4);
}

/// Replaces the text of a field, which has the focus.
pub fn type_path(window: &mut Window, field: &str, path: &Path) {
    let path = path.to_str().expect("a plain path");
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.step();
    window.get_by_label(field).type_text(path);
    window.run_steps(2);
    assert_eq!(window.get_by_label(field).value().as_deref(), Some(path));
}

/// Drags the slider with this name to a fraction of its width, and releases it.
pub fn drag(window: &mut Window, name: &str, to: f32) {
    let rect = window.get_by_role_and_label(Role::Slider, name).rect();
    let radius = rect.height() / 2.5;
    let x = rect.left() + radius + (rect.width() - 2.0 * radius) * to;
    window.drag_at(egui::pos2(x, rect.center().y));
    window.step();
    window.drop_at(egui::pos2(x, rect.center().y));
    window.run_steps(3);
}

/// Drags the slider of a machine's speed to this per cent, and returns where it is, in points.
pub fn drag_speed(window: &mut Window, machine: usize, percent: u32) -> f32 {
    // The scale is logarithmic; its left end is 0 and stands for 0.4.
    let share = (f64::from(percent) / 0.4).ln() / 250.0_f64.ln();
    let name = format!("Speed of machine {machine}");
    drag(window, &name, share as f32);
    window.get_by_role_and_label(Role::Slider, &name).rect().width() * share as f32
}

/// Turns the wheel up by this number of lines.
pub fn wheel(window: &mut Window, lines: f32) {
    window.event(Event::MouseWheel {
        unit: egui::MouseWheelUnit::Line,
        delta: egui::vec2(0.0, lines),
        source: egui::MouseWheelSource::Wheel,
        phase: egui::TouchPhase::Move,
        modifiers: Modifiers::NONE,
    });
    window.run_steps(2);
}

/// The time until the next repaint.
pub fn repaint_delay(window: &Window) -> Duration {
    window.output().viewport_output[&egui::ViewportId::ROOT].repaint_delay
}
