//! Tries inputs until one fails. The current input is always in a file, so that it remains even if it ends the process.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;
use std::{env, fs, io, process};

use crossbeam_channel::{RecvTimeoutError, after, never, unbounded};

use super::mutator::Mutator;

/// An input that takes longer counts as a hang. Usual inputs take milliseconds.
const HANG_LIMIT: Duration = Duration::from_secs(30);

/// The largest allowed memory of the process.
const MAX_MEMORY_BYTES: u64 = 1 << 30;

/// A check, its corpus, and the number of mutants.
pub struct Hunt {
    /// Part of the name of the file with the current input.
    pub name: &'static str,
    /// Tried first; mutants are made of the inputs that were not refused.
    pub corpus: Vec<Vec<u8>>,
    /// The number of mutants, unless ANEL_FUZZ_SECONDS gives a time.
    pub mutants: usize,
    /// Reads the file and uses its contents in every way. Returns whether the file was read and not refused.
    pub check: fn(&Path) -> bool,
}

impl Hunt {
    /// # Panics
    /// If an input makes the check panic or hang, or takes too much memory; the message names the file of the input.
    /// Also if nearly all mutants are refused, since then only the reader is tested.
    pub fn run(self) {
        let name = self.name;
        // Several processes may hunt at the same time.
        let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("fuzz-{name}-{}", process::id()));
        let (done, tried) = unbounded();
        let at = file.clone();
        let hunter = thread::Builder::new().name("hunter".into());
        let hunter = hunter.spawn(move || self.hunt(&at, |read| done.send(read).is_ok())).expect("a thread");
        let (mut inputs, mut read) = (0_u64, 0_u64);
        let hangs = loop {
            match tried.recv_timeout(HANG_LIMIT) {
                Ok(was_read) => (inputs, read) = (inputs + 1, read + u64::from(was_read)),
                Err(ended) => break ended == RecvTimeoutError::Timeout,
            }
        };
        if hangs || hunter.join().is_err() {
            let how = if hangs { "hangs" } else { "fails" };
            panic!("input {inputs} {how}: fix that, and add {} to the corpus", file.display());
        }
        fs::remove_file(&file).expect("the last input");
        println!("{name}: {inputs} inputs, of which {read} were read");
        assert!(read * 10 > inputs, "{name}: only {read} of {inputs} inputs got past the reader");
    }

    /// Tries inputs until the number or the time is reached, or `tried` returns false.
    fn hunt(self, file: &Path, mut tried: impl FnMut(bool) -> bool) {
        let seconds = env::var("ANEL_FUZZ_SECONDS").ok().map(|text| text.parse().expect("a number of seconds"));
        let over = seconds.map_or_else(never, |seconds| after(Duration::from_secs(seconds)));
        let (most, seed) = match seconds {
            Some(_) => (usize::MAX, fastrand::u64(..)),
            // The usual test tries the same inputs every time.
            None => (self.mutants, 1),
        };
        let mut attempt = |input: &[u8]| {
            overwrite(file, input).expect("the file of the input");
            let read = (self.check)(file);
            let memory = most_memory();
            assert!(memory.is_none_or(|most| most < MAX_MEMORY_BYTES), "the process takes {memory:?} bytes of memory");
            (read, tried(read))
        };
        let parents: Vec<_> = self.corpus.into_iter().filter(|input| attempt(input).0).collect();
        let mut mutator = Mutator::new(&parents, seed);
        for _ in 0..most {
            let input = mutator.mutant();
            let (read, go_on) = attempt(&input);
            if !go_on || over.try_recv().is_ok() {
                return;
            }
            if read {
                mutator.keep(input);
            }
        }
    }
}

/// Writes like `fs::write`, but never truncates the file to 0 bytes: some systems then wait for the disk on closing.
fn overwrite(path: &Path, contents: &[u8]) -> io::Result<()> {
    let mut file = File::options().write(true).create(true).truncate(false).open(path)?;
    file.write_all(contents)?;
    file.set_len(contents.len() as u64)
}

/// The contents of the files in a directory of the corpus, in the order of their names.
pub fn corpus(directory: &str) -> Vec<Vec<u8>> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join(directory);
    let entries = fs::read_dir(&directory).expect("a directory of the project");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    files.into_iter().map(|file| fs::read(file).expect("a file of the corpus")).collect()
}

/// The peak memory of this process in bytes; `None` where the system does not tell it.
fn most_memory() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().trim_end_matches(" kB").parse().ok()?;
    Some(kilobytes << 10)
}
