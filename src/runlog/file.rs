//! The run file: JSON lines, the first for the header, then one for each record.

use std::cmp::Ordering;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::file_error::{LineError, LogError, VERSION};
use super::{Header, RunLog, validate};
use crate::output::{OutputError, write_whole};
use crate::record::Record;
use crate::sentence::shown;

/// First bytes of every run file, after a byte order mark, if there is one.
const START: [u8; 12] = *br#"{"anel_run":"#;

/// The first line.
#[derive(Serialize, Deserialize)]
struct FirstLine<H> {
    /// Version of the format. A file without this field is not a run file.
    anel_run: u32,
    header: H,
}

/// Returns whether there is a regular file at `path` that begins like a run file. Reads only these bytes, and nothing
/// from directories and pipes.
pub fn is_run_file(path: &Path) -> bool {
    let mut start = [0; START.len()];
    let read = open(path).and_then(|file| {
        let mut reader = BufReader::new(file);
        skip_byte_order_mark(&mut reader)?;
        reader.read_exact(&mut start)
    });
    read.is_ok() && start == START
}

impl RunLog {
    /// Writes the log to a file.
    ///
    /// # Errors
    /// As [`write_whole`].
    pub fn save(&self, path: &Path) -> Result<(), OutputError> {
        write_whole(path, |file| self.write(file))
    }

    /// Writes the log to `to`.
    ///
    /// # Errors
    /// As `to`.
    pub fn write(&self, to: &mut impl Write) -> io::Result<()> {
        write_line(to, &FirstLine { anel_run: VERSION, header: &self.header })?;
        self.records().iter().try_for_each(|record| write_line(to, record))
    }

    /// Reads a log from a file that [`RunLog::save`] has written. If the last line is cut off, the log ends before it,
    /// and [`RunLog::cut_off_at`] gives the line.
    ///
    /// # Errors
    /// [`LogError::Read`] if the file is not a regular file, or cannot be read; [`LogError::Line`] with the first line
    /// that is wrong.
    pub fn load(path: &Path) -> Result<Self, LogError> {
        let read = |source| LogError::Read { path: path.to_owned(), source };
        let wrong = |line, why| LogError::Line { path: path.to_owned(), line, why };
        let mut reader = BufReader::new(open(path).map_err(read)?);
        skip_byte_order_mark(&mut reader).map_err(read)?;
        // The first line of another file may be very long: do not read it to its end.
        if !reader.fill_buf().map_err(read)?.starts_with(&START) {
            return Err(wrong(1, LineError::NotARun));
        }
        let mut bytes = Vec::new();
        reader.read_until(b'\n', &mut bytes).map_err(read)?;
        // A file that is not text is not a run file.
        let header = parse_first(str::from_utf8(&bytes).unwrap_or_default()).map_err(|why| wrong(1, why))?;
        let mut records: Vec<Record> = Vec::new();
        let mut checker = validate::Checker::new(&header);
        let mut cut_off_at = None;
        for line in 2.. {
            bytes.clear();
            if reader.read_until(b'\n', &mut bytes).map_err(read)? == 0 {
                break;
            }
            let record: Record = match parse_record(&bytes) {
                Ok(record) => record,
                // Every line that was written as a whole ends with a line break.
                Err(_) if !bytes.ends_with(b"\n") => {
                    cut_off_at = Some(line);
                    break;
                }
                Err(why) => return Err(wrong(line, why)),
            };
            checker.record(&record).map_err(|why| wrong(line, why.into()))?;
            records.push(record);
        }
        let mut log = Self::new(header);
        log.cut_off_at = cut_off_at;
        log.add(records);
        Ok(log)
    }
}

/// Skips the mark that some editors put at the beginning of a text.
fn skip_byte_order_mark(reader: &mut impl BufRead) -> io::Result<()> {
    const MARK: &[u8] = "\u{feff}".as_bytes();
    if reader.fill_buf()?.starts_with(MARK) {
        reader.consume(MARK.len());
    }
    Ok(())
}

/// Opens a regular file. Checks that before, since opening a pipe blocks until another process writes to it.
fn open(path: &Path) -> io::Result<File> {
    let data = fs::metadata(path)?;
    if data.is_dir() {
        return Err(io::Error::new(io::ErrorKind::IsADirectory, "this is a directory, not a run file"));
    }
    if !data.is_file() {
        return Err(io::Error::other("this is not a regular file"));
    }
    File::open(path)
}

fn parse_first(text: &str) -> Result<Header, LineError> {
    // The version first, since the header of another version may have other fields.
    let first: FirstLine<serde_json::Value> = serde_json::from_str(text).map_err(|_| LineError::NotARun)?;
    match first.anel_run.cmp(&VERSION) {
        Ordering::Less => return Err(LineError::Older(first.anel_run)),
        Ordering::Greater => return Err(LineError::Newer(first.anel_run)),
        Ordering::Equal => {}
    }
    let first: FirstLine<Header> = serde_json::from_str(text).map_err(|error| json_error(&error))?;
    validate::header(&first.header)?;
    Ok(first.header)
}

fn parse_record(line: &[u8]) -> Result<Record, LineError> {
    // A line break inside of a text that is cut off would be another error than the end.
    let text = str::from_utf8(line.trim_ascii_end()).map_err(|_| LineError::NotText)?;
    serde_json::from_str(text).map_err(|error| json_error(&error))
}

/// Returns the error without its line, which is always 1, since each line is parsed by itself.
fn json_error(error: &serde_json::Error) -> LineError {
    const MAX_LENGTH: usize = 400;
    let text = error.to_string();
    let what = text.rsplit_once(" at line ").map_or(&*text, |(what, _)| what);
    LineError::Json { what: shown(what, MAX_LENGTH), column: error.column() }
}

fn write_line(to: &mut impl Write, line: &impl Serialize) -> io::Result<()> {
    serde_json::to_writer(&mut *to, line)?;
    to.write_all(b"\n")
}

#[cfg(test)]
mod tests {
    use super::super::examples::{done, header};
    use super::super::{Driver, LinkSettings, OwnLink};
    use super::*;
    use crate::balance::{Condition, Message, OfferDetails, Party, Rules, Strategy as Sharing};
    use crate::record::RecordKind;
    use crate::time::Time;
    use proptest::prelude::*;
    use std::time::Duration;
    use tempfile::NamedTempFile;

    /// Number of nodes in the headers below.
    const NODES: u16 = 4;
    const ATOMS: u32 = 20;

    fn parties() -> impl Strategy<Value = Party> {
        prop_oneof![Just(Party::Parent), (0..NODES).prop_map(Party::Node)]
    }

    fn messages() -> impl Strategy<Value = Message> {
        let range = || (0..=ATOMS, 0..=ATOMS).prop_map(|(a, b)| a.min(b)..a.max(b));
        prop_oneof![
            range().prop_map(Message::Band),
            Just(Message::Request),
            Just(Message::Join),
            range().prop_map(Message::Part),
            (0..NODES, any::<u32>()).prop_map(|(who, done)| Message::offer(who, done)),
            (0..NODES, any::<u32>(), help()).prop_map(|(who, done, help)| Message::Offer {
                who,
                done,
                help: Some(help)
            }),
            prop::collection::vec(range(), 0..4).prop_map(Message::Again),
            Just(Message::Wake),
            (prop::collection::vec(range(), 0..4), any::<bool>(), any::<u64>())
                .prop_map(|(holds, idle, sent)| Message::Beat { holds, idle, sent: Time(sent) }),
            prop::collection::vec(0..NODES, 0..4).prop_map(Message::Gone),
            prop::collection::vec(range(), 0..4).prop_map(Message::Placed),
            (0..ATOMS).prop_map(Message::Failed),
            prop::collection::vec(range(), 0..4).prop_map(Message::Transfer),
            prop::collection::vec(range(), 0..4).prop_map(Message::Results),
            Just(Message::Shutdown),
        ]
    }

    fn help() -> impl Strategy<Value = OfferDetails> {
        let numbers = (any::<u32>(), any::<u64>(), any::<u16>(), prop::option::of(any::<u16>()));
        numbers.prop_map(|(speed, sent, stop, left)| OfferDetails { speed, sent: Time(sent), stop, left })
    }

    fn conditions() -> impl Strategy<Value = Condition> {
        prop::sample::select(vec![Condition::Well, Condition::Hung, Condition::CutOff, Condition::Off])
    }

    fn kinds() -> impl Strategy<Value = RecordKind> {
        let sent = ((any::<u64>(), 0..1u64 << 32), parties(), parties(), messages());
        let cost = || (0..=365 * 24 * 3600u64).prop_map(Duration::from_secs);
        prop_oneof![
            sent.prop_map(|((id, bytes), from, to, message)| {
                RecordKind::Sent { id, from, to, message, bytes, arrives: Time(u64::MAX) }
            }),
            (any::<u64>(), parties()).prop_map(|(id, by)| RecordKind::Received { id, by }),
            (0..NODES, 0..ATOMS).prop_map(|(node, atom)| RecordKind::AtomStarted { node, atom }),
            (0..NODES, 0..ATOMS, cost()).prop_map(|(node, atom, cost)| RecordKind::AtomDone { node, atom, cost }),
            (0..NODES, 0.0..=1.0f64).prop_map(|(node, speed)| RecordKind::SpeedSet { node, speed }),
            (0..NODES).prop_map(|node| RecordKind::Paused { node }),
            (0..NODES).prop_map(|node| RecordKind::Resumed { node }),
            (0..=3_600_000u64).prop_map(|ms| RecordKind::LatencySet { latency: Duration::from_millis(ms) }),
            (parties(), prop::option::of(0..3600u64)).prop_map(|(party, seconds)| {
                RecordKind::OwnLatencySet { party, latency: seconds.map(Duration::from_secs) }
            }),
            (0..NODES).prop_map(|node| RecordKind::Retired { node }),
            (0..NODES, conditions()).prop_map(|(node, condition)| RecordKind::Condition { node, condition }),
            (parties(), parties(), any::<bool>()).prop_map(|(one, other, cut)| RecordKind::Link { one, other, cut }),
            (parties(), parties(), 0..=3_600_000u64).prop_map(|(from, to, ms)| {
                let until = Time::ZERO + Duration::from_millis(ms);
                RecordKind::Delayed { from, to, until }
            }),
            any::<u64>().prop_map(|id| RecordKind::Lost { id }),
            (0..NODES, 0..ATOMS).prop_map(|(node, atom)| RecordKind::AtomFailed { node, atom }),
            (0..ATOMS).prop_map(|atom| RecordKind::GivenUp { atom }),
            Just(RecordKind::Estimating),
            cost().prop_map(|cost| RecordKind::Estimated { costs: vec![cost] }),
            Just(RecordKind::Finished),
        ]
    }

    fn headers() -> impl Strategy<Value = Header> {
        let numbers = (prop::array::uniform4(0.0..=1.0f64), 1e-6..=1.0f64, prop::option::of(1.0..1e12f64));
        let batch = prop::option::of(any::<Duration>());
        let shared = any::<bool>();
        let own = (prop::option::of(0..3600u64), prop::option::of(1.0..1e9f64))
            .prop_map(|(seconds, bandwidth)| OwnLink { latency: seconds.map(Duration::from_secs), bandwidth });
        let own_links = (prop::collection::vec(own.clone(), 0..4), own);
        let time = || {
            (0..=3600u64, 0..1_000_000_000u32)
                .prop_map(|(s, ns)| Duration::from_secs(s.min(3599)) + Duration::from_nanos(ns.into()))
        };
        (".*", (time(), time(), any::<u32>()), numbers, batch, (shared, own_links)).prop_map(
            |(scene, (latency, handling, part), (speeds, pace, bandwidth), batch, (shared, (nodes, parent)))| Header {
                scene,
                driver: Driver::Sim,
                rules: Rules { strategy: Sharing::FarmBySpeed, part, batch, ..header(&speeds).rules },
                pace,
                link: LinkSettings { latency, bandwidth, shared, nodes, parent },
                handling,
                ..header(&speeds)
            },
        )
    }

    proptest! {
        #[test]
        fn saved_logs_load_unchanged(
            header in headers(),
            kinds in prop::collection::vec((any::<u64>(), kinds()), 0..20),
        ) {
            let mut log = RunLog::new(header);
            for (at, kind) in kinds {
                log.add(vec![Record { at: Time(at), kind }]);
            }
            let directory = tempfile::tempdir().unwrap();
            let path = directory.path().join("run.jsonl");
            log.save(&path).unwrap();
            prop_assert_eq!(RunLog::load(&path).unwrap(), log);
        }
    }

    /// Returns the error of [`RunLog::load`] for a file with this text, without the path.
    fn complaint(text: &[u8]) -> String {
        let file = NamedTempFile::new().unwrap();
        fs::write(file.path(), text).unwrap();
        let error = RunLog::load(file.path()).unwrap_err().to_string();
        error.strip_prefix(&format!("{}, ", file.path().display())).unwrap().to_owned()
    }

    #[test]
    fn errors_name_the_line() {
        let mut log = RunLog::new(header(&[1.0]));
        log.add(vec![done(1, 0, 0, 1), done(2, 0, 1, 1)]);
        let file = NamedTempFile::new().unwrap();
        log.save(file.path()).unwrap();
        let text = fs::read_to_string(file.path()).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        let with = |line: usize, text: &str| {
            let mut lines = lines.clone();
            lines[line - 1] = text;
            complaint(lines.join("\n").as_bytes())
        };
        assert_eq!(complaint(b""), "line 1: this is not a run file of anel");
        assert_eq!(complaint(b"\x89PNG\xff"), "line 1: this is not a run file of anel");
        assert_eq!(complaint(b"{\"anel_run\":\xff"), "line 1: this is not a run file of anel");
        assert_eq!(
            with(1, r#"{"anel_run":1,"header":null}"#),
            "line 1: the file is from an older anel (its format's version is 1; this program reads version 3); make \
             the run anew"
        );
        assert_eq!(
            with(1, r#"{"anel_run":7,"header":null}"#),
            "line 1: the file is from a newer anel (its format's version is 7; this program reads version 3); open it \
             with that one"
        );
        assert!(with(1, &lines[0].replace("speeds", "spoons")).starts_with("line 1: missing field `speeds`"));
        assert_eq!(
            with(1, &lines[0].replace(r#""atom_pixels":5"#, r#""atom_pixels":0"#)),
            "line 1: the number of atoms does not fit the size of the picture"
        );
        assert_eq!(with(2, &lines[1].replace(r#""node":0"#, r#""node":1"#)), "line 2: there is no node of this number");
        assert_eq!(
            with(2, &lines[1].replace(r#""atom":0"#, r#""atom":20"#)),
            "line 2: there is no atom of this number"
        );
        assert!(with(2, &lines[1][..30]).starts_with("line 2: EOF while parsing"));
    }

    /// A program that is killed while it writes, or a full disk, cuts a file off at any byte.
    #[test]
    fn file_that_is_cut_off_opens_up_to_there() {
        let mut log = RunLog::new(header(&[1.0]));
        log.add(vec![done(1, 0, 0, 1), done(2, 0, 1, 1)]);
        let file = NamedTempFile::new().unwrap();
        log.save(file.path()).unwrap();
        let bytes = fs::read(file.path()).unwrap();
        let ends: Vec<usize> = (0..bytes.len()).filter(|&at| bytes[at] == b'\n').collect();
        for end in ends[0]..=bytes.len() {
            for tail in [&b""[..], b"\0\0", b"\xc3"] {
                fs::write(file.path(), [&bytes[..end], tail].concat()).unwrap();
                let (loaded, whole) = (RunLog::load(file.path()), ends.iter().filter(|&&at| at < end).count());
                if end == ends[0] && !tail.is_empty() {
                    assert!(loaded.is_err(), "the header is cut off");
                    continue;
                }
                let loaded = loaded.unwrap();
                // A record without its line break is whole if nothing else is missing.
                let without_break = ends.contains(&end) && tail.is_empty();
                let is_whole = tail.is_empty() && (without_break || bytes[end - 1] == b'\n');
                assert_eq!(loaded.cut_off_at(), (!is_whole).then_some(whole + 1), "{end} {tail:?}");
                let records = whole + usize::from(without_break) - 1;
                assert_eq!(loaded.records(), &log.records()[..records], "{end} {tail:?}");
            }
        }
    }

    #[test]
    fn byte_order_mark_is_skipped() {
        let mut log = RunLog::new(header(&[1.0]));
        log.add(vec![done(1, 0, 0, 1)]);
        let file = NamedTempFile::new().unwrap();
        log.save(file.path()).unwrap();
        let text = fs::read_to_string(file.path()).unwrap();
        fs::write(file.path(), format!("\u{feff}{text}")).unwrap();
        assert!(is_run_file(file.path()));
        assert_eq!(RunLog::load(file.path()).unwrap(), log);
    }

    #[test]
    fn records_out_of_order_are_refused_and_a_missing_directory_is_an_error() {
        let mut log = RunLog::new(header(&[1.0]));
        log.add(vec![done(2, 0, 0, 1)]);
        let file = NamedTempFile::new().unwrap();
        log.save(file.path()).unwrap();
        let mut text = fs::read_to_string(file.path()).unwrap();
        text += &(serde_json::to_string(&done(1, 0, 1, 1)).unwrap() + "\n");
        assert_eq!(complaint(text.as_bytes()), "line 3: this record is earlier than the one before");
        let error = log.save(&file.path().join("run.jsonl")).unwrap_err().to_string();
        assert!(error.contains("cannot write"), "{error}");
    }

    #[test]
    fn run_file_without_a_caption_loads_with_an_empty_one() {
        let file = NamedTempFile::new().unwrap();
        let mut log = RunLog::new(header(&[1.0]));
        log.header.caption.title = "Lost".into();
        log.save(file.path()).unwrap();
        let text = fs::read_to_string(file.path()).unwrap();
        let (before, after) = text.split_once(",\"caption\":{").unwrap();
        let (_, after) = after.split_once('}').unwrap();
        fs::write(file.path(), format!("{before}{after}")).unwrap();
        let loaded = RunLog::load(file.path()).unwrap();
        assert!(loaded.header.caption.is_empty());
        assert_eq!(loaded, RunLog::new(header(&[1.0])));
    }

    #[test]
    fn run_files_are_recognized_by_their_first_bytes() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("run.jsonl");
        RunLog::new(header(&[1.0])).save(&path).unwrap();
        assert!(is_run_file(&path));
        for other in [&b"(camera: (eye: (0, 0, 5)))"[..], b"", b"{", b"{\"anel_ru", b" {\"anel_run\":2", b"\xff\xfe"] {
            fs::write(&path, other).unwrap();
            assert!(!is_run_file(&path), "{other:?}");
        }
        assert!(!is_run_file(&directory.path().join("nothing")));
    }

    #[test]
    fn directories_and_pipes_are_refused_without_reading() {
        let directory = tempfile::tempdir().unwrap();
        let complaint = |path: &Path| {
            assert!(!is_run_file(path));
            RunLog::load(path).unwrap_err().to_string()
        };
        let error = complaint(directory.path());
        assert!(
            error.starts_with("cannot read ") && error.ends_with(": this is a directory, not a run file"),
            "{error}"
        );
        // Opening a pipe would block until another process writes to it.
        let pipe = directory.path().join("pipe");
        let made = std::process::Command::new("mkfifo").arg(&pipe).status();
        if made.is_ok_and(|status| status.success()) {
            let error = complaint(&pipe);
            assert!(error.ends_with(": this is not a regular file"), "{error}");
        }
        assert!(complaint(&directory.path().join("nothing")).starts_with("cannot read "));
    }
}
