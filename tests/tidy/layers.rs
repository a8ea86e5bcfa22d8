//! The layers of modules, as the comments `// Layer N: …` of a module's file list them.

use std::collections::BTreeMap;

/// The layer of each module that the text declares; modules for tests have none.
///
/// # Panics
/// If a module comes before the first layer, or a layer has no number.
pub fn layers(text: &str) -> BTreeMap<String, u32> {
    let mut layers = BTreeMap::new();
    let (mut layer, mut is_for_tests) = (None, false);
    for line in text.lines() {
        if let Some(rest) = line.strip_prefix("// Layer ") {
            let number = rest.split(':').next().and_then(|number| number.parse::<u32>().ok());
            layer = Some(number.expect("the comment of a layer is `// Layer N: …`"));
        }
        if let Some((_, name)) = line.split_once("mod ").filter(|(before, _)| ["", "pub "].contains(before)) {
            let name = name.split([';', ' ']).next().unwrap_or_default();
            if !is_for_tests {
                layers.insert(name.to_owned(), layer.unwrap_or_else(|| panic!("{name} is not on a layer")));
            }
        }
        is_for_tests = line == "#[cfg(test)]";
    }
    layers
}

#[test]
fn layers_are_read_from_comments() {
    let text = "//! Doc.\n\n// Layer 0: words.\npub mod font; // a comment\nmod time;\n\n// Layer 12: the rest.\nmod view;\n\
                #[cfg(test)]\nmod tests;\n";
    let expected = [("font", 0), ("time", 0), ("view", 12)].map(|(name, layer)| (name.to_owned(), layer));
    assert_eq!(layers(text), BTreeMap::from(expected));
}
