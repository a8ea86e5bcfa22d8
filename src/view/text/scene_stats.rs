//! Statistics of a compiled scene in words.

use super::format::{count, listed};
use crate::language::{Language, decimal, say, word};
use crate::tracer::SceneStats;

/// Returns labels and values of a scene's statistics. `levels` are the rays on each level of the trees of rays, as
/// [`crate::tracer::Tracer::levels`] counts them.
pub fn needs_lines(compiled: &SceneStats, levels: &[u64], language: Language) -> Vec<(&'static str, String)> {
    let of_kind = |(kind, number): (&&'static str, &usize)| several(*number, shape_names(kind, language));
    let kinds: Vec<String> = compiled.primitives.iter().map(of_kind).collect();
    let kept: usize = compiled.primitives.values().sum();
    let [kept, shapes] = [kept, compiled.source.primitives].map(number);
    let [operations, given] = [compiled.operations, compiled.source.operations].map(number);
    let solids = word!(language, ["solid", "solids"], ["sólido", "sólidos"]);
    let nothing = || word!(language, "nothing", "nada").into();
    let mut lines = vec![
        (word!(language, "Solids", "Sólidos"), several(compiled.solids, solids)),
        (word!(language, "Made of", "Feitos de"), if kinds.is_empty() { nothing() } else { listed(&kinds, language) }),
        (
            word!(language, "Kept", "Restam"),
            say!(language, "{kept} of {shapes} shapes in the file", "{kept} de {shapes} formas no arquivo"),
        ),
        (
            word!(language, "Operations", "Operações"),
            say!(language, "{operations} of {given} in the file", "{operations} de {given} no arquivo"),
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
        let words = say!(language, "every ray is tested against {solids}", "todo raio é testado com {solids}");
        lines.push((word!(language, "Unbounded", "Sem limites"), words));
    }
    lines
}

/// Returns the singular and the plural of a kind of shape.
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

/// Returns a sentence for each reason why parts of the scene are not visible.
pub fn needs_warnings(compiled: &SceneStats, language: Language) -> Vec<String> {
    let tell = |value: usize, words: [&str; 2]| (value > 0).then(|| format!("{}.", several(value, words)));
    let parts = compiled.parts_dropped;
    let dropped = word!(
        language,
        ["solid is empty and not visible", "solids are empty and not visible"],
        ["sólido é vazio e não se vê", "sólidos são vazios e não se veem"]
    );
    let empty = word!(
        language,
        ["part is empty and left out", "parts are empty and left out"],
        ["parte é vazia e foi omitida", "partes são vazias e foram omitidas"]
    );
    let out_of_reach = word!(
        language,
        [
            "part cuts nothing, since it is too far away, and is left out",
            "parts cut nothing, since they are too far away, and are left out"
        ],
        [
            "parte não corta nada, pois está longe demais, e foi omitida",
            "partes não cortam nada, pois estão longe demais, e foram omitidas"
        ]
    );
    [tell(compiled.dropped, dropped), tell(parts.empty, empty), tell(parts.out_of_reach, out_of_reach)]
        .into_iter()
        .flatten()
        .collect()
}

/// Says whether surfaces reflect and transmit.
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

/// Says how deep the trees of rays are.
fn levels_words(levels: &[u64], language: Language) -> String {
    let deep = match levels.len() {
        0 | 1 => {
            return word!(language, "1 level: one ray for each sample", "1 nível: um raio por amostra").into();
        }
        deep => deep,
    };
    let all: u64 = levels.iter().sum();
    let after = decimal(language, (all - levels[0]) as f64 / levels[0].max(1) as f64, 1);
    say!(
        language,
        "{deep} levels; {after} more rays for each primary ray",
        "{deep} níveis; mais {after} raios para cada raio primário"
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
        let lines = needs_lines(&tracer.scene_stats(), &tracer.levels(), language);
        lines.into_iter().map(|(what, words)| format!("{what}: {words}\n")).collect()
    }

    #[test]
    fn statistics_are_those_of_the_compiled_scene() {
        let language = Language::English;
        let simple = told(&tracer("Sphere(radius: 1)"), language);
        for line in
            ["Made of: 1 ball\n", "Kept: 1 of 1 shapes", "Operations: 0 of 0", "Lights: 1 light\n", "Rays: 1 level:"]
        {
            assert!(simple.contains(line), "{line} is not in {simple}");
        }
        assert!(simple.contains("none mirrors others, and light goes through none") && !simple.contains("Unbounded"));
        let more = told(
            &tracer(
                "HalfSpace(normal: (0, 1, 0), offset: -1), \
             Difference(material: \"mirror\", of: [Box(min: (-1, -1, -1), max: (1, 1, 1)), Sphere(radius: 1.2)])",
            ),
            language,
        );
        for line in [
            "1 box along the axes",
            "Operations: 1 of 1",
            "Unbounded: every ray is tested against 1 solid",
            "some mirror others; light",
        ] {
            assert!(more.contains(line), "{line} is not in {more}");
        }
        assert!(more.contains(" levels; "), "{more}");
    }

    #[test]
    fn compiled_unions_count_no_more_operations_than_the_file_has() {
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
            assert!(told.contains(&format!("Operations: {operations} in the file")), "{told}");
        }
    }

    #[test]
    fn invisible_parts_have_warnings() {
        let language = Language::English;
        let seen = tracer("Sphere(radius: 1)");
        assert!(needs_warnings(&seen.scene_stats(), language).is_empty());
        let far = tracer("Difference(of: [Sphere(radius: 1), Sphere(radius: 1, centre: (9, 0, 0))])");
        let warnings = needs_warnings(&far.scene_stats(), language);
        assert_eq!(warnings, ["1 part cuts nothing, since it is too far away, and is left out."]);
        let empty =
            tracer("Sphere(radius: 1), Intersection(of: [Sphere(radius: 1), Sphere(radius: 1, centre: (9, 0, 0))])");
        let warnings = needs_warnings(&empty.scene_stats(), language);
        assert!(warnings.iter().any(|warning| warning.starts_with("1 solid is empty")), "{warnings:?}");
    }

    #[test]
    fn counted_shapes_have_their_plural() {
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
