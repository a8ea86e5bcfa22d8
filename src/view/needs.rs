//! What a scene needs to be traced, in words.

use super::words::count;
use crate::tracer::Compiled;

/// What a scene needs, line by line: what, and how much of it. `levels` are the rays of each level of the trees of rays, as
/// [`crate::tracer::Tracer::levels`] counts them.
pub fn needs_lines(compiled: &Compiled, levels: &[u64]) -> Vec<(&'static str, String)> {
    let kinds: Vec<String> = compiled.primitives.iter().map(|(kind, number)| several(*number, kind)).collect();
    let kept: usize = compiled.primitives.values().sum();
    let mut lines = vec![
        ("Solids", several(compiled.solids, "solid")),
        ("Made of", if kinds.is_empty() { "nothing".into() } else { listed(&kinds) }),
        ("Kept", format!("{} of {} shapes that are written", number(kept), number(compiled.given.primitives))),
        (
            "Operations",
            format!("{} of {} that are written", number(compiled.operations), number(compiled.given.operations)),
        ),
        ("Lights", several(compiled.lights, "light")),
        ("Surfaces", surfaces(compiled).into()),
        ("Rays", levels_words(levels)),
    ];
    if compiled.unbounded > 0 {
        lines.push(("Endless", format!("{}, which every ray is tested against", several(compiled.unbounded, "solid"))));
    }
    lines
}

/// What of the scene is never seen, as a sentence for each; none if all is.
pub fn needs_warnings(compiled: &Compiled) -> Vec<String> {
    let tell = |number: usize, what: &str, why: &str| {
        let are = if number == 1 { "is" } else { "are" };
        (number > 0).then(|| format!("{} {are} {why}.", several(number, what)))
    };
    let parts = compiled.parts_dropped;
    [
        tell(compiled.dropped, "solid", "empty: nothing of it can be seen"),
        tell(parts.empty, "part", "empty, and left out"),
        tell(parts.out_of_reach, "part", "out of reach of what it would be taken from, and left out"),
    ]
    .into_iter()
    .flatten()
    .collect()
}

fn surfaces(compiled: &Compiled) -> &'static str {
    match (compiled.reflects, compiled.transmits) {
        (true, true) => "some mirror others, and light goes through some",
        (true, false) => "some mirror others; light goes through none",
        (false, true) => "light goes through some; none mirrors others",
        (false, false) => "none mirrors others, and light goes through none",
    }
}

/// How deep the trees of rays go.
fn levels_words(levels: &[u64]) -> String {
    let deep = match levels.len() {
        0 | 1 => return "1 level: a ray for each sample, and none after it".into(),
        deep => deep,
    };
    let all: u64 = levels.iter().sum();
    let after = (all - levels[0]) as f64 / levels[0].max(1) as f64;
    format!("{deep} levels are used; each first ray has {after:.1} more after it")
}

fn number(value: usize) -> String {
    count(u32::try_from(value).unwrap_or(u32::MAX))
}

fn several(value: usize, what: &str) -> String {
    let plural = match what {
        _ if value == 1 => what.to_owned(),
        "box along the axes" => "boxes along the axes".into(),
        "box" => "boxes".into(),
        "torus" => "tori".into(),
        _ => format!("{what}s"),
    };
    format!("{} {plural}", number(value))
}

fn listed(words: &[String]) -> String {
    match words {
        [others @ .., last] if !others.is_empty() => format!("{} and {last}", others.join(", ")),
        _ => words.concat(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::{Quality, Size};
    use crate::scene::Scene;
    use crate::tracer::Tracer;

    fn tracer(objects: &str) -> Tracer {
        let text = format!(
            "Scene(camera: (eye: (0, 0, 9), look_at: (0, 0, 0)), lights: [Directional(direction: (0, -1, 0))], \
             materials: {{\"mirror\": (ks: 0.5)}}, objects: [{objects}])"
        );
        Tracer::new(&Scene::parse(&text).unwrap(), Size::new(32, 24).unwrap(), Quality::default())
    }

    fn told(tracer: &Tracer) -> String {
        let lines = needs_lines(&tracer.compiled(), &tracer.levels());
        lines.into_iter().map(|(what, words)| format!("{what}: {words}\n")).collect()
    }

    #[test]
    fn a_scene_is_told_as_it_was_compiled() {
        let simple = told(&tracer("Sphere(radius: 1)"));
        for line in
            ["Made of: 1 ball\n", "Kept: 1 of 1 shapes", "Operations: 0 of 0", "Lights: 1 light\n", "Rays: 1 level:"]
        {
            assert!(simple.contains(line), "{line} is not in {simple}");
        }
        assert!(simple.contains("none mirrors others, and light goes through none") && !simple.contains("Endless"));
        let more = told(&tracer(
            "HalfSpace(normal: (0, 1, 0), offset: -1), \
             Difference(material: \"mirror\", of: [Box(min: (-1, -1, -1), max: (1, 1, 1)), Sphere(radius: 1.2)])",
        ));
        for line in
            ["1 box along the axes", "Operations: 1 of 1", "Endless: 1 solid, which", "some mirror others; light"]
        {
            assert!(more.contains(line), "{line} is not in {more}");
        }
        assert!(more.contains("levels are used"), "{more}");
    }

    #[test]
    fn however_unions_are_compiled_there_are_no_more_operations_than_are_written() {
        let ball = |i: i32| {
            format!("Sphere(radius: 0.2, centre: ({}, {}, 0))", 0.3 * f64::from(i % 7), 0.3 * f64::from(i / 7))
        };
        let balls = (0..40).map(ball).collect::<Vec<_>>().join(", ");
        let hall = "Box(min: (-5, -5, -5), max: (5, 5, 5))";
        for (solid, operations) in [
            (format!("Intersection(of: [{hall}, Union(of: [{balls}])])"), "2 of 2"),
            (format!("Difference(of: [{hall}, {balls}])"), "1 of 1"),
            (format!("Difference(of: [{hall}, Union(of: [{balls}])])"), "1 of 2"),
        ] {
            let told = told(&tracer(&solid));
            assert!(told.contains(&format!("Operations: {operations} that are written")), "{told}");
        }
    }

    #[test]
    fn what_cannot_be_seen_is_a_warning() {
        let seen = tracer("Sphere(radius: 1)");
        assert!(needs_warnings(&seen.compiled()).is_empty());
        let far = tracer("Difference(of: [Sphere(radius: 1), Sphere(radius: 1, centre: (9, 0, 0))])");
        let warnings = needs_warnings(&far.compiled());
        assert_eq!(warnings, ["1 part is out of reach of what it would be taken from, and left out."]);
        let empty =
            tracer("Sphere(radius: 1), Intersection(of: [Sphere(radius: 1), Sphere(radius: 1, centre: (9, 0, 0))])");
        let warnings = needs_warnings(&empty.compiled());
        assert!(warnings.iter().any(|warning| warning.starts_with("1 solid is empty")), "{warnings:?}");
    }

    #[test]
    fn several_have_their_plural() {
        let said = ["box", "torus", "ball", "box along the axes"].map(|kind| several(2000, kind));
        assert_eq!(
            said,
            ["2\u{a0}000 boxes", "2\u{a0}000 tori", "2\u{a0}000 balls", "2\u{a0}000 boxes along the axes"]
        );
        assert_eq!(listed(&["1 ball".into(), "2 boxes".into()]), "1 ball and 2 boxes");
    }
}
