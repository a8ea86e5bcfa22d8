//! Fifty runs in a row in one window leave no thread behind.

use std::time::Duration;

use anel::gui::{App, Launch, Opening};
use egui::Key;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

use crate::{threads, turn};

/// The names of the threads of nodes, parents and runs.
fn run_threads() -> Vec<String> {
    threads().into_iter().filter(|name| name.starts_with("node ") || ["parent", "run"].contains(&&**name)).collect()
}

fn until(window: &mut Harness<'_, App>, what: &str, condition: impl Fn(&Harness<'_, App>) -> bool) {
    for _ in 0..3000 {
        window.step();
        if condition(window) {
            return;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    panic!("timeout after half a minute: {what}; threads: {:?}", run_threads());
}

#[test]
fn restarts_and_changes_of_the_number_of_nodes_leave_no_thread_behind() {
    let _turn = turn();
    let launch = Launch { opening: Some(Opening::read("glass").expect("a built-in scene")), ..Launch::default() };
    let build = move |creation: &mut eframe::CreationContext<'static>| App::new(&creation.egui_ctx, None, launch);
    let mut window = Harness::builder().with_size([1280.0, 800.0]).build_eframe(build);
    until(&mut window, "a run", |window| window.state().session().now().0 > 0);
    window.key_press(Key::E);
    window.run_steps(3);
    for nodes in ["32", "1", "8"] {
        window.get_by_role_and_label(Role::SpinButton, "Number of machines").click();
        window.run_steps(2);
        window.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
        window.step();
        window.event(egui::Event::Text(nodes.into()));
        window.key_press(Key::Enter);
        window.run_steps(3);
        assert_eq!(window.state().session().header().speeds.len().to_string(), nodes);
    }
    for round in 0..50 {
        // Every third run is paused when it is replaced.
        if round % 3 == 0 {
            window.key_press(Key::Space);
        }
        window.key_press(Key::R);
        window.step();
    }
    // The threads of the current run: eight nodes, their parent, and the one that waits for them.
    until(&mut window, "the end of the earlier runs", |window| {
        window.state().session().runs_ending() == 0 && (run_threads().len() == 10 || cfg!(not(target_os = "linux")))
    });
    drop(window);
    for _ in 0..1000 {
        if run_threads().is_empty() {
            return;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    panic!("left behind: {:?}", run_threads());
}
