//! Run files written by an earlier version open, and are written again byte for byte.

use std::fs;
use std::path::{Path, PathBuf};

use anel::runlog::{Metrics, RunLog};
use anel::view::RunView;

fn old_runs() -> Vec<PathBuf> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/files/old_runs");
    let entries = fs::read_dir(directory).expect("the directory of old runs");
    let mut files: Vec<_> = entries.map(|entry| entry.expect("a readable entry").path()).collect();
    files.sort();
    files
}

#[test]
fn old_run_files_open_and_are_written_byte_for_byte() {
    let files = old_runs();
    assert!(files.len() >= 4, "{files:?}");
    for file in files {
        let name = file.display();
        let log = RunLog::load(&file).unwrap_or_else(|error| panic!("{name}: {error}"));
        let again = tempfile::NamedTempFile::new().expect("a temporary file");
        log.save(again.path()).unwrap_or_else(|error| panic!("{name}: {error}"));
        let [old, new] = [&*file, again.path()].map(|path| fs::read(path).expect("a written file"));
        assert!(old == new, "{name} is written with other bytes");
    }
}

#[test]
fn old_run_files_can_be_shown_and_measured() {
    for file in old_runs() {
        let log = RunLog::load(&file).expect("an old run");
        let view = RunView::of(&log);
        assert_eq!(
            view.latest.state.finished().is_some(),
            Metrics::of(&log).makespan().is_some(),
            "{}",
            file.display()
        );
        assert!(view.latest.state.finished().is_some(), "{} is a whole run", file.display());
    }
}
