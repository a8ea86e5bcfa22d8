//! Tries inputs until one fails. Each is in a file while it is tried, so that whatever ends the test, even what ends
//! the whole process, the input that did it is there.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::Duration;
use std::{env, fs, io, process};

use crossbeam_channel::{RecvTimeoutError, after, never, unbounded};

use super::mutator::Mutator;

/// An input that takes longer hangs. Usual ones take milliseconds.
const PATIENCE: Duration = Duration::from_secs(30);

/// What the process may take of memory at most, whatever it reads.
const MOST_MEMORY: u64 = 1 << 30;

/// What is tried, on what, and how often.
pub struct Hunt {
    /// What the file of the input at hand is named after.
    pub name: &'static str,
    /// All of these are tried first, and then mutants of those that are read.
    pub corpus: Vec<Vec<u8>>,
    /// So many, unless ANEL_FUZZ_SECONDS says how long to go on.
    pub mutants: usize,
    /// Does everything to the file that should do no harm. Returns whether it was read, and not refused.
    pub check: fn(&Path) -> bool,
}

impl Hunt {
    /// # Panics
    /// With the file of the input, if it makes the check panic or hang, or memory run away; or if nearly all mutants are
    /// refused, so that nothing behind the reader is tried.
    pub fn run(self) {
        let name = self.name;
        // Several may hunt at the same time.
        let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("fuzz-{name}-{}", process::id()));
        let (done, tried) = unbounded();
        let at = file.clone();
        let hunter = thread::Builder::new().name("hunter".into());
        let hunter = hunter.spawn(move || self.hunt(&at, |read| done.send(read).is_ok())).expect("a thread");
        let (mut inputs, mut read) = (0_u64, 0_u64);
        let hangs = loop {
            match tried.recv_timeout(PATIENCE) {
                Ok(was_read) => (inputs, read) = (inputs + 1, read + u64::from(was_read)),
                Err(ended) => break ended == RecvTimeoutError::Timeout,
            }
        };
        if hangs || hunter.join().is_err() {
            let how = if hangs { "hangs" } else { "fails" };
            panic!("input {inputs} {how}: mend that, and keep {} in the corpus", file.display());
        }
        fs::remove_file(&file).expect("the last input");
        println!("{name}: {inputs} inputs, of which {read} were read");
        assert!(read * 10 > inputs, "{name}: only {read} of {inputs} inputs got past the reader");
    }

    /// Tries inputs until there were enough, or `tried` answers false.
    fn hunt(self, file: &Path, mut tried: impl FnMut(bool) -> bool) {
        let seconds = env::var("ANEL_FUZZ_SECONDS").ok().map(|text| text.parse().expect("a number of seconds"));
        let over = seconds.map_or_else(never, |seconds| after(Duration::from_secs(seconds)));
        let (most, seed) = match seconds {
            Some(_) => (usize::MAX, fastrand::u64(..)),
            // What is tried always is always the same.
            None => (self.mutants, 1),
        };
        let mut attempt = |input: &[u8]| {
            overwrite(file, input).expect("a place for the input");
            let read = (self.check)(file);
            let memory = most_memory();
            assert!(memory.is_none_or(|most| most < MOST_MEMORY), "it takes {memory:?} bytes of memory");
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

/// As `fs::write`, but the file is never empty meanwhile: some systems wait for the disk when such a file is closed.
fn overwrite(path: &Path, contents: &[u8]) -> io::Result<()> {
    let mut file = File::options().write(true).create(true).truncate(false).open(path)?;
    file.write_all(contents)?;
    file.set_len(contents.len() as u64)
}

/// The files in a directory of the corpus, in the order of their names.
pub fn corpus(directory: &str) -> Vec<Vec<u8>> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join(directory);
    let entries = fs::read_dir(&directory).expect("a directory of the project");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.sort();
    files.into_iter().map(|file| fs::read(file).expect("a file of the corpus")).collect()
}

/// The most memory that this process has had, in bytes, where the system tells it.
fn most_memory() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().trim_end_matches(" kB").parse().ok()?;
    Some(kilobytes << 10)
}
