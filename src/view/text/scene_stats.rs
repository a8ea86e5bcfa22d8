//! What a scene needs to be traced, in words.

use super::format::{count, listed};
use crate::language::{Language, decimal, say, word};
use crate::tracer::SceneStats;

/// What a scene needs, line by line: what, and how much of it. `levels` are the rays of each level of the trees of rays, as
/// [`crate::tracer::Tracer::levels`] counts them.
pub fn needs_lines(compiled: &SceneStats, levels: &[u64], language: Language) -> Vec<(&'static str, String)> {
    let of_kind = |(kind, number): (&&'static str, &usize)| several(*number, shape_names(kind, language));
    let kinds: Vec<String> = compiled.primitives.iter().map(of_kind).collect();
    let kept: usize = compiled.primitives.values().sum();
    let [kept, shapes] = [kept, compiled.given.primitives].map(number);
    let [operations, given] = [compiled.operations, compiled.given.operations].map(number);
    let solids = word!(language, ["solid", "solids"], ["sólido", "sólidos"]);
    let nothing = || word!(language, "nothing", "nada").into();
    let mut lines = vec![
        (word!(language, "Solids", "Sólidos"), several(compiled.solids, solids)),
        (word!(language, "Made of", "Feitos de"), if kinds.is_empty() { nothing() } else { listed(&kinds, language) }),
        (
            word!(language, "Kept", "Restam"),
            say!(language, "{kept} of {shapes} shapes that are written", "{kept} de {shapes} formas escritas"),
        ),
        (
            word!(language, "Operations", "Operações"),
            say!(language, "{operations} of {given} that are written", "{operations} de {given} escritas"),
        ),
        (
            word!(language, "Lights", "Luzes"),
            several(compiled.lights, word!(language, ["light", "lights"], ["luz", "luzes"])),
        ),
        (word!(language, "Surfaces", "Superfícies"), surfaces(compiled, language).into()),
        (word!(language, "Rays", "Raios"), levels_words(levels, language)),
    ];
    if compiled.unbounded > 0 {
        let solids = several(compiled.unbounded, solids);
        let words = say!(language, "{solids}, which every ray is tested against", "{solids}, que todo raio testa");
        lines.push((word!(language, "Endless", "Sem fim"), words));
    }
    lines
}

/// What one shape of a kind is called, and what several are.
pub(crate) fn shape_names(kind: &'static str, language: Language) -> [&'static str; 2] {
    match kind {
        "ball" => word!(language, ["ball", "balls"], ["esfera", "esferas"]),
        "half-space" => word!(language, ["half-space", "half-spaces"], ["semiespaço", "semiespaços"]),
        "box along the axes" => {
            word!(
                language,
                ["box along the axes", "boxes along the axes"],
                ["caixa alinhada aos eixos", "caixas alinhadas aos eixos"]
            )
        }
        "ellipsoid" => word!(language, ["ellipsoid", "ellipsoids"], ["elipsoide", "elipsoides"]),
        "box" => word!(language, ["box", "boxes"], ["caixa", "caixas"]),
        "cylinder" => word!(language, ["cylinder", "cylinders"], ["cilindro", "cilindros"]),
        "cone" => word!(language, ["cone", "cones"], ["cone", "cones"]),
        "torus" => word!(language, ["torus", "tori"], ["toro", "toros"]),
        "quadric" => word!(language, ["quadric", "quadrics"], ["quádrica", "quádricas"]),
        _ => [kind; 2],
    }
}

/// What of the scene is never seen, as a sentence for each; none if all is.
pub fn needs_warnings(compiled: &SceneStats, language: Language) -> Vec<String> {
    let tell = |value: usize, words: [&str; 2]| (value > 0).then(|| format!("{}.", several(value, words)));
    let parts = compiled.parts_dropped;
    let dropped = word!(
        language,
        ["solid is empty: nothing of it can be seen", "solids are empty: nothing of it can be seen"],
        ["sólido é vazio: nada dele se vê", "sólidos são vazios: nada deles se vê"]
    );
    let empty = word!(
        language,
        ["part is empty, and left out", "parts are empty, and left out"],
        ["parte é vazia e foi omitida", "partes são vazias e foram omitidas"]
    );
    let out_of_reach = word!(
        language,
        [
            "part is out of reach of what it would be taken from, and left out",
            "parts are out of reach of what it would be taken from, and left out"
        ],
        [
            "parte está longe demais do que a perderia, e foi omitida",
            "partes estão longe demais do que as perderia, e foram omitidas"
        ]
    );
    [tell(compiled.dropped, dropped), tell(parts.empty, empty), tell(parts.out_of_reach, out_of_reach)]
        .into_iter()
        .flatten()
        .collect()
}

fn surfaces(compiled: &SceneStats, language: Language) -> &'static str {
    match (compiled.reflects, compiled.transmits) {
        (true, true) => {
            word!(
                language,
                "some mirror others, and light goes through some",
                "algumas espelham outras, e a luz atravessa algumas"
            )
        }
        (true, false) => {
            word!(
                language,
                "some mirror others; light goes through none",
                "algumas espelham outras; a luz não atravessa nenhuma"
            )
        }
        (false, true) => {
            word!(
                language,
                "light goes through some; none mirrors others",
                "a luz atravessa algumas; nenhuma espelha outras"
            )
        }
        (false, false) => {
            word!(
                language,
                "none mirrors others, and light goes through none",
                "nenhuma espelha outras, e a luz não atravessa nenhuma"
            )
        }
    }
}

/// How deep the trees of rays go.
fn levels_words(levels: &[u64], language: Language) -> String {
    let deep = match levels.len() {
        0 | 1 => {
            return word!(
                language,
                "1 level: a ray for each sample, and none after it",
                "1 nível: um raio por amostra, e nenhum depois dele"
            )
            .into();
        }
        deep => deep,
    };
    let all: u64 = levels.iter().sum();
    let after = decimal(language, (all - levels[0]) as f64 / levels[0].max(1) as f64, 1);
    say!(
        language,
        "{deep} levels are used; each first ray has {after} more after it",
        "{deep} níveis são usados; cada primeiro raio tem mais {after} depois dele"
    )
}

fn number(value: usize) -> String {
    count(value as u64)
}

fn several(value: usize, [one, many]: [&str; 2]) -> String {
    format!("{} {}", number(value), if value == 1 { one } else { many })
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

    fn told(tracer: &Tracer, language: Language) -> String {
        let lines = needs_lines(&tracer.compiled(), &tracer.levels(), language);
        lines.into_iter().map(|(what, words)| format!("{what}: {words}\n")).collect()
    }

    #[test]
    fn a_scene_is_told_as_it_was_compiled() {
        let language = Language::English;
        let simple = told(&tracer("Sphere(radius: 1)"), language);
        for line in
            ["Made of: 1 ball\n", "Kept: 1 of 1 shapes", "Operations: 0 of 0", "Lights: 1 light\n", "Rays: 1 level:"]
        {
            assert!(simple.contains(line), "{line} is not in {simple}");
        }
        assert!(simple.contains("none mirrors others, and light goes through none") && !simple.contains("Endless"));
        let more = told(
            &tracer(
                "HalfSpace(normal: (0, 1, 0), offset: -1), \
             Difference(material: \"mirror\", of: [Box(min: (-1, -1, -1), max: (1, 1, 1)), Sphere(radius: 1.2)])",
            ),
            language,
        );
        for line in
            ["1 box along the axes", "Operations: 1 of 1", "Endless: 1 solid, which", "some mirror others; light"]
        {
            assert!(more.contains(line), "{line} is not in {more}");
        }
        assert!(more.contains("levels are used"), "{more}");
    }

    #[test]
    fn however_unions_are_compiled_there_are_no_more_operations_than_are_written() {
        let language = Language::English;
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
            let told = told(&tracer(&solid), language);
            assert!(told.contains(&format!("Operations: {operations} that are written")), "{told}");
        }
    }

    #[test]
    fn what_cannot_be_seen_is_a_warning() {
        let language = Language::English;
        let seen = tracer("Sphere(radius: 1)");
        assert!(needs_warnings(&seen.compiled(), language).is_empty());
        let far = tracer("Difference(of: [Sphere(radius: 1), Sphere(radius: 1, centre: (9, 0, 0))])");
        let warnings = needs_warnings(&far.compiled(), language);
        assert_eq!(warnings, ["1 part is out of reach of what it would be taken from, and left out."]);
        let empty =
            tracer("Sphere(radius: 1), Intersection(of: [Sphere(radius: 1), Sphere(radius: 1, centre: (9, 0, 0))])");
        let warnings = needs_warnings(&empty.compiled(), language);
        assert!(warnings.iter().any(|warning| warning.starts_with("1 solid is empty")), "{warnings:?}");
    }

    #[test]
    fn several_have_their_plural() {
        let language = Language::English;
        let said =
            ["box", "torus", "ball", "box along the axes"].map(|kind| several(2000, shape_names(kind, language)));
        assert_eq!(
            said,
            ["2\u{a0}000 boxes", "2\u{a0}000 tori", "2\u{a0}000 balls", "2\u{a0}000 boxes along the axes"]
        );
        assert_eq!(listed(&["1 ball".into(), "2 boxes".into()], language), "1 ball and 2 boxes");
    }
}
