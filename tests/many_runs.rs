//! Fifty runs after one another in one window leave no thread behind. In a file of its own, so that no other test's
//! threads are in the process.

use std::time::Duration;

use anel::gui::{App, Launch, Opening};
use egui::Key;
use egui::accesskit::Role;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;

/// Threads of nodes, parents and runs.
#[cfg(target_os = "linux")]
fn threads() -> Vec<String> {
    let tasks = std::fs::read_dir("/proc/self/task").expect("this process's threads");
    let names = tasks.filter_map(|task| std::fs::read_to_string(task.ok()?.path().join("comm")).ok());
    let names = names.map(|name| name.trim().to_owned());
    names.filter(|name| name.starts_with("node ") || ["parent", "run"].contains(&&**name)).collect()
}

#[cfg(not(target_os = "linux"))]
fn threads() -> Vec<String> {
    Vec::new()
}

fn until(window: &mut Harness<'_, App>, what: &str, come: impl Fn(&Harness<'_, App>) -> bool) {
    for _ in 0..3000 {
        window.step();
        if come(window) {
            return;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    panic!("{what} has not come; threads: {:?}", threads());
}

#[test]
fn fifty_restarts_and_thirty_two_nodes_made_one_leave_no_thread_behind() {
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
        // Some stand still when they are made to end.
        if round % 3 == 0 {
            window.key_press(Key::Space);
        }
        window.key_press(Key::R);
        window.step();
    }
    // Of the run that goes on: eight nodes, their parent, and who waits for them.
    until(&mut window, "the others' end", |window| {
        window.state().session().runs_ending() == 0 && (threads().len() == 10 || cfg!(not(target_os = "linux")))
    });
    drop(window);
    for _ in 0..1000 {
        if threads().is_empty() {
            return;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    panic!("left behind: {:?}", threads());
}
