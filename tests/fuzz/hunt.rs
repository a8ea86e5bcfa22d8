//! Tries inputs until one fails. Each is in a file while it is tried, so that whatever ends the test, even what ends
//! the whole process, the input that did it is there.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};
use std::{env, fs, io};

use super::mutator::Mutator;

/// An input that takes longer hangs. Usual ones take milliseconds.
const PATIENCE: Duration = Duration::from_secs(30);

/// What the process may take of memory at most, whatever it reads.
const MOST_MEMORY: u64 = 2 << 30;

/// What is tried, on what, and how often.
pub struct Hunt {
    /// Names the file of the input at hand.
    pub name: &'static str,
    /// All of these are tried first, and then mutants of them.
    pub corpus: Vec<Vec<u8>>,
    /// So many, unless ANEL_FUZZ_SECONDS says how long to go on.
    pub mutants: usize,
    /// Does everything to the file that should do no harm. Returns whether it was read, and not refused.
    pub check: fn(&Path) -> bool,
}

impl Hunt {
    /// # Panics
    /// With the file of the input, if it makes the check panic or hang; or if memory runs away, or nearly all mutants are
    /// refused, so that nothing behind the reader is tried.
    pub fn run(self) {
        let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("fuzz-{}", self.name));
        let (name, keep) =
            (self.name, format!("{} has the input: mend what fails, and keep it in the corpus", file.display()));
        let (done, tried) = mpsc::channel();
        let at = file.clone();
        let hunter = thread::spawn(move || self.hunt(&at, |read| done.send(read).is_ok()));
        let (mut inputs, mut read) = (0_u64, 0_u64);
        loop {
            match tried.recv_timeout(PATIENCE) {
                Ok(was_read) => (inputs, read) = (inputs + 1, read + u64::from(was_read)),
                Err(RecvTimeoutError::Timeout) => panic!("an input hangs. {keep}"),
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        assert!(hunter.join().is_ok(), "an input fails. {keep}");
        fs::remove_file(&file).expect("the last input");
        println!("{name}: {inputs} inputs, of which {read} were read");
        assert!(read * 10 > inputs, "{name}: only {read} of {inputs} inputs got past the reader");
        assert!(most_memory().is_none_or(|most| most < MOST_MEMORY), "memory: {:?} bytes", most_memory());
    }

    /// Tries inputs until there were enough, or `tried` answers false.
    fn hunt(self, file: &Path, mut tried: impl FnMut(bool) -> bool) {
        let lasts = env::var("ANEL_FUZZ_SECONDS").ok().map(|text| text.parse().expect("a number of seconds"));
        let until = lasts.map(|seconds| Instant::now() + Duration::from_secs(seconds));
        // What is tried always is always the same.
        let seed = until.map_or(1, |_| fastrand::u64(..));
        let mut attempt = |input: &[u8]| {
            overwrite(file, input).expect("a place for the input");
            let read = (self.check)(file);
            (read, tried(read))
        };
        self.corpus.iter().for_each(|input| _ = attempt(input));
        let mut mutator = Mutator::new(&self.corpus, seed);
        let mut mutants = 0;
        while until.map_or(mutants < self.mutants, |until| Instant::now() < until) {
            let input = mutator.mutant();
            let (read, go_on) = attempt(&input);
            if !go_on {
                return;
            }
            if read {
                mutator.keep(input);
            }
            mutants += 1;
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
