//! From arguments to what a run is asked to do.

use super::args::{PaceArg, RenderArgs, SchedulerArg};
use crate::balance::{Rules, Strategy};
use crate::driver::{auto_pace, cores};
use crate::gui::SpeedPreset;
use crate::picture::Division;
use crate::runlog::{Driver, Header, LinkSettings, Metadata};
use crate::scene::Opened;

/// What a run with these arguments is asked to do.
///
/// # Errors
/// A sentence that says which argument is impossible, and why.
pub(super) fn header(args: &RenderArgs, opened: &Opened) -> Result<Header, String> {
    let speeds = node_speeds(args)?;
    let division = Division::new(args.size.pixels(), args.atom);
    if division.atoms() > Division::MAX_ATOMS {
        return Err(format!(
            "{} atoms of {} pixels are too many; at most {} are possible (--atom makes them larger)",
            division.atoms(),
            args.atom,
            Division::MAX_ATOMS
        ));
    }
    let (driver, strategy) = match (args.strategy, args.driver) {
        (SchedulerArg::By(strategy), driver) => (driver, strategy),
        // Its own rules are not among ours.
        (SchedulerArg::Rayon, Driver::Threads) => (Driver::WorkStealing, Strategy::Ring),
        (SchedulerArg::Rayon, other) => {
            return Err(format!(
                "rayon shares by its own rules, on threads of its own; it cannot use {}",
                other.name()
            ));
        }
    };
    let travels = !args.latency.is_zero() || args.bandwidth.is_some() || args.shared_wire || !args.handling.is_zero();
    if driver == Driver::WorkStealing && travels {
        return Err(
            "nothing travels between rayon's threads, which share their memory; leave out --latency, --bandwidth, \
                    --shared-wire and --handling"
                .into(),
        );
    }
    if args.costs.is_some() && driver != Driver::Sim {
        return Err("measured costs are for runs in virtual time; add --driver sim".into());
    }
    if !args.without.is_empty() && args.strategy != SchedulerArg::By(Strategy::Adaptive) {
        return Err("only the ring that adapts has remedies: add --strategy adaptive, or leave out --without".into());
    }
    let mut rules = Rules::usual(strategy, division, speeds.len());
    rules.part = args.part.unwrap_or(rules.part);
    rules.remedies = args.without.iter().fold(rules.remedies, |all, &remedy| all.without(remedy));
    rules.beat = Rules::beat_for(args.handling, speeds.len());
    let cores = if driver == Driver::Sim { speeds.len() } else { cores() };
    let pace = match args.pace {
        PaceArg::Of(pace) => pace,
        // Nobody has to wait for a core there.
        PaceArg::Auto if driver == Driver::Sim => 1.0,
        PaceArg::Auto => auto_pace(&speeds, cores),
    };
    // A run in virtual time is the same on every computer.
    let machine = if driver == Driver::Sim { Metadata::default() } else { Metadata::here(cores) };
    let header = Header {
        scene: opened.name.clone(),
        scene_text: opened.text.clone(),
        size: args.size,
        quality: args.quality.quality(),
        division,
        driver,
        rules,
        pace,
        speeds,
        spares: 0,
        link: LinkSettings { latency: args.latency, bandwidth: args.bandwidth, shared: args.shared_wire },
        handling: args.handling,
        cores,
        caption: Metadata { title: args.title.clone(), memo: args.memo.clone(), ..machine },
    };
    if driver == Driver::Pairs && !header.is_full_speed() {
        return Err(
            "two threads a node compete for real cores, at full speed; leave out --speeds, --seed and --pace".into()
        );
    }
    Ok(header)
}

/// A speed for each node.
fn node_speeds(args: &RenderArgs) -> Result<Vec<f64>, String> {
    let is_serial = args.strategy == SchedulerArg::By(Strategy::Serial);
    let usual = match args.speeds.len() {
        0 if is_serial => 1,
        0 => 4,
        speeds => speeds,
    };
    let nodes = args.nodes.map_or(usual, usize::from);
    if is_serial && nodes != 1 {
        return Err(format!("serial is one node that traces all; it cannot have {nodes} nodes"));
    }
    match (args.speeds.len(), args.seed) {
        (0, None) => Ok(vec![1.0; nodes]),
        (0, Some(seed)) => Ok(SpeedPreset::Random.speeds(nodes, seed)),
        (speeds, _) if speeds != nodes => {
            Err(format!("there are {nodes} nodes but {speeds} speeds; give each node one speed, or none at all"))
        }
        _ if nodes > 1024 => Err(format!("{nodes} nodes are too many; at most 1024 are possible")),
        _ => Ok(args.speeds.clone()),
    }
}
