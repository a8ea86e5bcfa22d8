//! The architecture as a test: floors, walls and the length of files.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Every `.rs` file under `directory`.
fn sources(directory: &str) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut directories = vec![PathBuf::from(directory)];
    while let Some(directory) = directories.pop() {
        for entry in fs::read_dir(&directory).expect("the directory is part of the project") {
            let path = entry.expect("a readable entry").path();
            if path.is_dir() {
                directories.push(path);
            } else if path.extension().is_some_and(|ending| ending == "rs") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

/// Each module's floor, as `src/lib.rs` lists them.
fn floors() -> BTreeMap<String, u32> {
    let mut floors = BTreeMap::new();
    let mut floor = None;
    for line in fs::read_to_string("src/lib.rs").expect("src/lib.rs").lines() {
        if let Some(rest) = line.strip_prefix("// Floor ") {
            let number = rest.split(':').next().and_then(|number| number.parse::<u32>().ok());
            floor = Some(number.expect("a floor's comment is `// Floor N: …`"));
        }
        if let Some(rest) = line.strip_prefix("pub mod ") {
            let name = rest.split(';').next().expect("a module ends with a semicolon");
            floors.insert(name.to_owned(), floor.expect("every module stands under a floor"));
        }
    }
    floors
}

/// The top-level module that a file belongs to.
fn module(path: &Path) -> String {
    let inside = path.strip_prefix("src").expect("a source file");
    let first = inside.components().next().expect("a file has a name").as_os_str().to_string_lossy();
    first.trim_end_matches(".rs").to_owned()
}

/// The text without its line comments.
fn code(path: &Path) -> String {
    let text = fs::read_to_string(path).expect("a readable file");
    text.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n")
}

#[test]
fn a_module_names_only_modules_on_lower_floors() {
    let floors = floors();
    assert!(floors.len() > 10, "src/lib.rs lists the modules: {floors:?}");
    for path in sources("src") {
        let module = module(&path);
        let Some(&floor) = floors.get(&module) else {
            assert!(["lib", "main"].contains(&&*module), "{module} stands on no floor");
            continue;
        };
        for (at, _) in code(&path).match_indices("crate::") {
            let code = code(&path);
            let named: String = code[at + 7..].chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            assert!(!named.is_empty(), "{}: write one `use crate::module` a line", path.display());
            let below = floors.get(&named).unwrap_or_else(|| panic!("{}: crate::{named}?", path.display()));
            let allowed = named == module || *below < floor;
            assert!(allowed, "{}: {module} (floor {floor}) names {named} (floor {below})", path.display());
        }
    }
}

#[test]
fn walls_stand() {
    let walls: [(&[&str], &[&str]); 4] = [
        (&["egui::", "eframe::"], &["src/gui/"]),
        (&["crossbeam_channel", "std::thread"], &["src/driver/", "src/gui/session/"]),
        (
            &["Instant::now", "ThreadTime"],
            &["src/driver/", "src/gui/session/", "src/cli/", "src/study/rivals.rs", "src/study/preview_time.rs"],
        ),
        (&["glow::", "rfd::"], &["src/gui/"]),
    ];
    for path in sources("src") {
        let code = code(&path);
        let path = path.to_string_lossy().replace('\\', "/");
        for (names, allowed) in walls {
            for name in names {
                let inside = allowed.iter().any(|place| path.starts_with(place));
                assert!(inside || !code.contains(name), "{path} names {name}; only {allowed:?} may");
            }
        }
    }
}

#[test]
fn what_the_window_says_is_said_in_both_languages() {
    let is_word = |word: &str| word.len() > 2 && word.chars().all(|letter| letter.is_ascii_lowercase());
    for path in sources("src/view").into_iter().chain(sources("src/gui")) {
        let code = code(&path);
        let code = code.split("mod tests {").next().unwrap_or_default();
        for (at, macro_name) in code.match_indices("format!(") {
            let literal = code[at + macro_name.len()..].trim_start().strip_prefix('"');
            let literal = literal.and_then(|rest| rest.split('"').next()).unwrap_or_default();
            let words: Vec<&str> = literal.split(' ').collect();
            let is_sentence = words.windows(2).any(|two| two.iter().all(|word| is_word(word)));
            assert!(!is_sentence, "{}: {literal:?} is to be told with `say!`", path.display());
        }
    }
}

#[test]
fn no_file_is_longer_than_400_lines() {
    for path in sources("src").into_iter().chain(sources("tests")) {
        let lines = fs::read_to_string(&path).expect("a readable file").lines().count();
        assert!(lines <= 400, "{} has {lines} lines: split it by what it does", path.display());
    }
}
