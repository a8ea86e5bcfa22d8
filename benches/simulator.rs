//! The speed of runs in virtual time: `cargo bench --bench simulator`.

use std::time::{Duration, Instant};

use anel::balance::{Rules, Strategy};
use anel::picture::Size;
use anel::runlog::{Driver, Header, LinkSettings, Metrics};
use anel::sim::Sim;

fn main() {
    println!("1024 nodes, 4 million atoms of 0.2 to 1.8 ms, 1 ms a message:");
    for strategy in [Strategy::Ring, Strategy::Farm, Strategy::Static] {
        run(strategy, 1024, 2048, 2048);
    }
    println!("8 nodes, 6144 atoms, the same network:");
    run(Strategy::Ring, 8, 640, 10);
}

#[expect(clippy::disallowed_methods, reason = "a benchmark")]
fn run(strategy: Strategy, nodes: usize, width: u32, height: u32) {
    let size = Size::new(width, height).expect("a size");
    let plain = Header::plain(size, 1, strategy.clone(), vec![1.0; nodes]);
    let header = Header {
        driver: Driver::Sim,
        link: LinkSettings { latency: Duration::from_millis(1), ..plain.link },
        rules: Rules { batch: Some(Duration::from_millis(15)), ..plain.rules },
        ..plain
    };
    let start = Instant::now();
    // Like the rows of a picture: the middle costs more.
    let atoms = f64::from(header.division.atoms());
    let cost = move |atom: u32| {
        Duration::from_secs_f64(1e-3 - 0.8e-3 * (std::f64::consts::TAU * f64::from(atom) / atoms).cos())
    };
    let mut sim = Sim::new(&header, &[], cost);
    let mut metrics = Metrics::new(&header);
    let mut records = 0u64;
    sim.run(&mut |record| {
        records += 1;
        metrics.add(&record);
    });
    let took = start.elapsed().as_secs_f64();
    println!(
        "  {:<8} {took:6.2} s, {:.2} million events/s, {:.1} million records, {:.0} MiB at most, efficiency {:.4}",
        strategy.name(),
        sim.processed() as f64 / took / 1e6,
        records as f64 / 1e6,
        peak_mib(),
        metrics.efficiency().unwrap_or_default(),
    );
}

/// The peak memory of this process in MiB.
fn peak_mib() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<f64>().ok()).map_or(f64::NAN, |kib| kib / 1024.0)
}
