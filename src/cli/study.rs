//! `anel study`: does a study and writes its files.

use std::io::Write;
use std::path::Path;

use serde_json::json;

use super::args::StudyKind;
use super::{Failure, open, print, progress, tell};
use crate::output::{check_writable, write_whole};
use crate::picture::Size;
use crate::scene::{Opened, SMALL_BUILT_IN};
use crate::study::{Study, accuracy, chaos, methods, needs, paper, peer, remedies, rivals, scale, stability};

/// Does a study and writes its files into the directory `out`, which it creates if needed.
///
/// `seeds` are the first seed and the number of seeds, for `chaos` only.
pub(super) fn study(
    kind: StudyKind,
    scene: Option<&Path>,
    seeds: (Option<u64>, Option<u64>),
    out: &Path,
    as_json: bool,
) -> Result<(), Failure> {
    if !matches!(kind, StudyKind::Chaos) && seeds != (None, None) {
        return Err(Failure::Refused("--seeds and --seed apply only to chaos; leave them out".into()));
    }
    let first = seeds.0.unwrap_or(0);
    let count = seeds.1.unwrap_or(if seeds.0.is_some() { 1 } else { 10_000 });
    let scenes: Vec<&Path> = match (scene, kind) {
        (Some(_), StudyKind::Stability | StudyKind::Methods) => {
            let own = "stability and methods have their own cases; leave out --scene";
            return Err(Failure::Refused(own.into()));
        }
        (None, StudyKind::Stability | StudyKind::Methods) => Vec::new(),
        (Some(scene), _) => vec![scene],
        (None, StudyKind::Rivals | StudyKind::Peer | StudyKind::Needs | StudyKind::Accuracy) => {
            SMALL_BUILT_IN.iter().map(|(name, _)| Path::new(*name)).collect()
        }
        (None, _) => vec![Path::new("ten-objects")],
    };
    let scenes: Vec<Opened> = scenes.into_iter().map(open).collect::<Result<_, _>>()?;
    std::fs::create_dir_all(out)
        .map_err(|error| Failure::Refused(format!("the directory {} cannot be created: {error}", out.display())))?;
    check_writable(&out.join("study.md")).map_err(|error| Failure::Refused(error.to_string()))?;
    let bar = progress(1, "{percent:>3} %  {elapsed} ({eta} left)  {msg}");
    let mut report_step = |done: usize, of: usize, what: &str| {
        bar.set_length(of as u64);
        bar.set_position(done as u64);
        bar.set_message(what.to_owned());
    };
    let size = Size::new(320, 240).map_err(|error| Failure::Failed(error.to_string()))?;
    let study = match kind {
        StudyKind::Paper => paper(&scenes[0], &mut report_step),
        StudyKind::Scale => scale(&scenes[0], &mut report_step),
        StudyKind::Rivals => rivals(&scenes, &mut report_step),
        StudyKind::Peer => peer(&scenes, size, &mut report_step),
        StudyKind::Needs => needs(&scenes, &mut report_step),
        StudyKind::Stability => stability(&mut report_step),
        StudyKind::Methods => methods(&mut report_step),
        StudyKind::Accuracy => accuracy(&scenes, size, &mut report_step),
        StudyKind::Remedies => remedies(&scenes[0], &mut report_step),
        StudyKind::Chaos => chaos(first..first.saturating_add(count), &scenes[0], &mut report_step),
    };
    let took = bar.elapsed();
    bar.finish_and_clear();
    let Study { name, rows, summary, files } = study.map_err(|error| Failure::Failed(error.to_string()))?;
    let mut written = Vec::new();
    for (file, bytes) in files {
        let path = out.join(file);
        write_whole(&path, |to| to.write_all(&bytes)).map_err(|error| Failure::Failed(error.to_string()))?;
        written.push(path.display().to_string());
    }
    if as_json {
        let mut object = json!({ "study": name, "files": written });
        if summary.is_empty() {
            object["rows"] = rows.into();
        }
        summary.into_iter().for_each(|(name, value)| object[name] = value);
        return print(&object.to_string());
    }
    if let Some(seeds) = summary.get("seeds") {
        let a_minute = count as f64 / took.as_secs_f64() * 60.0;
        tell(&format!("{seeds} seeds, {} failures; {a_minute:.0} seeds per minute", summary["failures"]));
    }
    let report = written.iter().find(|path| path.ends_with(".md"));
    let rows = if summary.is_empty() { rows.len() as u64 } else { count };
    tell(&format!("{rows} runs, {} files; read {} first", written.len(), report.map_or("", String::as_str)));
    print(&written.join("\n"))
}
