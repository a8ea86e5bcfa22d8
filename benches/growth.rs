//! How time, compiling and memory grow with the number of primitives: `cargo bench --bench growth`; `-- svg FILE` also
//! draws the time.
//!
//! Three families of scenes fill the same part of the picture whatever their number of primitives: a union of balls, a
//! block with pits, and a mixed tree. Each scene is measured in a process of its own: the seconds to read its file and
//! to compile it, the nanoseconds of a ray (one thread, the median of several pictures), and the greatest memory of the
//! process, which only Linux tells. The figures depend on the computer; none of them is asserted.

mod common;

use std::fmt::Write;
use std::process::Command;

use anel::language::Language;
use anel::picture::{Quality, Size};
use anel::scene::Opened;
use anel::tracer::{Scratch, Tracer};
use anel::view::{Axis, CHART_SIZE, LineChart, Scale, Series, Style, series_hue};
use common::{median, take_svg, write_svg};
use cpu_time::ThreadTime;

const COUNTS: [usize; 5] = [10, 100, 1_000, 10_000, 60_000];
/// Pictures of a scene.
const RUNS: usize = 3;

/// A family: its name, and the text of its solid with about this many primitives, and behind it of named solids.
type Family = (&'static str, fn(usize) -> String);

const FAMILIES: [Family; 3] = [("union of balls", balls), ("block with pits", pits), ("mixed tree", mixed)];

fn main() {
    let mut arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    let svg = take_svg(&mut arguments);
    if let [family, count] = &arguments[..] {
        let (_, solid) = FAMILIES.into_iter().find(|(name, _)| name == family).expect("a family");
        return measure(&solid(count.parse().expect("a number of primitives")));
    }
    let mut all = Vec::new();
    println!("primitives: seconds to read and to compile, ns a ray (and times that of the first), MB");
    for (name, _) in FAMILIES {
        println!("{name}:");
        let (mut first, mut points) = (None, Vec::new());
        for count in COUNTS {
            let own = std::env::current_exe().expect("the path of this program");
            let output = Command::new(own).args([name, &count.to_string()]).output().expect("it can be started");
            let said = String::from_utf8_lossy(&output.stdout);
            let figures: Vec<f64> = said.split_whitespace().filter_map(|figure| figure.parse().ok()).collect();
            let [leaves, read, compile, ray, memory] = figures[..] else {
                panic!("no figures of {name}, {count}: {}", String::from_utf8_lossy(&output.stderr));
            };
            let growth = ray / *first.get_or_insert(ray);
            points.push((leaves, ray));
            println!("  {leaves:6}: {read:6.3} {compile:6.3}  {ray:6.0} (×{growth:.2})  {memory:5.0}");
        }
        all.push((name, points));
    }
    if let Some(file) = svg {
        write_svg(&file, &chart(all).marks(CHART_SIZE, Language::English));
    }
}

/// Charts the time of a ray.
fn chart(families: Vec<(&'static str, Vec<(f64, f64)>)>) -> LineChart {
    let axis = |label: &str, scale| Axis { label: label.into(), scale, range: None };
    let hues = (0..).map(series_hue);
    let series = families.into_iter().zip(hues).map(|((name, points), hue)| Series {
        name: name.into(),
        hue,
        points,
        style: Style::Line,
    });
    LineChart {
        title: "A ray among many primitives".into(),
        note: "What is visible stays the same; one thread".into(),
        x: axis("primitives", Scale::Log10),
        y: axis("ns a ray", Scale::Linear),
        series: series.collect(),
    }
}

/// Measures the scene with this solid, and prints the figures.
fn measure(solid: &str) {
    let text = format!(
        r#"Scene(
    camera: (eye: (2.6, 2.4, 3.4), look_at: (0, 0, 0), field_of_view: 38),
    lights: [Point(position: (6, 9, 5))],
    materials: {{"grey": (colour: (0.6, 0.6, 0.6), kd: 0.8)}},
    solids: {{"all": {solid}}},
    objects: [Use(solid: "all", material: "grey")],
)"#
    );
    let before = ThreadTime::now();
    let opened = Opened::from_text("growth", &text).expect("the scene is right");
    let read = before.elapsed();
    let before = ThreadTime::now();
    let size = Size::new(320, 240).expect("a picture");
    let tracer = Tracer::new(&opened.scene, size, Quality::default());
    let compile = before.elapsed();
    let ray = median((0..RUNS).map(|_| nanoseconds_a_ray(&tracer, size)));
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let greatest = status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix(" kB"));
    let memory = greatest.and_then(|kilobytes| kilobytes.parse::<f64>().ok()).unwrap_or(f64::NAN) / 1024.0;
    let leaves = ["Sphere(", "Box("].iter().map(|primitive| solid.matches(primitive).count()).sum::<usize>();
    println!("{leaves} {} {} {ray} {memory}", read.as_secs_f64(), compile.as_secs_f64());
}

fn nanoseconds_a_ray(tracer: &Tracer, size: Size) -> f64 {
    let (mut scratch, mut pixels) = (Scratch::default(), Vec::new());
    let before = ThreadTime::now();
    tracer.trace(0..size.pixels(), &mut scratch, &mut pixels);
    before.elapsed().as_secs_f64() * 1e9 / scratch.rays.total() as f64
}

/// Balls that fill a cube.
fn balls(count: usize) -> String {
    let side = (count as f64).cbrt().round() as usize;
    let step = 2.0 / side as f64;
    let mut all = String::from("Union(of: [");
    for at in 0..side.pow(3) {
        let [x, y, z] = [at % side, at / side % side, at / side / side].map(|place| (place as f64 + 0.5) * step - 1.0);
        let _ = write!(all, "Sphere(centre: ({x}, {y}, {z}), radius: {}),", 0.45 * step);
    }
    all + "])"
}

/// A block with pits in its upper side.
fn pits(count: usize) -> String {
    let side = (count as f64).sqrt().round() as usize;
    let step = 2.4 / side as f64;
    let mut all = String::from("Difference(of: [Box(min: (-1.2, -0.4, -1.2), max: (1.2, 0.2, 1.2)),");
    for at in 0..side.pow(2) {
        let [x, z] = [at % side, at / side].map(|place| (place as f64 + 0.5) * step - 1.2);
        let _ = write!(all, "Sphere(centre: ({x}, 0.2, {z}), radius: {}),", 0.4 * step);
    }
    all + "])"
}

/// Unions, intersections and differences in turn: each half of a cube is halved again.
fn mixed(count: usize) -> String {
    /// Files nest solids less deep.
    const MAX_DEPTH: usize = 6;
    fn part(min: [f64; 3], max: [f64; 3], depth: usize, count: usize, named: &mut Vec<String>) -> String {
        let corner = |[x, y, z]: [f64; 3]| format!("({x}, {y}, {z})");
        let middle = [0, 1, 2].map(|axis| (min[axis] + max[axis]) / 2.0);
        let half = (0..3).map(|axis| (max[axis] - min[axis]) / 2.0).fold(f64::INFINITY, f64::min);
        let ball = |share: f64| format!("Sphere(centre: {}, radius: {})", corner(middle), share * half);
        if count <= 2 {
            return ball(0.95);
        }
        let axis = depth % 3;
        let (mut upper_min, mut lower_max) = (min, max);
        (upper_min[axis], lower_max[axis]) = (middle[axis], middle[axis]);
        let lower = part(min, lower_max, depth + 1, (count - 1) / 2, named);
        let upper = part(upper_min, max, depth + 1, count / 2, named);
        let both = format!("Union(of: [{lower}, {upper}])");
        let solid = if depth.is_multiple_of(2) {
            format!("Difference(of: [{both}, {}])", ball(0.3))
        } else {
            let [from, to] =
                [0.96, -0.96].map(|share| [0, 1, 2].map(|axis| middle[axis] - share * (max[axis] - middle[axis])));
            format!("Intersection(of: [{both}, Box(min: {}, max: {})])", corner(from), corner(to))
        };
        if depth == 0 || !depth.is_multiple_of(MAX_DEPTH) {
            return solid;
        }
        named.push(solid);
        format!("Use(solid: \"part {}\")", named.len())
    }
    let mut named = Vec::new();
    let all = part([-1.0; 3], [1.0; 3], 0, count, &mut named);
    let parts: Vec<String> = (1..).zip(&named).map(|(number, solid)| format!("\"part {number}\": {solid}")).collect();
    format!("{all}, {}", parts.join(", "))
}
