//! The architecture as a test: layers, circles, bans, languages, and the length of files and lines.

mod imports;
mod layers;
mod source;

use imports::Imports;
use layers::layers;
use source::{Module, SourceFile, files, shipped};

/// The longest file, in lines of code.
const MAX_CODE_LINES: usize = 400;

/// The longest line with a comment, in characters.
const MAX_COMMENT_COLUMNS: usize = 120;

/// The file at this path.
fn file<'a>(files: &'a [SourceFile], path: &str) -> &'a SourceFile {
    files.iter().find(|file| file.path == path).unwrap_or_else(|| panic!("{path} is missing"))
}

#[test]
fn modules_of_the_crate_name_only_modules_on_lower_layers() {
    let files = files(&["src"]);
    let layers = layers(&file(&files, "src/lib.rs").text);
    assert!(layers.len() > 10, "src/lib.rs lists the modules: {layers:?}");
    for SourceFile { path, code, .. } in &files {
        let inside = path.trim_start_matches("src/").trim_end_matches(".rs");
        let module = inside.split('/').next().unwrap_or_default();
        let Some(&layer) = layers.get(module) else {
            assert!(["lib", "main"].contains(&module), "{module} is not on a layer");
            continue;
        };
        for (at, root) in code.match_indices("crate::") {
            let rest = code[at + root.len()..].split(|c: char| !c.is_alphanumeric() && c != '_');
            let named = rest.take(1).collect::<String>();
            assert!(!named.is_empty(), "{path}: write one `use crate::module` a line");
            let below = layers.get(&named).unwrap_or_else(|| panic!("{path}: crate::{named}?"));
            let is_allowed = named == module || *below < layer;
            assert!(is_allowed, "{path}: {module} (layer {layer}) names {named} (layer {below})");
        }
    }
}

/// `src/view/mod.rs` and `src/gui/mod.rs` list their modules like `src/lib.rs`. Re-exports count as the file that
/// defines the item.
#[test]
fn modules_of_view_and_gui_import_only_from_lower_layers() {
    let files = files(&["src"]);
    let imports = Imports::new(&files);
    for parent in ["view", "gui"] {
        let layers = layers(&file(&files, &format!("src/{parent}/mod.rs")).text);
        assert!(layers.len() > 5, "src/{parent}/mod.rs lists its modules: {layers:?}");
        let is_inside = |module: &Module| module.first().is_some_and(|first| first == parent);
        let inside = imports.edges().filter(|(from, to)| is_inside(from) && is_inside(to));
        for (from, to) in inside {
            // The parent itself is no module of a layer.
            let [Some(one), Some(other)] = [from, to].map(|module| module.get(1)) else { continue };
            let [layer, below] = [one, other].map(|name| layers.get(name).expect("every module is on a layer"));
            let (path, imported) = (imports.path(from), imports.path(to));
            let is_allowed = one == other || below < layer;
            assert!(is_allowed, "{path}: {one} (layer {layer}) imports {imported} (layer {below})");
        }
    }
}

#[test]
fn files_do_not_import_each_other_in_a_circle() {
    let imports = Imports::new(&files(&["src"]));
    assert!(imports.edges().count() > 500, "the imports are found");
    if let Some(circle) = imports.circle() {
        panic!("these files import each other in a circle: {}", circle.join(" → "));
    }
}

#[test]
fn names_stay_in_their_modules() {
    let rules: [(&[&str], &[&str]); 4] = [
        (&["egui::", "eframe::"], &["src/gui/"]),
        (
            &["crossbeam_channel", "std::thread"],
            &["src/driver/", "src/gui/session/", "src/interrupt.rs", "src/parallel.rs"],
        ),
        (
            &["Instant::now", "ThreadTime"],
            &[
                "src/driver/",
                "src/gui/session/",
                "src/cli/",
                "src/study/methods/",
                "src/study/rivals.rs",
                "src/study/preview_time.rs",
            ],
        ),
        (&["glow::", "rfd::"], &["src/gui/"]),
    ];
    for SourceFile { path, code, .. } in files(&["src"]) {
        for (names, allowed) in rules {
            for name in names {
                let is_allowed = allowed.iter().any(|place| path.starts_with(place));
                assert!(is_allowed || !code.contains(name), "{path} names {name}; only {allowed:?} may");
            }
        }
    }
}

#[test]
fn sentences_of_the_window_are_in_both_languages() {
    let is_word = |word: &str| word.len() > 2 && word.chars().all(|letter| letter.is_ascii_lowercase());
    let files = files(&["src/view", "src/gui"]);
    for SourceFile { path, text, .. } in shipped(&files) {
        let text: Vec<_> = text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect();
        let text = text.join("\n");
        let shipped = text.split("mod tests {").next().unwrap_or_default();
        for (at, macro_name) in shipped.match_indices("format!(") {
            let literal = shipped[at + macro_name.len()..].trim_start().strip_prefix('"');
            let literal = literal.and_then(|rest| rest.split('"').next()).unwrap_or_default();
            let words: Vec<&str> = literal.split(' ').collect();
            let is_sentence = words.windows(2).any(|two| two.iter().all(|word| is_word(word)));
            assert!(!is_sentence, "{path}: write {literal:?} with `say!`");
        }
    }
}

#[test]
fn files_have_at_most_400_lines_of_code() {
    let (src, tests) = (files(&["src"]), files(&["tests", "benches"]));
    let code = shipped(&src).into_iter().map(|file| (&file.path, &file.shipped_code));
    for (path, code) in code.chain(tests.iter().map(|file| (&file.path, &file.code))) {
        let lines = code.lines().filter(|line| !line.trim().is_empty()).count();
        assert!(lines <= MAX_CODE_LINES, "{path} has {lines} lines of code: split it by its tasks");
    }
}

#[test]
fn lines_with_comments_have_at_most_120_columns() {
    let mut long = Vec::new();
    for SourceFile { path, text, code, .. } in files(&["src", "tests", "benches"]) {
        for (number, (line, code)) in (1..).zip(text.lines().zip(code.lines())) {
            let columns = line.chars().count();
            let has_comment = code.trim_end().chars().count() < line.trim_end().chars().count();
            if has_comment && columns > MAX_COMMENT_COLUMNS {
                long.push(format!("{path}:{number} has {columns}"));
            }
        }
    }
    assert!(long.is_empty(), "wrap these lines at {MAX_COMMENT_COLUMNS} columns: {long:#?}");
}
