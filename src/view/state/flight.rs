//! Messages in flight, and for how long they are shown.
//!
//! On a fast link a message is gone before anyone has seen it. So each kind has a shortest displayed flight: it
//! still leaves at its own time, but its drawing may arrive later than the message. Where time goes slowly that is a
//! shorter part of it. One pure function of (sent, arrives) and of how fast time goes decides that for every view, so
//! that pausing or going back costs nothing.

use std::ops::Range;
use std::slice;
use std::time::Duration;

use crate::balance::{Message, NodeId, OfferDetails, Party};
use crate::picture::{Atom, atoms_in};
use crate::time::Time;

/// A message that has left.
#[derive(Clone, Debug, PartialEq)]
pub struct Flight {
    /// Its name in the run.
    pub id: u64,
    /// The sender.
    pub from: Party,
    /// The receiver.
    pub to: Party,
    /// What it carries.
    pub cargo: Cargo,
    /// When it left.
    pub sent: Time,
    /// When the link delivers it.
    pub arrives: Time,
    /// The run's seconds in a second of whoever looks on, at most 1.
    pub(crate) rate: f64,
    /// Where on its way it was lost, 0 to 1, if it was.
    pub(crate) lost: Option<f32>,
    /// Since when it is held up, if it is, and for how long.
    pub(crate) held: Option<(Time, Duration)>,
}

/// What a message carries, as far as views care.
#[derive(Clone, Debug, PartialEq)]
pub enum Cargo {
    /// A node's first share.
    Band(Range<Atom>),
    /// An offer of help.
    Offer {
        /// The node that offers.
        who: NodeId,
    },
    /// A request for atoms.
    Request,
    /// Atoms for the node that asked; none if there are no more.
    Part(Range<Atom>),
    /// Atoms for the node that offered.
    Transfer(Vec<Range<Atom>>),
    /// Traced atoms for the parent.
    Results(Vec<Range<Atom>>),
    /// Atoms to be traced once more.
    Again(Vec<Range<Atom>>),
    /// A sleeping node is woken.
    Wake,
    /// A node says that it sleeps.
    Sleeps,
    /// What a node tells the parent of what it has.
    Beat,
    /// What the parent is told or tells of losses.
    Notice,
    /// The end.
    Shutdown,
}

/// How long a cross is seen.
const CROSS: Duration = Duration::from_millis(900);

impl Flight {
    /// The message `id` that left at `sent`.
    pub fn new(id: u64, (from, to): (Party, Party), message: &Message, sent: Time, arrives: Time) -> Self {
        let cargo = match message {
            Message::Band(band) => Cargo::Band(band.clone()),
            Message::Offer { help: Some(OfferDetails { left: None, .. }), .. } => Cargo::Sleeps,
            Message::Offer { who, .. } => Cargo::Offer { who: *who },
            Message::Request => Cargo::Request,
            Message::Part(part) => Cargo::Part(part.clone()),
            Message::Transfer(ranges) => Cargo::Transfer(ranges.clone()),
            Message::Results(ranges) => Cargo::Results(ranges.clone()),
            Message::Again(ranges) => Cargo::Again(ranges.clone()),
            Message::Wake => Cargo::Wake,
            Message::Beat { .. } => Cargo::Beat,
            Message::Gone(_) | Message::Placed(_) | Message::Failed(_) => Cargo::Notice,
            Message::Shutdown => Cargo::Shutdown,
        };
        Self { id, from, to, cargo, sent, arrives, rate: 1.0, lost: None, held: None }
    }

    /// When the flight is drawn: from when it left to when it arrives, or longer if that is too short to be seen; or to where
    /// it is lost.
    pub fn shown(&self) -> Range<Time> {
        let length = self.whole_way().mul_f64(self.lost.map_or(1.0, f64::from));
        self.sent..self.sent + length + self.held_for()
    }

    /// It is lost: at its end, if nobody is there to receive it, else half-way, or where it is drawn if that is further.
    pub(crate) fn lose(&mut self, at: Time, at_its_end: bool) {
        self.lost = Some(if at_its_end { 1.0 } else { self.progress(at).max(0.5) });
    }

    /// It stands still from `at` on, and arrives at `until`.
    pub(crate) fn hold(&mut self, at: Time, until: Time) {
        let (since, by) = self.held.unwrap_or((at, Duration::ZERO));
        self.held = Some((since, by + until.since(self.arrives)));
        self.arrives = self.arrives.max(until);
    }

    /// How strongly the cross is seen at `now` that stands where it was lost, 0 to 1.
    pub(crate) fn cross(&self, now: Time) -> f32 {
        if self.lost.is_some() && now >= self.shown().end { self.presence(now) } else { 0.0 }
    }

    /// How long it is held up in all.
    fn held_for(&self) -> Duration {
        self.held.map_or(Duration::ZERO, |(_, by)| by)
    }

    /// How long it is drawn if it arrives, and is not held up.
    fn whole_way(&self) -> Duration {
        let way = self.arrives.since(self.sent).saturating_sub(self.held_for());
        way.max(self.cargo.shortest().mul_f64(self.rate))
    }

    /// For how long it has been on its way, apart from what it was held up.
    fn travelled(&self, now: Time) -> Duration {
        let held = self.held.map_or(Duration::ZERO, |(at, by)| now.since(at).min(by));
        now.since(self.sent).saturating_sub(held)
    }

    /// When the last of its trail is gone at the latest, however fast time goes.
    pub(crate) fn gone_at_last(&self) -> Time {
        self.arrives.max(self.sent + self.cargo.shortest() + self.held_for()) + self.cargo.fade().max(CROSS)
    }

    /// When the last of its fading trail is gone.
    pub fn gone(&self) -> Time {
        self.shown().end + self.fade()
    }

    fn fade(&self) -> Duration {
        let fade = self.cargo.fade();
        if self.lost.is_some() { fade.max(CROSS) } else { fade }.mul_f64(self.rate)
    }

    /// How far it is on its way at `now`, 0 to 1.
    pub fn progress(&self, now: Time) -> f32 {
        let (length, most) = (self.whole_way().as_secs_f64(), self.lost.unwrap_or(1.0));
        if length == 0.0 { most } else { ((self.travelled(now).as_secs_f64() / length) as f32).min(most) }
    }

    /// How strongly its trail is still seen at `now`: 1 until it has arrived, then less and less, at last 0.
    pub fn presence(&self, now: Time) -> f32 {
        let (end, fade) = (self.shown().end, self.fade());
        if now <= end {
            1.0
        } else if now >= end + fade {
            0.0
        } else {
            1.0 - (now.since(end).as_secs_f64() / fade.as_secs_f64()) as f32
        }
    }
}

impl Cargo {
    /// The atoms that it holds.
    pub fn ranges(&self) -> &[Range<Atom>] {
        match self {
            Self::Band(atoms) | Self::Part(atoms) => slice::from_ref(atoms),
            Self::Transfer(ranges) | Self::Results(ranges) | Self::Again(ranges) => ranges,
            Self::Offer { .. } | Self::Request | Self::Wake | Self::Sleeps => &[],
            Self::Beat | Self::Notice | Self::Shutdown => &[],
        }
    }

    /// How many atoms it holds.
    pub fn atoms(&self) -> u32 {
        atoms_in(self.ranges())
    }

    /// The shortest time for which its flight is drawn. Offers are not stretched, or one that is passed on would
    /// be seen in several places at once: they leave a trail instead.
    pub const fn shortest(&self) -> Duration {
        match self {
            Self::Band(_) => Duration::from_millis(900),
            Self::Transfer(_) | Self::Again(_) => Duration::from_millis(1000),
            Self::Results(_) => Duration::from_millis(500),
            // There may be many, and whoever asks waits: they are hardly stretched.
            Self::Part(atoms) if atoms.start == atoms.end => Duration::from_millis(900),
            Self::Part(_) => Duration::from_millis(400),
            Self::Request | Self::Wake => Duration::from_millis(250),
            Self::Offer { .. } | Self::Sleeps | Self::Beat | Self::Notice | Self::Shutdown => Duration::ZERO,
        }
    }

    /// How long its trail fades after it has arrived.
    const fn fade(&self) -> Duration {
        match self {
            Self::Offer { .. } => Duration::from_millis(700),
            Self::Band(_) | Self::Part(_) | Self::Transfer(_) | Self::Again(_) | Self::Wake => {
                Duration::from_millis(300)
            }
            Self::Results(_) | Self::Request => Duration::ZERO,
            Self::Sleeps | Self::Beat | Self::Notice | Self::Shutdown => Duration::ZERO,
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn transfer(sent: u64, length: u64) -> Flight {
        let ranges = vec![Range { start: 0, end: 7 }, Range { start: 20, end: 50 }];
        Flight::new(7, (Party::Node(1), Party::Node(4)), &Message::Transfer(ranges), Time(sent), Time(sent + length))
    }

    #[test]
    fn a_short_transfer_is_stretched_and_a_long_one_is_not() {
        assert_eq!(transfer(5, 40_000_000).shown(), Time(5)..Time(1_000_000_005));
        assert_eq!(transfer(5, 3_000_000_000).shown(), Time(5)..Time(3_000_000_005));
        assert_eq!(transfer(5, 1).cargo.atoms(), 37);
    }

    #[test]
    fn an_offer_keeps_its_time_and_leaves_a_trail() {
        let message = Message::offer(3, 9);
        let offer =
            Flight::new(7, (Party::Node(3), Party::Node(2)), &message, Time::from_secs(1.0), Time::from_secs(1.04));
        assert_eq!(offer.shown().end, Time::from_secs(1.04));
        assert_eq!(offer.presence(Time::from_secs(1.03)), 1.0);
        let later = offer.presence(Time::from_secs(1.44));
        assert!(later > 0.2 && later < 0.8, "{later}");
        assert_eq!(offer.presence(offer.gone()), 0.0);
    }

    #[test]
    fn a_lost_message_ends_half_way_or_where_nobody_is() {
        let at = Time::from_secs(0.04);
        for (at_its_end, way) in [(false, 0.5), (true, 1.0)] {
            let mut flight = transfer(0, 40_000_000);
            flight.lose(at, at_its_end);
            assert_eq!(flight.shown().end, Time::from_secs(f64::from(way)));
            assert_eq!((flight.progress(Time::from_secs(5.0)), flight.cross(at)), (way, 0.0));
            assert_eq!(flight.cross(flight.shown().end), 1.0);
            assert_eq!(flight.cross(flight.gone()), 0.0);
            assert!(flight.gone() > flight.shown().end + Duration::from_millis(500));
        }
    }

    #[test]
    fn where_time_goes_slowly_little_is_stretched() {
        let slow = Flight { rate: 1e-3, ..transfer(5, 40_000) };
        assert_eq!((slow.shown(), slow.gone()), (Time(5)..Time(1_000_005), Time(1_300_005)));
        let slow = Flight { rate: 1e-6, ..transfer(5, 40_000) };
        assert_eq!(slow.shown(), Time(5)..Time(40_005));
    }

    proptest! {
        #[test]
        fn progress_and_presence_never_go_back(
            sent in 0..10_000_000_000u64, length in 0..5_000_000_000u64, one in 0..20_000_000_000u64, more in 0..1_000_000_000u64,
        ) {
            let flight = transfer(sent, length);
            let (earlier, later) = (Time(one), Time(one + more));
            prop_assert!(flight.progress(earlier) <= flight.progress(later));
            prop_assert!(flight.presence(earlier) >= flight.presence(later));
            prop_assert!(flight.shown().end >= flight.arrives);
        }
    }
}
