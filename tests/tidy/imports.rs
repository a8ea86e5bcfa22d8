//! The imports between the files of `src`, and circles among them.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use crate::source::{Module, SourceFile, shipped};

/// For each module the modules that define its imports.
pub struct Imports {
    paths: BTreeMap<Module, String>,
    imported: BTreeMap<Module, BTreeSet<Module>>,
}

/// The imports and re-exports of one file, as paths from the crate's root.
#[derive(Default)]
struct Named {
    uses: Vec<Module>,
    /// By the name under which the file re-exports it.
    reexports: BTreeMap<String, Module>,
}

impl Imports {
    /// Reads the `use` declarations and the paths that begin with `crate`, `self` or `super`; test code does not count.
    ///
    /// # Panics
    /// If an inline module is not test code: each module has a file of its own.
    pub fn new(files: &[SourceFile]) -> Self {
        let files: Vec<_> = shipped(files).into_iter().filter(|file| file.path != "src/main.rs").collect();
        let paths: BTreeMap<_, _> = files.iter().map(|file| (file.module(), file.path.clone())).collect();
        let named: BTreeMap<_, _> = files.iter().map(|file| (file.module(), names(file))).collect();
        let definitions = |module: &Module| named[module].uses.iter().map(|path| definition(path, &named)).collect();
        let imported = paths.keys().map(|module| (module.clone(), definitions(module))).collect();
        Self { paths, imported }
    }

    /// Every import from one file to another.
    pub fn edges(&self) -> impl Iterator<Item = (&Module, &Module)> {
        let edges = self.imported.iter().flat_map(|(from, to)| to.iter().map(move |to| (from, to)));
        edges.filter(|(from, to)| from != to)
    }

    pub fn path(&self, module: &Module) -> &str {
        &self.paths[module]
    }

    /// The files of a shortest circle, the first one also at the end. A module and its descendants are no circle.
    pub fn circle(&self) -> Option<Vec<&str>> {
        let mut next: BTreeMap<&Module, Vec<&Module>> = BTreeMap::new();
        for (from, to) in self.edges().filter(|(from, to)| !from.starts_with(to) && !to.starts_with(from)) {
            next.entry(from).or_default().push(to);
        }
        let circles = next.keys().filter_map(|start| way_back(start, &next));
        let shortest = circles.min_by_key(Vec::len)?;
        Some(shortest.into_iter().map(|module| self.path(module)).collect())
    }
}

/// The shortest way from a module back to itself.
fn way_back<'a>(start: &'a Module, next: &BTreeMap<&'a Module, Vec<&'a Module>>) -> Option<Vec<&'a Module>> {
    let mut from: BTreeMap<&Module, &Module> = BTreeMap::new();
    let mut queue = VecDeque::from([start]);
    while let Some(module) = queue.pop_front() {
        for &to in next.get(module).into_iter().flatten() {
            if !from.contains_key(to) {
                from.insert(to, module);
                queue.push_back(to);
            }
        }
    }
    let mut way = vec![start, from.get(start)?];
    while way[way.len() - 1] != start {
        way.push(from[way[way.len() - 1]]);
    }
    way.reverse();
    Some(way)
}

/// The module that defines the item at this path, behind all re-exports.
fn definition(path: &[String], named: &BTreeMap<Module, Named>) -> Module {
    let is_module = |length: &usize| named.contains_key(&path[..*length]);
    let length = (0..=path.len()).rev().find(is_module).expect("the root is a module");
    let (module, item) = path.split_at(length);
    match item.split_first() {
        Some((name, rest)) if named[module].reexports.contains_key(name) => {
            definition(&[&named[module].reexports[name][..], rest].concat(), named)
        }
        _ => module.to_vec(),
    }
}

/// Reads the paths in a file.
fn names(file: &SourceFile) -> Named {
    let (module, tokens) = (file.module(), tokens(&file.shipped_code));
    let child = |pair: &[&str]| (pair[0] == "mod").then(|| pair[1].to_owned());
    let children: BTreeSet<String> = tokens.windows(2).filter_map(child).collect();
    let mut named = Named::default();
    let mut at = 0;
    while at < tokens.len() {
        assert!(tokens[at] != "mod" || tokens[at + 2] == ";", "{}: mod {} is inline", file.path, tokens[at + 1]);
        if tokens[at] == "use" {
            // `pub use` or `pub(crate) use`
            let is_reexport = at > 0 && ["pub", ")"].contains(&tokens[at - 1]);
            let end = at + tokens[at..].iter().position(|&token| token == ";").expect("the end of a `use`");
            for (path, name) in leaves(&tokens[at + 1..end]) {
                match absolute(&path, &module, &children) {
                    Some(path) if is_reexport => _ = named.reexports.insert(name, path),
                    Some(path) => named.uses.push(path),
                    None => {}
                }
            }
            at = end;
        } else if ["crate", "self", "super"].contains(&tokens[at]) {
            let mut path = vec![tokens[at]];
            while tokens.get(at + 1) == Some(&"::") && tokens.get(at + 2).is_some_and(|next| is_name(next)) {
                at += 2;
                path.push(tokens[at]);
            }
            if path.len() > 1 {
                named.uses.extend(absolute(&path, &module, &BTreeSet::new()));
            }
        }
        at += 1;
    }
    named
}

/// The paths of a tree such as `a::{b, c as d}`, each with the name that it gets.
fn leaves<'a>(tree: &[&'a str]) -> Vec<(Vec<&'a str>, String)> {
    let Some(open) = tree.iter().position(|&token| token == "{") else {
        let end = tree.iter().position(|&token| token == "as").unwrap_or(tree.len());
        let path: Vec<_> = tree[..end].iter().copied().filter(|&token| token != "::").collect();
        return vec![(path, tree.last().map_or(String::new(), |&name| name.to_owned()))];
    };
    let head = tree[..open].iter().copied().filter(|&token| token != "::");
    let mut depth = 0;
    let branches = tree[open + 1..tree.len() - 1].split(|&token| {
        depth += i32::from(token == "{") - i32::from(token == "}");
        depth == 0 && token == ","
    });
    let leaves = branches.filter(|branch| !branch.is_empty()).flat_map(leaves);
    leaves.map(|(path, name)| (head.clone().chain(path).collect(), name)).collect()
}

/// The path from the crate's root; `None` if it leads to another crate.
fn absolute(path: &[&str], module: &Module, children: &BTreeSet<String>) -> Option<Module> {
    let supers = path.iter().take_while(|&&segment| segment == "super").count();
    let (base, rest) = match path[0] {
        "crate" => (&[][..], &path[1..]),
        "self" => (&module[..], &path[1..]),
        "super" => (&module[..module.len() - supers], &path[supers..]),
        child if children.contains(child) => (&module[..], path),
        _ => return None,
    };
    // `a::{self}` is `a`.
    Some(
        base.iter()
            .map(String::as_str)
            .chain(rest.iter().copied().filter(|&last| last != "self"))
            .map(str::to_owned)
            .collect(),
    )
}

/// Names, `::` and single characters.
fn tokens(code: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = code.trim_start();
    while let Some(first) = rest.chars().next() {
        let name = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        let length = if rest.starts_with("::") { 2 } else { name.max(first.len_utf8()) };
        tokens.push(&rest[..length]);
        rest = rest[length..].trim_start();
    }
    tokens
}

fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

#[cfg(test)]
mod tests {
    use super::*;

    fn circle(files: &[(&str, &str)]) -> Option<String> {
        let files: Vec<_> = files.iter().map(|(path, text)| SourceFile::new(path, text)).collect();
        Imports::new(&files).circle().map(|circle| circle.join(" → "))
    }

    #[test]
    fn circle_of_three_files_is_found() {
        let files = [
            ("src/lib.rs", "mod a; mod b; mod c; mod d;"),
            ("src/a.rs", "use crate::b::{B, Other as O};\nuse std::fmt;"),
            ("src/b.rs", "fn b() -> super::c::C { todo!() }"),
            ("src/c.rs", "use crate::{d::D, a};\nuse serde::{a::A};"),
            ("src/d.rs", "// use crate::a;\nconst D: &str = \"crate::c::C\";"),
        ];
        assert_eq!(circle(&files).as_deref(), Some("src/a.rs → src/b.rs → src/c.rs → src/a.rs"));
        let without_the_last_import = files.map(|(path, text)| (path, text.replace(", a}", "}")));
        let files = without_the_last_import.each_ref().map(|(path, text)| (*path, &**text));
        assert_eq!(circle(&files), None);
    }

    #[test]
    fn reexport_counts_as_the_file_that_defines_the_item() {
        let files = [
            ("src/lib.rs", "mod shapes; mod user;"),
            ("src/shapes/mod.rs", "mod ball; mod cube;\npub use ball::Ball;\npub(crate) use self::cube::Cube as Box;"),
            ("src/shapes/ball.rs", "use super::Box;"),
            ("src/shapes/cube.rs", "use crate::user::User;"),
            ("src/user.rs", "use crate::shapes::Ball;"),
        ];
        let expected = "src/shapes/ball.rs → src/shapes/cube.rs → src/user.rs → src/shapes/ball.rs";
        assert_eq!(circle(&files).as_deref(), Some(expected));
        let imports = Imports::new(&files.map(|(path, text)| SourceFile::new(path, text)));
        let of_the_user: Vec<_> = imports.edges().filter(|(from, _)| imports.path(from) == "src/user.rs").collect();
        assert_eq!(of_the_user.iter().map(|(_, to)| imports.path(to)).collect::<Vec<_>>(), ["src/shapes/ball.rs"]);
    }

    #[test]
    fn parent_and_children_are_no_circle() {
        let files = [
            ("src/lib.rs", "pub mod a;"),
            ("src/a/mod.rs", "mod b;\nuse b::B;\nuse crate::a::b::c::C;\npub struct A;"),
            ("src/a/b/mod.rs", "pub mod c;\nuse super::A;\npub struct B;"),
            ("src/a/b/c.rs", "use super::super::A;\nuse super::B;\npub struct C;"),
        ];
        assert_eq!(circle(&files), None);
        // Siblings are a circle, even if one is deeper.
        let files = [
            ("src/lib.rs", "pub mod a;"),
            ("src/a/mod.rs", "mod b; mod d;"),
            ("src/a/b/mod.rs", "mod c;"),
            ("src/a/b/c.rs", "use super::super::d::D;"),
            ("src/a/d.rs", "use super::b::c::C;"),
        ];
        assert_eq!(circle(&files).as_deref(), Some("src/a/b/c.rs → src/a/d.rs → src/a/b/c.rs"));
    }

    #[test]
    fn test_code_does_not_count() {
        let files = [
            ("src/lib.rs", "mod a; mod b; #[cfg(test)] mod tests;"),
            ("src/a.rs", "use crate::b::B;"),
            ("src/b.rs", "#[cfg(test)]\nmod tests {\n    use crate::a::A;\n}\n#[cfg(test)]\nuse crate::a;"),
            ("src/tests.rs", "use crate::a; fn helper() {}"),
        ];
        assert_eq!(circle(&files), None);
    }
}
