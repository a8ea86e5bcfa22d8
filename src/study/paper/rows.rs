//! The rows of the study's table: one for each run.

use std::time::Duration;

use serde::Serialize;

use super::article::{self, makespan_over_ideal};
use crate::runlog::{Driver, Header, Metrics};

/// A run, or the median of several runs of the same kind.
#[derive(Clone, Debug, Serialize)]
pub(super) struct PaperRow {
    /// The article's figure that the run belongs to, or the parameter that is varied: `atom`, `part`, `place`, `swing`.
    pub figure: &'static str,
    /// `none`, or `modelled`.
    pub network: &'static str,
    pub strategy: &'static str,
    pub driver: &'static str,
    pub nodes: usize,
    /// Whether one of the machines is slow.
    pub slow: bool,
    /// The slow machine's place in the ring, from 1.
    pub place: Option<usize>,
    /// Pixels in an atom.
    pub atom: u32,
    /// The farm's atoms in a part; the ring's least atoms in a transfer.
    pub part: u32,
    pub makespan_s: f64,
    pub ideal_s: f64,
    pub over_ideal: f64,
    pub article_over_ideal: Option<f64>,
    /// Makespan of the same run in virtual time, with the costs measured on threads.
    pub twin_s: Option<f64>,
    pub finish_spread_s: f64,
    pub messages: u64,
    pub bytes: u64,
    pub transfers: u64,
    pub atoms_moved: u64,
    /// Period with which a machine's speed swings.
    pub period_s: Option<f64>,
}

/// What a row is about.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowSubject {
    pub figure: &'static str,
    pub modelled: bool,
    /// Period with which a machine's speed swings.
    pub period: Option<Duration>,
}

impl RowSubject {
    /// Describes a run of machines with constant speeds.
    pub fn new(figure: &'static str, modelled: bool) -> Self {
        Self { figure, modelled, period: None }
    }
}

impl PaperRow {
    /// Makes the row of a run, and of its twin in virtual time if it has one.
    pub fn new(subject: RowSubject, header: &Header, metrics: &Metrics, twin: Option<&Metrics>) -> Self {
        let messages = metrics.messages();
        let seconds = |metrics: &Metrics| metrics.makespan().unwrap_or_default().as_secs_f64();
        let place = header.speeds.iter().position(|&speed| speed < 1.0);
        let nodes = header.speeds.len();
        let is_last = place.is_none_or(|place| place + 1 == nodes);
        let article = article::over_ideal(&header.rules.strategy, nodes, place.is_some());
        Self {
            figure: subject.figure,
            network: if subject.modelled { "modelled" } else { "none" },
            strategy: header.scheduler().name(),
            driver: header.driver.name(),
            nodes,
            slow: place.is_some(),
            place: place.map(|place| place + 1),
            atom: header.division.atom_pixels(),
            part: header.rules.part,
            makespan_s: seconds(metrics),
            ideal_s: metrics.ideal().unwrap_or_default().as_secs_f64(),
            over_ideal: makespan_over_ideal(metrics),
            article_over_ideal: article.filter(|_| is_last && header.driver != Driver::WorkStealing),
            twin_s: twin.map(seconds),
            finish_spread_s: metrics.finish_spread().as_secs_f64(),
            messages: messages.total,
            bytes: messages.bytes,
            transfers: messages.transfers,
            atoms_moved: messages.atoms_moved,
            period_s: subject.period.map(|period| period.as_secs_f64()),
        }
    }
}

/// Returns the median row by makespan / ideal.
pub(super) fn median_row(mut rows: Vec<PaperRow>) -> Option<PaperRow> {
    rows.sort_by(|a, b| a.over_ideal.total_cmp(&b.over_ideal));
    let median_row = rows.len() / 2;
    rows.into_iter().nth(median_row)
}
