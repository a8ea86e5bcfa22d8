//! The inspector: a click chooses a pixel, arrows move to its neighbours, rays are chosen, Esc closes.

use anel::language::Language;
use anel::view::Inspected;
use egui::{Key, Pos2};
use egui_kittest::kittest::Queryable;
use tempfile::TempDir;

use super::driving::*;

/// Clicks on the picture, at fractions of its width and height.
fn click(window: &mut Window, [x, y]: [f32; 2]) {
    let rect = window.get_by_label("Picture").rect();
    click_at(window, rect.lerp_inside(egui::vec2(x, y)));
}

fn click_at(window: &mut Window, at: Pos2) {
    window.drag_at(at);
    window.step();
    window.drop_at(at);
    window.run_steps(2);
    wait_for_pixel(window);
}

/// Waits until the pixel is traced and shown.
fn wait_for_pixel(window: &mut Window) {
    until(window, "the pixel", |window| !session(window).is_inspecting());
    window.run_steps(2);
}

fn inspected(window: &Window) -> &Inspected {
    session(window).inspected().expect("a pixel is inspected")
}

fn value(window: &Window, name: &str) -> String {
    window.get_by_label(name).value().unwrap_or_default()
}

#[test]
fn click_shows_the_pixel_arrows_move_and_esc_closes() {
    let language = Language::English;
    let mut window = open(SIZE);
    assert!(window.query_by_label("The ring").is_some());
    click(&mut window, [0.5, 0.5]);
    let size = session(&window).header().size;
    let [x, y] = session(&window).inspected_pixel().expect("a pixel is inspected");
    assert!(x.abs_diff(size.width() / 2) <= 1 && y.abs_diff(size.height() / 2) <= 1, "{x} {y}");
    assert!(window.query_by_label("The ring").is_none(), "the inspector replaces the ring");
    assert!(window.query_by_label(&format!("Pixel {x}, {y}")).is_some());
    let rays = inspected(&window).sentences(language).swap_remove(0);
    assert!(rays.starts_with("This pixel needed "));
    assert!(window.query_by_label(&rays).is_some(), "{rays}");
    assert_eq!(value(&window, "Terms of the equation"), inspected(&window).term_words(language));

    for (arrow, place) in [
        (Key::ArrowRight, [x + 1, y]),
        (Key::ArrowDown, [x + 1, y + 1]),
        (Key::ArrowLeft, [x, y + 1]),
        (Key::ArrowUp, [x, y]),
    ] {
        key(&mut window, arrow);
        wait_for_pixel(&mut window);
        assert_eq!((session(&window).inspected_pixel(), inspected(&window).pixel), (Some(place), place));
        assert!(window.query_by_label(&format!("Pixel {}, {}", place[0], place[1])).is_some());
    }
    key(&mut window, Key::Escape);
    assert!(session(&window).inspected_pixel().is_none() && window.query_by_label("The ring").is_some());
    assert_eq!(window.state().selection(), None, "the atom was selected with its pixel");
    key(&mut window, Key::ArrowRight);
    assert!(session(&window).inspected_pixel().is_none(), "arrows do not open the inspector");
}

#[test]
fn term_under_the_mouse_has_a_name() {
    let mut window = open(SIZE);
    click(&mut window, [0.5, 0.5]);
    wait_for_pixel(&mut window);
    let table = window.get_by_label("Terms of the equation").rect();
    window.hover_at(table.left_top() + egui::vec2(20.0, 36.0));
    until(&mut window, "a name", |window| window.query_by_label("Ka Ia: ambient").is_some());
}

#[test]
fn arrows_stop_at_the_edge_of_the_picture_and_the_button_closes() {
    let mut window = open(SIZE);
    click(&mut window, [0.0005, 0.0005]);
    assert_eq!(session(&window).inspected_pixel(), Some([0, 0]));
    key(&mut window, Key::ArrowLeft);
    key(&mut window, Key::ArrowUp);
    wait_for_pixel(&mut window);
    assert_eq!(inspected(&window).pixel, [0, 0]);
    press(&mut window, "Close inspector");
    assert!(session(&window).inspected().is_none());
}

#[test]
fn chosen_ray_has_its_own_terms_and_the_text_can_be_copied() {
    let language = Language::English;
    let mut window = open_with(SIZE, "glass");
    // A pixel of glass has several rays.
    let places = [[0.5, 0.5], [0.4, 0.6], [0.6, 0.6], [0.3, 0.5], [0.7, 0.5], [0.5, 0.7]];
    let found = places.into_iter().any(|place| {
        click(&mut window, place);
        inspected(&window).sample().rays.len() > 2
    });
    assert!(found, "no pixel has several rays");
    let (before, spans) = (value(&window, "Terms of the equation"), value(&window, "Spans along the ray"));
    let rays = inspected(&window).ray_tree(400.0, language).spots;
    let other = rays.iter().find(|spot| spot.ray == 2).expect("a third ray");
    press(&mut window, &other.name);
    wait_for_pixel(&mut window);
    assert_eq!(inspected(&window).chosen.ray, 2);
    assert_ne!((value(&window, "Terms of the equation"), value(&window, "Spans along the ray")), (before, spans));
    // The next pixel is shown with the same ray, if it has it.
    key(&mut window, Key::ArrowRight);
    wait_for_pixel(&mut window);
    let has_it = inspected(&window).sample().rays.len() > 2;
    assert_eq!(inspected(&window).chosen.ray, if has_it { 2 } else { 0 });
    window.get_by_label("Copy as text").click();
    window.step();
    let copied = window.output().platform_output.commands.iter().find_map(|command| match command {
        egui::OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    assert_eq!(copied, Some(inspected(&window).text(language)));
}

#[test]
fn drag_that_moves_nothing_says_how_the_camera_moves() {
    let mut window = open(SIZE);
    let drag = |window: &mut Window| {
        let centre = window.get_by_label("Picture").rect().center();
        window.drag_at(centre);
        window.step();
        window.hover_at(centre + egui::vec2(40.0, 10.0));
        window.run_steps(2);
        window.drop_at(centre + egui::vec2(40.0, 10.0));
        window.run_steps(2);
    };
    drag(&mut window);
    assert!(notice(&window).starts_with("A drag with the right button turns the camera"), "{}", notice(&window));
    press(&mut window, "Close notice");
    drag(&mut window);
    assert_eq!(notice(&window), "", "it is said once");
    assert!(!session(&window).is_camera_moved());
}

#[test]
fn recorded_run_can_be_inspected_and_a_drag_inspects_nothing() {
    let language = Language::English;
    let directory = TempDir::new().expect("a temporary directory");
    let path = directory.path().join("run.anel");
    let window = open(SIZE);
    session(&window).stage().log.save(&path).expect("it can be saved");
    let mut window = open_with(SIZE, path.to_str().expect("a plain path"));
    assert!(session(&window).is_recorded());
    let rect = window.get_by_label("Picture").rect();
    window.drag_at(rect.center());
    window.step();
    window.hover_at(rect.center() + egui::vec2(60.0, 0.0));
    window.step();
    window.drop_at(rect.center() + egui::vec2(60.0, 0.0));
    window.run_steps(2);
    assert!(session(&window).inspected_pixel().is_none(), "a drag is not a click");
    click(&mut window, [0.3, 0.7]);
    assert!(window.query_by_label("Tree of rays").is_some());
    // A restart keeps the pixel.
    let before = inspected(&window).text(language);
    key(&mut window, Key::R);
    wait_for_pixel(&mut window);
    assert_eq!(inspected(&window).text(language), before);
}
