//! Tells a log in its own time, with the pixels that others trace meanwhile.

use std::collections::BTreeMap;
use std::ops::Range;

use crossbeam_channel::{Receiver, Sender};

use super::Update;
use super::clock::Clock;
use super::jobs::Job;
use super::port::FLUSH;
use crate::picture::{Colour, Division};
use crate::record::Record;
use crate::runlog::RunLog;
use crate::time::Time;

/// Tracing goes ahead of what is told by no more than this many pixels (12 MiB) and a job.
pub(super) const AHEAD: u32 = 1 << 20;

/// What a teller has to know.
pub(super) enum Note {
    /// The pixels of the job with this index.
    Traced(usize, Vec<Colour>),
    /// The clock goes on, or has ended.
    Wake,
}

/// Tells records and pixels when it is time.
pub(super) struct Teller<'a> {
    records: &'a [Record],
    division: Division,
    jobs: &'a [Job],
    clock: &'a Clock,
    notes: &'a Receiver<Note>,
    todo: Sender<(usize, Range<u32>)>,
    updates: &'a Sender<Update>,
    /// How many records are told.
    told: usize,
    /// How many jobs are with the tracers, or done.
    handed_out: usize,
    /// How many jobs are told.
    placed: usize,
    /// Pixels that are handed out and not told.
    ahead: u32,
    /// What is traced and not told, by job.
    traced: BTreeMap<usize, Vec<Colour>>,
    /// When something was last told.
    flushed: Time,
}

impl<'a> Teller<'a> {
    /// Who tells `updates` of `log`; its `jobs` are handed out by `todo`, and come back with the `notes`.
    pub fn new(
        log: &'a RunLog,
        jobs: &'a [Job],
        clock: &'a Clock,
        notes: &'a Receiver<Note>,
        todo: Sender<(usize, Range<u32>)>,
        updates: &'a Sender<Update>,
    ) -> Self {
        Self {
            records: log.records(),
            division: log.header.division,
            jobs,
            clock,
            notes,
            todo,
            updates,
            told: 0,
            handed_out: 0,
            placed: 0,
            ahead: 0,
            traced: BTreeMap::new(),
            flushed: Time::ZERO,
        }
    }

    /// Tells all of the log, unless the replay is stopped.
    ///
    /// # Errors
    /// A sentence, if it was stopped.
    pub fn tell(mut self) -> Result<(), String> {
        loop {
            // Before notes are read, so that the one that says so is not lost.
            if self.clock.has_ended() {
                return Err("the replay was stopped".into());
            }
            let (paused, now) = (self.clock.is_paused(), self.clock.now());
            if paused || now >= self.flushed + FLUSH {
                self.flush(now);
            }
            if self.told == self.records.len() && self.placed == self.jobs.len() {
                return Ok(());
            }
            self.hand_out();
            self.wait(paused);
        }
    }

    fn hand_out(&mut self) {
        while self.ahead < AHEAD
            && let Some(job) = self.jobs.get(self.handed_out)
        {
            self.ahead += self.division.pixels_in(&job.atoms);
            let pixels = self.division.pixels_of(&job.atoms);
            // Never disconnected: whoever started the tracers holds a receiver too.
            let _ = self.todo.send((self.handed_out, pixels));
            self.handed_out += 1;
        }
    }

    /// Tells what has happened until `now`.
    fn flush(&mut self, now: Time) {
        self.flushed = now;
        let untold = &self.records[self.told..];
        let due = &untold[..untold.partition_point(|record| record.at <= now)];
        if !due.is_empty() {
            self.told += due.len();
            self.update(Update::Records(due.to_vec()));
        }
        let (mut atoms, mut pixels) = (Vec::new(), Vec::new());
        while self.has_pixels_due()
            && let Some((job, colours)) = self.traced.pop_first()
        {
            let placed = self.jobs[job].atoms.clone();
            self.placed += 1;
            self.ahead -= self.division.pixels_in(&placed);
            atoms.push(placed);
            pixels.extend(colours);
        }
        if !atoms.is_empty() {
            self.update(Update::Placed { atoms, pixels });
        }
    }

    /// Whether there are pixels that the parent has received and nobody was told of.
    fn has_pixels_due(&self) -> bool {
        // The first traced is also the first due: jobs are in the order in which they are received.
        self.traced.first_key_value().is_some_and(|(&job, _)| self.jobs[job].received < self.told)
    }

    /// Waits until there is something to tell or to hand out; a clock that stands still brings no records.
    fn wait(&mut self, paused: bool) {
        let flush = self.flushed + FLUSH;
        let record = self.records.get(self.told).filter(|_| !paused).map(|record| record.at.max(flush));
        let pixels = self.has_pixels_due().then_some(flush);
        let note = match [record, pixels].into_iter().flatten().min() {
            Some(wake) => self.notes.recv_timeout(wake.since(self.clock.now())).ok(),
            // Never disconnected: the replay's own sender lives as long as this thread.
            None => self.notes.recv().ok(),
        };
        for note in note.into_iter().chain(self.notes.try_iter()) {
            if let Note::Traced(job, colours) = note {
                self.traced.insert(job, colours);
            }
        }
    }

    fn update(&self, update: Update) {
        // Whoever dropped the replay no longer listens.
        let _ = self.updates.send(update);
    }
}
