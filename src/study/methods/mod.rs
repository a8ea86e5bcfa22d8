//! What accuracy costs: for each method that was tried, nanoseconds a ray against wrong rays per million.
//!
//! The stability study shows where methods fail. This one puts our method and others to the same mixed rays, easy and
//! hard ones, and measures both figures.

mod balls;
mod boxes;
mod flush;
mod tori;

use cpu_time::ThreadTime;
use fastrand::Rng;
use serde::Serialize;

use super::format::significant;
use super::markdown::Report;
use super::progress::Progress;
use super::{ProgressSink, Study, StudyError, median};
use crate::language::Language;
use crate::view::{Axis, CHART_SIZE, LineChart, Scale, Series, Style, series_hue};

/// Turns of each method; its time is their median.
const TURNS: usize = 7;
/// Tries that are timed, so few that they stay in the cache, …
const TIMED_TRIES: usize = 1000;
/// … and how often in a turn.
const REPEATS: usize = 20;

/// A method's answers to all tries of a workload, one number each: the number of crossings, or a mask of boxes.
type Method<Try> = (&'static str, fn(&[Try], &mut Vec<u64>));

/// Rays of one kind, the methods that are put to them, and the right answers. Our method is the first.
struct Workload<Try> {
    name: &'static str,
    title: &'static str,
    /// Description for the report: the rays, the methods, what counts as wrong, and the source of the truth.
    about: &'static str,
    tries: Vec<Try>,
    truth: Vec<u64>,
    methods: Vec<Method<Try>>,
    /// Whether an answer is wrong, given the right one.
    is_wrong: fn(answer: u64, truth: u64) -> bool,
}

/// The result of one method.
#[derive(Clone, Debug, Serialize)]
pub(super) struct MethodRow {
    workload: &'static str,
    method: &'static str,
    ns_a_ray: f64,
    /// Time over that of our method, in the same turn.
    over_ours: f64,
    rays: usize,
    wrong: usize,
    wrong_per_million: f64,
}

/// Measures all methods.
///
/// # Errors
/// A [`StudyError`], if a table cannot be made.
pub fn methods(tell: ProgressSink<'_>) -> Result<Study, StudyError> {
    let mut progress = Progress::new(4, tell);
    let mut study = Study::new("methods");
    let mut report = Report::titled("What accuracy costs");
    report.line(
        "Methods of a ray tracer, on the same rays: nanoseconds a ray on one thread of this computer, medians of 7 \
         turns in turn, and wrong rays per million. The rays are mixed: easy ones as in pictures, and hard ones that \
         graze, come from afar, or meet faces at one place. A picture has far fewer hard ones, so the figures are no \
         error of pictures; they order the methods. No wrong ray among N is drawn at half a ray among N.\n",
    );
    let mut rows = Vec::new();
    let rng = &mut Rng::with_seed(24);
    progress.next("balls");
    add(&mut study, &mut report, &mut rows, &balls::workload(rng));
    progress.next("tori");
    add(&mut study, &mut report, &mut rows, &tori::workload(rng));
    progress.next("flush faces");
    add(&mut study, &mut report, &mut rows, &flush::workload(rng));
    progress.next("boxes");
    add(&mut study, &mut report, &mut rows, &boxes::workload(rng));
    study.add_rows(&rows)?;
    study.add_report(report);
    Ok(study)
}

/// Measures a workload, and adds its rows, its chart and its part of the report.
fn add<Try>(study: &mut Study, report: &mut Report, rows: &mut Vec<MethodRow>, workload: &Workload<Try>) {
    let found = measure(workload);
    report.line(format!("\n## {}\n\n{}\n", workload.title, workload.about));
    report.line(format!("| method | ns a ray | time over ours | wrong of {} |", workload.tries.len()));
    report.line("|---|---:|---:|---:|");
    for MethodRow { method, ns_a_ray, over_ours, wrong, .. } in &found {
        report.line(format!("| {method} | {ns_a_ray:.1} | {over_ours:.2} | {wrong} |"));
    }
    report.line(format!("\n![](methods-{}.svg)", workload.name));
    study.add_chart(workload.name, &chart(workload.title, &found).marks(CHART_SIZE, Language::English));
    rows.extend(found);
}

fn measure<Try>(workload: &Workload<Try>) -> Vec<MethodRow> {
    let Workload { tries, truth, methods, is_wrong, .. } = workload;
    let mut answers = Vec::with_capacity(tries.len());
    let mut seconds = vec![Vec::new(); methods.len()];
    let mut wrong = vec![0; methods.len()];
    for ((_, answer), wrong) in methods.iter().zip(&mut wrong) {
        answers.clear();
        answer(tries, &mut answers);
        *wrong = answers.iter().zip(truth).filter(|&(&answer, &truth)| is_wrong(answer, truth)).count();
    }
    let timed = &tries[..tries.len().min(TIMED_TRIES)];
    for _ in 0..TURNS {
        for ((_, answer), seconds) in methods.iter().zip(&mut seconds) {
            let before = ThreadTime::now();
            for _ in 0..REPEATS {
                answers.clear();
                answer(timed, &mut answers);
                std::hint::black_box(&answers);
            }
            seconds.push(before.elapsed().as_secs_f64() / (timed.len() * REPEATS) as f64);
        }
    }
    let count = tries.len() as f64;
    let row = |(index, (method, _)): (usize, &Method<Try>)| {
        let ratio = |(method, ours): (&f64, &f64)| method / ours;
        let mut ratios: Vec<f64> = seconds[index].iter().zip(&seconds[0]).map(ratio).collect();
        MethodRow {
            workload: workload.name,
            method,
            ns_a_ray: median(&mut seconds[index].clone()) * 1e9,
            over_ours: median(&mut ratios),
            rays: tries.len(),
            wrong: wrong[index],
            wrong_per_million: wrong[index] as f64 / count * 1e6,
        }
    };
    methods.iter().enumerate().map(row).collect()
}

/// Charts time against wrong rays.
fn chart(title: &str, rows: &[MethodRow]) -> LineChart {
    let height = |row: &MethodRow| row.wrong_per_million.max(0.5e6 / row.rays as f64);
    let series = |(index, row): (usize, &MethodRow)| Series {
        name: match row.wrong {
            0 => format!("{}: none", row.method),
            _ => format!("{}: {}", row.method, significant(row.wrong_per_million, 3)),
        },
        hue: series_hue(index),
        points: vec![(row.ns_a_ray, height(row))],
        style: if index == 0 { Style::Dots } else { Style::Hollow },
    };
    LineChart {
        title: title.into(),
        note: "Our method is the full dot. Further left is faster, further down is more accurate".into(),
        x: Axis { label: "ns a ray".into(), scale: Scale::Linear, range: None },
        y: Axis { label: "wrong rays per million".into(), scale: Scale::Log10, range: None },
        series: rows.iter().enumerate().map(series).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Our method is never wrong, and each of the others is, but those that test the same boxes.
    fn check<Try>(workload: &Workload<Try>, never_wrong: &[&str]) {
        let rows = measure(workload);
        assert!(rows[0].ns_a_ray > 0.0 && rows[0].over_ours == 1.0, "{rows:?}");
        for row in &rows {
            assert_eq!(row.wrong == 0, never_wrong.contains(&row.method), "{row:?}");
        }
    }

    #[test]
    fn our_methods_are_right_and_faster_ones_are_not() {
        let rng = &mut Rng::with_seed(1);
        check(&balls::tried(rng, 4000), &["ours"]);
        check(&tori::tried(rng, 2000), &["ours"]);
        check(&flush::tried(rng, 2000), &["ours"]);
        let boxes = boxes::tried(rng, 4000);
        let rounded: Vec<_> =
            boxes.methods.iter().map(|(name, _)| *name).filter(|name| !name.contains("nearest")).collect();
        check(&boxes, &rounded);
    }

    #[test]
    fn chart_has_a_point_for_each_method() {
        let row = |method, ns_a_ray, wrong| MethodRow {
            workload: "balls",
            method,
            ns_a_ray,
            over_ours: 1.0,
            rays: 1000,
            wrong,
            wrong_per_million: wrong as f64 * 1e3,
        };
        let LineChart { series, .. } = chart("Balls", &[row("ours", 5.0, 0), row("theirs", 4.0, 2)]);
        assert_eq!(series[0].points, [(5.0, 500.0)]);
        assert_eq!((series[1].points[0], &*series[1].name), ((4.0, 2000.0), "theirs: 2000"));
    }
}
