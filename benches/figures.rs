//! The figures that the project must reach, each a median of five runs in turn with its rivals: `cargo bench`.
//!
//! They depend on the computer, which must be otherwise idle; none of them is asserted.

mod common;

use common::{median, render};
use serde_json::Value;
use tempfile::TempDir;

const RUNS: usize = 5;
const SIZE: &str = "1280x960";

fn main() {
    let directory = TempDir::new().expect("a temporary directory");
    let out = directory.path().join("out.png");
    let render = |scene: &str, rest: &[&str]| render(scene, SIZE, &out, rest);

    println!("paced at 0.2 of a core, {SIZE}, ten-objects: efficiency (ideal / makespan), overhead over serial CPU");
    paced("four equal nodes", &["--nodes", "4"], &render);
    for place in 0..5 {
        // The article's slow machine: 580 s against 6099 s alone (Figures 6 and 7).
        let mut speeds = vec!["1"; 4];
        speeds.insert(place, "0.0950975");
        paced(&format!("and a slow fifth at place {}", place + 1), &["--speeds", &speeds.join(",")], &render);
    }

    println!("\nfull speed, ten-objects, in turn: makespans (s) and their ratio");
    let full = |nodes: &str| {
        number(&render("ten-objects", &["--nodes", nodes, "--pace", "full", "--samples", "2"]), "makespan_s")
    };
    // The limit of the computer: two independent programs at the same time.
    let at_once = || {
        std::thread::scope(|scope| {
            let other = scope.spawn(|| full("1"));
            full("1").max(other.join().unwrap_or(f64::NAN))
        })
    };
    let turns: Vec<_> = (0..RUNS).map(|_| [full("1"), full("2"), at_once()]).collect();
    let [one, two, both] = [0, 1, 2].map(|which| median(turns.iter().map(|turn| turn[which])));
    let ratio = median(turns.iter().map(|[one, two, _]| one / two));
    let ceiling = median(turns.iter().map(|[one, _, both]| 2.0 * one / both));
    println!("  1 node {one:.3}, 2 nodes {two:.3}: {ratio:.3} times");
    println!("  two runs of 1 node at once {both:.3}: the computer itself gives {ceiling:.3} times");
}

/// Prints efficiency and overhead of paced runs.
fn paced(what: &str, nodes: &[&str], render: &impl Fn(&str, &[&str]) -> Value) {
    let rest = [nodes, &["--pace", "0.2"]].concat();
    let runs: Vec<_> = (0..RUNS).map(|_| render("ten-objects", &rest)).collect();
    let of = |field: &str| median(runs.iter().map(|run| number(run, field)));
    let least = runs.iter().map(|run| number(run, "efficiency")).fold(1.0, f64::min);
    println!("  {what:<28} {:.4} (least {least:.4}), overhead {:.3}", of("efficiency"), of("overhead"));
}

fn number(value: &Value, field: &str) -> f64 {
    value[field].as_f64().unwrap_or(f64::NAN)
}
