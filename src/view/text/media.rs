//! A note on solids that light does not see as their author may have meant.

use crate::language::{Language, say};
use crate::scene::{Scene, objects_of_several_media};

/// Says which objects of a scene are unions of several media, and what that means; `None` if there are none.
pub fn note_on_media(scene: &Scene, language: Language) -> Option<String> {
    let objects = objects_of_several_media(scene);
    let (first, more) = (objects.first()?, objects.len() - 1);
    let others = match more {
        0 => String::new(),
        1 => say!(language, " (and 1 more)", " (e mais 1)"),
        _ => say!(language, " (and {more} more)", " (e mais {more})"),
    };
    Some(say!(
        language,
        "Object {first}{others} joins materials that refract light differently or stop it. They count as solids of their \
         own; where they overlap, the first one fills the space",
        "O objeto {first}{others} une materiais que refratam a luz de modo diferente ou a barram. Contam como sólidos \
         próprios; onde se sobrepõem, a primeira preenche o espaço"
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn note_names_the_first_object_of_several_media() {
        let scene = |objects: &str| {
            let text = format!(
                r#"(camera: (eye: (0, 0, 5), look_at: (0, 0, 0)), objects: [{objects}],
                materials: {{"glass": (kt: 0.9, ior: 1.5), "crystal": (kt: 0.8, ior: 1.5), "red": ()}})"#
            );
            Scene::parse(&text).unwrap()
        };
        let ball = |material: &str| format!(r#"Sphere(radius: 1, material: "{material}")"#);
        let union = |materials: [&str; 2]| format!("Union(of: [{}, {}])", ball(materials[0]), ball(materials[1]));
        let mixed = union(["glass", "red"]);
        let plain = [ball("glass"), union(["glass", "crystal"]), union(["red", "red"])].join(", ");
        assert_eq!(note_on_media(&scene(&plain), Language::English), None);
        let note = note_on_media(&scene(&format!("{plain}, {mixed}, {mixed}")), Language::English);
        assert!(note.is_some_and(|note| note.starts_with("Object 4 (and 1 more) joins ")));
    }
}
