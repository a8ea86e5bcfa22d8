//! Charts of the study of accuracy.

use super::choice::front as front_of;
use super::fit::log_correlation;
use super::knobs::Knob;
use super::ring::{LATENCIES_MS, RingAccuracy};
use super::scene::{MeasuredPoint, SceneAccuracy};
use super::transfers::RingRun;
use crate::view::{Axis, LineChart, Scale, Series, Style, series_hue};

/// Charts CPU seconds against error: each knob alone, the combinations, the Pareto front and the floor.
pub(super) fn front(found: &SceneAccuracy) -> LineChart {
    let point = |entry: &MeasuredPoint| (entry.point.cpu_s, entry.point.rmse());
    let line = |(i, knob): (usize, Knob)| Series {
        name: knob.name().into(),
        hue: series_hue(i),
        points: found.of_knob(Some(knob)).map(point).collect(),
        style: Style::Line,
    };
    let points = found.points();
    let best: Vec<(f64, f64)> = front_of(&points).into_iter().map(|point| (point.cpu_s, point.rmse())).collect();
    let times = points.iter().map(|point| point.cpu_s);
    let [least, most] = [times.clone().fold(f64::INFINITY, f64::min), times.fold(0.0, f64::max)];
    let dots = Series {
        name: "together".into(),
        hue: series_hue(4),
        points: found.of_knob(None).map(point).collect(),
        style: Style::Dots,
    };
    let dashed = |name: &str, i, points| Series { name: name.into(), hue: series_hue(i), points, style: Style::Dashed };
    // The dots lie below the lines.
    let mut series = vec![dots];
    series.extend(Knob::ALL.into_iter().enumerate().map(line));
    series.extend([dashed("front", 5, best), dashed("floor", 6, vec![(least, found.floor), (most, found.floor)])]);
    LineChart {
        title: format!("Speed against accuracy: {}", found.scene),
        note: format!("{} pixels; each knob alone, and all combined; floor: the reference's own error", found.size),
        x: seconds(),
        y: logarithmic("error of the picture (RMSE, linear light)"),
        series,
    }
}

/// Charts CPU seconds against the error that each knob alone causes.
pub(super) fn alone(found: &SceneAccuracy) -> LineChart {
    let line = |(i, knob): (usize, Knob)| Series {
        name: knob.name().into(),
        hue: series_hue(i),
        points: found.of_knob(Some(knob)).filter_map(|entry| Some((entry.point.cpu_s, entry.alone?))).collect(),
        style: Style::Line,
    };
    LineChart {
        title: format!("Error of each knob alone: {}", found.scene),
        note: "Samples, threshold: against very many samples; depth, cutoff: against no limit".into(),
        x: seconds(),
        y: logarithmic("error of this knob alone (RMSE, linear light)"),
        series: Knob::ALL.into_iter().enumerate().map(line).collect(),
    }
}

fn seconds() -> Axis {
    logarithmic("CPU seconds on one core")
}

fn logarithmic(label: &str) -> Axis {
    Axis { label: label.into(), scale: Scale::Log10, range: None }
}

/// Least number of waiting atoms for which a share is meaningful.
pub(super) const MIN_WAITING_ATOMS: u32 = 20;

/// Runs per scene whose transfers are drawn: the transfers of all runs would hide each other.
const RUNS_DRAWN_PER_SCENE: usize = 6;

/// Charts the estimated share of each transfer against the true share.
pub(super) fn estimate(ring: &RingAccuracy) -> LineChart {
    let transfers = ring
        .runs_by_scene
        .iter()
        .flat_map(|runs| runs.iter().take(RUNS_DRAWN_PER_SCENE))
        .flat_map(|run| &run.transfers);
    let large = transfers.filter(|transfer| transfer.waiting >= MIN_WAITING_ATOMS);
    let points: Vec<(f64, f64)> = large.map(|transfer| (transfer.truth, transfer.estimate)).collect();
    let note = format!("{} transfers with at least {MIN_WAITING_ATOMS} waiting atoms", points.len());
    let right = vec![(0.0, 0.0), (1.0, 1.0)];
    let side = |label: &str| Axis { label: label.into(), scale: Scale::Linear, range: Some((0.0, 1.0)) };
    LineChart {
        title: "Estimated and true share of a transfer".into(),
        note,
        x: side("true share, with which both machines finish together"),
        y: side("estimated share, from the counts of traced atoms (R7)"),
        series: vec![
            Series { name: "transfers".into(), hue: series_hue(0), points: rightwards(points), style: Style::Dots },
            Series { name: "right".into(), hue: series_hue(1), points: right, style: Style::Dashed },
        ],
    }
}

/// Sorts points by x: the last point is beside the series' name.
fn rightwards(mut points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    points
}

/// Charts the lateness of runs against the error of their estimates.
pub(super) fn lateness(ring: &RingAccuracy) -> LineChart {
    let series = |(i, runs): (usize, &Vec<RingRun>)| Series {
        name: runs.first().map_or_else(String::new, |run| run.row.scene.clone()),
        hue: series_hue(i),
        points: rightwards(RingAccuracy::points(runs)),
        style: Style::Dots,
    };
    let related = log_correlation(&ring.all_points()).map_or(String::new(), |r| format!("; correlation {r:.2}"));
    LineChart {
        title: "Errors of estimates and late finishes".into(),
        note: format!("A dot is a run of the ring on eight machines of random speeds{related}"),
        x: logarithmic("mean error of the estimated share, weighted by the waiting work"),
        y: logarithmic("makespan / ideal − 1"),
        series: ring.runs_by_scene.iter().enumerate().map(series).collect(),
    }
}

/// Charts the lateness of runs against their messages, for sizes of atoms.
pub(super) fn atoms(ring: &RingAccuracy) -> LineChart {
    let line = |(i, latency): (usize, f64)| Series {
        name: format!("{latency} ms a message"),
        hue: series_hue(i),
        points: ring
            .atom_sizes
            .iter()
            .filter(|group| group.latency_ms == latency)
            .map(|group| (group.mean(|run| run.messages as f64), group.mean(|run| run.lateness)))
            .collect(),
        style: Style::Line,
    };
    LineChart {
        title: "Cost and gain of finer atoms".into(),
        note: "From atoms of 5,000 pixels (left) to 5; means over rings of random speeds".into(),
        x: logarithmic("messages per run"),
        y: logarithmic("makespan / ideal − 1"),
        series: LATENCIES_MS.into_iter().enumerate().map(line).collect(),
    }
}
