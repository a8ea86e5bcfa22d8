//! Builds the header of a run from the arguments of `anel render`.

use super::args::{PaceArg, RenderArgs};
use crate::balance::{Rules, Scheduler, Strategy};
use crate::driver::auto_pace;
use crate::gui::SpeedPreset;
use crate::parallel::cores;
use crate::picture::{Division, Size};
use crate::runlog::{Driver, Header, LinkSettings, Metadata, OwnLink};
use crate::scene::Opened;

/// Builds the header of a run with these arguments.
///
/// # Errors
/// A sentence that names the invalid argument and says what to do.
pub(super) fn header(args: &RenderArgs, opened: &Opened) -> Result<Header, String> {
    let speeds = node_speeds(args)?;
    let size = traced_size(args)?;
    let division = Division::new(size.pixels(), args.atom);
    if division.atoms() > Division::MAX_ATOMS {
        return Err(format!(
            "{} atoms of {} pixels are too many; at most {} are possible, so make them larger with --atom",
            division.atoms(),
            args.atom,
            Division::MAX_ATOMS
        ));
    }
    let (driver, strategy) = match (&args.strategy, args.driver) {
        (Scheduler::Protocol(strategy), driver) => (driver, strategy.clone()),
        // Rayon ignores the rules of a strategy; the header needs one nevertheless.
        (Scheduler::WorkStealing, Driver::Threads) => (Driver::WorkStealing, Strategy::Ring),
        (Scheduler::WorkStealing, other) => {
            return Err(format!("rayon runs only with --driver threads, not with --driver {}", other.name()));
        }
    };
    let link = link(args, speeds.len())?;
    let travels = link != LinkSettings::default() || !args.handling.is_zero();
    if driver == Driver::WorkStealing && travels {
        return Err("--latency, --bandwidth, --shared-wire and --handling do not apply to rayon; leave them out".into());
    }
    if args.costs.is_some() && driver != Driver::Sim {
        return Err("--costs applies only to runs in virtual time; add --driver sim".into());
    }
    if !args.without.is_empty() && args.strategy != Scheduler::Protocol(Strategy::Adaptive) {
        return Err(
            "--without applies only to the adaptive ring; add --strategy adaptive, or leave out --without".into()
        );
    }
    let mut rules = Rules::usual(strategy, division, speeds.len());
    rules.part = args.part.unwrap_or(rules.part);
    rules.remedies = args.without.iter().fold(rules.remedies, |all, &remedy| all.without(remedy));
    rules.beat = Rules::beat_for(args.handling, speeds.len());
    let cores = if driver == Driver::Sim { speeds.len() } else { cores() };
    let pace = match args.pace {
        PaceArg::Of(pace) => pace,
        // In virtual time machines do not wait for a core.
        PaceArg::Auto if driver == Driver::Sim => 1.0,
        PaceArg::Auto => auto_pace(&speeds, cores),
    };
    // A run in virtual time is the same on every computer, so its file names none.
    let machine = if driver == Driver::Sim { Metadata::default() } else { Metadata::here(cores) };
    let header = Header {
        scene: opened.name.clone(),
        scene_text: opened.text.clone(),
        size,
        quality: args.quality.quality(),
        division,
        driver,
        rules,
        pace,
        speeds,
        spares: 0,
        link,
        handling: args.handling,
        cores,
        caption: Metadata { title: args.title.clone(), memo: args.memo.clone(), ..machine },
    };
    if driver == Driver::Pairs && !header.is_full_speed() {
        return Err("--driver pairs runs at full speed; leave out --speeds, --seed and --pace".into());
    }
    Ok(header)
}

/// Returns the network, with what nodes and parent have of their own.
///
/// # Errors
/// A sentence if the number of latencies or bandwidths does not fit the number of nodes.
fn link(args: &RenderArgs, nodes: usize) -> Result<LinkSettings, String> {
    for (count, what) in [(args.latency.len(), "latencies"), (args.bandwidth.len(), "bandwidths")] {
        if count > 1 && count != nodes {
            return Err(format!("there are {nodes} nodes but {count} {what}; give each node one, or one for all"));
        }
    }
    let parent = OwnLink { latency: args.parent_latency, bandwidth: args.parent_bandwidth };
    let mut link = LinkSettings { shared: args.shared_wire, parent, ..LinkSettings::default() };
    link.set_latencies(&args.latency);
    link.set_bandwidths(&args.bandwidth);
    Ok(link)
}

/// Returns the speed of each node.
///
/// # Errors
/// A sentence if the number of nodes does not fit the strategy or the speeds.
fn node_speeds(args: &RenderArgs) -> Result<Vec<f64>, String> {
    let is_serial = args.strategy == Scheduler::Protocol(Strategy::Serial);
    let default = match args.speeds.len() {
        0 if is_serial => 1,
        0 => 4,
        speeds => speeds,
    };
    let nodes = args.nodes.map_or(default, usize::from);
    if is_serial && nodes != 1 {
        return Err(format!("serial has one node, not {nodes}; set --nodes 1, or choose another --strategy"));
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

/// Returns the size of the picture that is traced: that of the region, if there is one.
///
/// # Errors
/// A sentence, if the region is not inside the picture, or if another option needs the whole picture.
fn traced_size(args: &RenderArgs) -> Result<Size, String> {
    let Some(region) = args.region else { return Ok(args.size) };
    region.check_inside(args.size)?;
    if args.log.is_some() {
        return Err("a run file keeps a whole picture; leave out --log or --region".into());
    }
    if args.costs.is_some() {
        return Err("the costs of a recorded run are those of a whole picture; leave out --costs or --region".into());
    }
    Ok(region.size)
}
