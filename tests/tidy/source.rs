//! Source files: their text without comments, literals and test code.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

/// The path of a module from the crate's root; the root itself is empty.
pub type Module = Vec<String>;

/// A file of Rust code.
pub struct SourceFile {
    /// The path, with `/`.
    pub path: String,
    pub text: String,
    /// The text without comments and without the contents of literals; lines keep their numbers and columns.
    pub code: String,
    /// `code` without items for tests; lines keep their numbers.
    pub shipped_code: String,
    /// The modules that are declared for tests only, and have files of their own.
    test_modules: Vec<String>,
}

impl SourceFile {
    pub fn new(path: &str, text: &str) -> Self {
        let code = without_comments_and_literals(text);
        let (shipped_code, test_modules) = without_tests(&code);
        Self { path: path.into(), text: text.into(), code, shipped_code, test_modules }
    }

    /// The module that a file of `src` defines.
    pub fn module(&self) -> Module {
        let inside = self.path.strip_prefix("src/").unwrap_or(&self.path).trim_end_matches(".rs");
        let mut module: Module = inside.split('/').map(str::to_owned).collect();
        if module.last().is_some_and(|last| ["mod", "lib", "main"].contains(&&**last)) {
            module.pop();
        }
        module
    }
}

/// Every Rust file under these directories, in the order of their paths.
pub fn files(directories: &[&str]) -> Vec<SourceFile> {
    let mut files = Vec::new();
    let mut directories: Vec<PathBuf> = directories.iter().map(PathBuf::from).collect();
    while let Some(directory) = directories.pop() {
        for entry in fs::read_dir(&directory).expect("the directory is part of the project") {
            let path = entry.expect("a readable entry").path();
            if path.is_dir() {
                directories.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = fs::read_to_string(&path).expect("a readable file");
                files.push(SourceFile::new(&path.to_string_lossy().replace('\\', "/"), &text));
            }
        }
    }
    files.sort_by(|a, b| a.path.cmp(&b.path));
    files
}

/// The files that are compiled without `cfg(test)`.
pub fn shipped(files: &[SourceFile]) -> Vec<&SourceFile> {
    let of = |file: &SourceFile| {
        let module = file.module();
        file.test_modules.iter().map(move |name| [&module[..], std::slice::from_ref(name)].concat()).collect::<Vec<_>>()
    };
    let test_modules: BTreeSet<Module> = files.iter().flat_map(of).collect();
    let is_test = |file: &SourceFile| {
        let module = file.module();
        (0..=module.len()).any(|length| test_modules.contains(&module[..length]))
    };
    files.iter().filter(|file| !is_test(file)).collect()
}

/// Removes comments, and replaces each character of a string or character literal by `_`.
fn without_comments_and_literals(text: &str) -> String {
    let mut code = String::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let (length, is_literal) = if rest.starts_with("//") {
            (rest.find('\n').unwrap_or(rest.len()), false)
        } else if rest.starts_with("/*") {
            (block_comment(rest), false)
        } else if let Some(length) = raw_string(rest) {
            (length, true)
        } else if first == '"' {
            (quoted(rest, '"'), true)
        } else if first == '\'' && is_character(rest) {
            (quoted(rest, '\''), true)
        } else {
            code.push(first);
            rest = &rest[first.len_utf8()..];
            continue;
        };
        let (skipped, remaining) = rest.split_at(length);
        code.extend(skipped.chars().filter(|&c| is_literal || c == '\n').map(|c| if c == '\n' { c } else { '_' }));
        rest = remaining;
    }
    code
}

/// The length of a block comment, which may hold others.
fn block_comment(text: &str) -> usize {
    let (mut at, mut depth) = (0, 0);
    loop {
        let rest = &text[at..];
        if rest.starts_with("/*") {
            (at, depth) = (at + 2, depth + 1);
        } else if rest.starts_with("*/") {
            (at, depth) = (at + 2, depth - 1);
        } else {
            at += rest.chars().next().map_or(0, char::len_utf8);
        }
        if depth == 0 || at == text.len() {
            return at;
        }
    }
}

/// The length of a raw string, if the text begins with one.
fn raw_string(text: &str) -> Option<usize> {
    let hashes = text.strip_prefix('r')?.chars().take_while(|&c| c == '#').count();
    let start = 1 + hashes + 1;
    let end = format!("\"{}", "#".repeat(hashes));
    text[1 + hashes..]
        .starts_with('"')
        .then(|| text[start..].find(&end).map_or(text.len(), |at| start + at + end.len()))
}

/// The length of a literal in these quotes, with its escapes.
fn quoted(text: &str, quote: char) -> usize {
    let mut chars = text.char_indices().skip(1);
    while let Some((at, c)) = chars.next() {
        match c {
            '\\' => _ = chars.next(),
            _ if c == quote => return at + 1,
            _ => {}
        }
    }
    text.len()
}

/// Whether an apostrophe begins a character literal, not a lifetime.
fn is_character(text: &str) -> bool {
    let mut chars = text.chars().skip(1);
    chars.next() == Some('\\') || chars.next() == Some('\'')
}

/// Blanks the items with `#[cfg(test)]`. Returns also the names of the modules among them that have files of their own.
fn without_tests(code: &str) -> (String, Vec<String>) {
    const ATTRIBUTE: &str = "#[cfg(test)]";
    let (mut shipped, mut modules) = (String::new(), Vec::new());
    let mut rest = code;
    while let Some((before, after)) = rest.split_once(ATTRIBUTE) {
        shipped += before;
        let (item, remaining) = after.split_at(item_length(after));
        if let Some((_, name)) = item.trim_end_matches(';').split_once("mod ").filter(|_| item.ends_with(';')) {
            modules.push(name.trim().to_owned());
        }
        shipped.extend(item.chars().filter(|&c| c == '\n'));
        rest = remaining;
    }
    (shipped + rest, modules)
}

/// The length of the first item, which ends with a semicolon or with the braces of its body.
fn item_length(code: &str) -> usize {
    let mut depth = 0;
    for (at, c) in code.char_indices() {
        match c {
            '(' | '[' | '{' => depth += 1,
            ')' | ']' | '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 && (c == ';' || c == '}') {
            return at + 1;
        }
    }
    code.len()
}

#[test]
fn comments_literals_and_tests_are_left_out() {
    let text = r##"
use crate::a; // crate::b
/* crate::c /* { */ */ const BRACES: [&str; 2] = ["{ \" crate::d", r#"" } "#];
fn quote<'a>(c: &'a char) -> bool { *c == '"' || *c == '\'' || *c == '{' }
#[cfg(test)]
mod tests {
    use crate::e;
}
fn last() {}
#[cfg(test)]
pub(crate) mod examples;
"##;
    let file = SourceFile::new("src/a/mod.rs", text);
    assert_eq!(file.module(), ["a"]);
    assert_eq!(file.code.lines().count(), text.lines().count());
    assert_eq!(file.shipped_code.lines().count(), text.lines().count());
    let left: Vec<_> =
        ["a", "b", "c", "d", "e"].into_iter().filter(|name| file.code.contains(&format!("crate::{name}"))).collect();
    assert_eq!(left, ["a", "e"]);
    assert!(!file.shipped_code.contains("tests") && file.shipped_code.contains("fn last() {}"));
    assert_eq!(file.code.matches('{').count(), file.code.matches('}').count());
    let files = [file, SourceFile::new("src/a/examples.rs", ""), SourceFile::new("src/a/b.rs", "")];
    let paths: Vec<_> = shipped(&files).iter().map(|file| file.path.clone()).collect();
    assert_eq!(paths, ["src/a/mod.rs", "src/a/b.rs"]);
}
