//! Messages in flight, and how long they are drawn.
//!
//! On a fast link a message would arrive before anyone has seen it. So each kind of message has a minimum time for
//! which it is drawn: the drawing leaves when the message is sent, and may arrive later than the message. At a slow
//! playback rate this minimum is shorter. The drawing is a pure function of the times (sent, arrives) and of the
//! playback rate, so that it is the same in all views, and the shown time can be stopped or moved back.

use std::ops::Range;
use std::slice;
use std::time::Duration;

use crate::balance::{Message, NodeId, OfferDetails, Party};
use crate::picture::{Atom, atoms_in};
use crate::time::Time;

/// A message that has been sent.
#[derive(Clone, Debug, PartialEq)]
pub struct Flight {
    /// The message's number in the run.
    pub id: u64,
    /// The sender.
    pub from: Party,
    /// The receiver.
    pub to: Party,
    /// The content.
    pub cargo: Cargo,
    /// When it was sent.
    pub sent: Time,
    /// When the link delivers it.
    pub arrives: Time,
    /// Playback rate: run seconds per wall second, at most 1.
    pub(crate) rate: f64,
    /// Part of its way at which it was lost, 0 to 1.
    pub(crate) lost: Option<f32>,
    /// Beginning and length of a delay by its link.
    pub(crate) held: Option<(Time, Duration)>,
    /// The earlier parcel that carries its atoms in the drawing.
    pub(crate) carrier: Option<Carrier>,
}

/// A parcel that carries the atoms of later ones between the same two parties.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Carrier {
    /// Its message.
    pub(crate) id: u64,
    /// When it was sent.
    pub(crate) sent: Time,
    /// Time for which it is drawn on its way.
    pub(crate) length: Duration,
}

/// Content of a message, as views need it.
#[derive(Clone, Debug, PartialEq)]
pub enum Cargo {
    /// A node's first atoms.
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
    /// A message that wakes a sleeping node.
    Wake,
    /// A message of a node that sleeps.
    Sleeps,
    /// A list of a node's atoms, for the parent.
    Beat,
    /// A message about losses or a fresh start, from or to the parent.
    Notice,
    /// The end of the run.
    Shutdown,
}

/// Time in which the cross of a lost message fades.
const CROSS_FADE: Duration = Duration::from_millis(900);

impl Flight {
    /// Creates the flight of message `id`.
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
            Message::Join | Message::Gone(_) | Message::Placed(_) | Message::Failed(_) => Cargo::Notice,
            Message::Shutdown => Cargo::Shutdown,
        };
        Self { id, from, to, cargo, sent, arrives, rate: 1.0, lost: None, held: None, carrier: None }
    }

    /// Returns the drawing of this parcel that may carry `later`: a parcel of the same kind between the same parties,
    /// sent while this one is well under way, that arrives before this one does in the drawing.
    pub(crate) fn carrier_of(&self, later: &Self) -> Option<Carrier> {
        /// A later parcel would be seen for an instant only.
        const LATEST_PROGRESS: f32 = 0.8;
        let is_plain = |flight: &Self| flight.lost.is_none() && flight.held.is_none();
        let are_alike = (self.from, self.to) == (later.from, later.to)
            && matches!(
                (&self.cargo, &later.cargo),
                (Cargo::Transfer(_), Cargo::Transfer(_)) | (Cargo::Again(_), Cargo::Again(_))
            );
        let carries = are_alike
            && is_plain(self)
            && is_plain(later)
            && self.carrier.is_none()
            && self.progress(later.sent) <= LATEST_PROGRESS
            && later.arrives <= self.shown().end;
        carries.then(|| Carrier { id: self.id, sent: self.sent, length: self.drawn_length() })
    }

    /// Time in which the message is drawn on its way: until it arrives or is lost, or for its minimum time if that is
    /// longer.
    pub fn shown(&self) -> Range<Time> {
        if let Some(carrier) = self.carrier {
            return self.sent..carrier.sent + carrier.length;
        }
        let length = self.drawn_length().mul_f64(self.lost.map_or(1.0, f64::from));
        self.sent..self.sent + length + self.held_for()
    }

    /// Marks the message as lost: at the end of its way if the receiver is off, else half-way, or where it is drawn at
    /// `at` if that is further.
    pub(crate) fn lose(&mut self, at: Time, at_end: bool) {
        self.lost = Some(if at_end { 1.0 } else { self.progress(at).max(0.5) });
    }

    /// Stops the message at `at`, so that it arrives at `until`.
    pub(crate) fn hold(&mut self, at: Time, until: Time) {
        let (since, by) = self.held.unwrap_or((at, Duration::ZERO));
        self.held = Some((since, by + until.since(self.arrives)));
        self.arrives = self.arrives.max(until);
    }

    /// Opacity at `now` of the cross where the message was lost, 0 to 1.
    pub(crate) fn cross_opacity(&self, now: Time) -> f32 {
        if self.lost.is_some() && now >= self.shown().end { self.opacity(now) } else { 0.0 }
    }

    /// Length of its delay.
    fn held_for(&self) -> Duration {
        self.held.map_or(Duration::ZERO, |(_, by)| by)
    }

    /// Time for which it is drawn on its whole way, without a delay.
    fn drawn_length(&self) -> Duration {
        let way = self.arrives.since(self.sent).saturating_sub(self.held_for());
        way.max(self.cargo.min_drawn().mul_f64(self.rate))
    }

    /// Time since it was sent, without its delay so far.
    fn travelled(&self, now: Time) -> Duration {
        let held = self.held.map_or(Duration::ZERO, |(at, by)| now.since(at).min(by));
        now.since(self.sent).saturating_sub(held)
    }

    /// End of its drawing with trail and cross, at the playback rate at which that is latest.
    pub(crate) fn latest_gone(&self) -> Time {
        self.arrives.max(self.sent + self.cargo.min_drawn() + self.held_for()) + self.cargo.fade().max(CROSS_FADE)
    }

    /// End of its drawing with trail and cross.
    pub fn gone(&self) -> Time {
        self.shown().end + self.fade()
    }

    /// Time in which its trail or its cross fades.
    fn fade(&self) -> Duration {
        let fade = self.cargo.fade();
        if self.lost.is_some() { fade.max(CROSS_FADE) } else { fade }.mul_f64(self.rate)
    }

    /// Part of its way at `now`, 0 to 1.
    pub fn progress(&self, now: Time) -> f32 {
        if let Some(Carrier { sent, length, .. }) = self.carrier {
            return (now.since(sent).as_secs_f64() / length.as_secs_f64()).min(1.0) as f32;
        }
        let (length, most) = (self.drawn_length().as_secs_f64(), self.lost.unwrap_or(1.0));
        if length == 0.0 { most } else { ((self.travelled(now).as_secs_f64() / length) as f32).min(most) }
    }

    /// Opacity of its trail at `now`: 1 until it has arrived, then falling to 0.
    pub fn opacity(&self, now: Time) -> f32 {
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
    /// The atoms in it.
    pub fn ranges(&self) -> &[Range<Atom>] {
        match self {
            Self::Band(atoms) | Self::Part(atoms) => slice::from_ref(atoms),
            Self::Transfer(ranges) | Self::Results(ranges) | Self::Again(ranges) => ranges,
            Self::Offer { .. } | Self::Request | Self::Wake | Self::Sleeps => &[],
            Self::Beat | Self::Notice | Self::Shutdown => &[],
        }
    }

    /// The number of atoms in it.
    pub fn atoms(&self) -> u32 {
        atoms_in(self.ranges())
    }

    /// Minimum time for which the message is drawn on its way. Offers have none, or an offer that is passed on would be
    /// seen in several places at once: they leave a trail instead.
    pub fn min_drawn(&self) -> Duration {
        /// Small parcels are many, at the end of a run.
        const FEW_ATOMS: u32 = 10;
        match self {
            Self::Band(_) => Duration::from_millis(900),
            Self::Transfer(_) | Self::Again(_) if self.atoms() < FEW_ATOMS => Duration::from_millis(600),
            Self::Transfer(_) | Self::Again(_) => Duration::from_millis(1000),
            Self::Results(_) => Duration::from_millis(500),
            // There may be many, and the receiver waits for them.
            Self::Part(atoms) if atoms.start == atoms.end => Duration::from_millis(900),
            Self::Part(_) => Duration::from_millis(400),
            Self::Request | Self::Wake => Duration::from_millis(250),
            Self::Offer { .. } | Self::Sleeps | Self::Beat | Self::Notice | Self::Shutdown => Duration::ZERO,
        }
    }

    /// Time in which its trail fades after it has arrived.
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
    fn transfer_is_drawn_for_its_minimum_time() {
        assert_eq!(transfer(5, 40_000_000).shown(), Time(5)..Time(1_000_000_005));
        assert_eq!(transfer(5, 3_000_000_000).shown(), Time(5)..Time(3_000_000_005));
        assert_eq!(transfer(5, 1).cargo.atoms(), 37);
    }

    #[test]
    fn offer_arrives_on_time_and_leaves_a_trail() {
        let message = Message::offer(3, 9);
        let offer =
            Flight::new(7, (Party::Node(3), Party::Node(2)), &message, Time::from_secs(1.0), Time::from_secs(1.04));
        assert_eq!(offer.shown().end, Time::from_secs(1.04));
        assert_eq!(offer.opacity(Time::from_secs(1.03)), 1.0);
        let later = offer.opacity(Time::from_secs(1.44));
        assert!(later > 0.2 && later < 0.8, "{later}");
        assert_eq!(offer.opacity(offer.gone()), 0.0);
    }

    #[test]
    fn lost_message_ends_half_way_or_at_a_receiver_that_is_off() {
        let at = Time::from_secs(0.04);
        for (at_end, way) in [(false, 0.5), (true, 1.0)] {
            let mut flight = transfer(0, 40_000_000);
            flight.lose(at, at_end);
            assert_eq!(flight.shown().end, Time::from_secs(f64::from(way)));
            assert_eq!((flight.progress(Time::from_secs(5.0)), flight.cross_opacity(at)), (way, 0.0));
            assert_eq!(flight.cross_opacity(flight.shown().end), 1.0);
            assert_eq!(flight.cross_opacity(flight.gone()), 0.0);
            assert!(flight.gone() > flight.shown().end + Duration::from_millis(500));
        }
    }

    #[test]
    fn minimum_time_is_shorter_at_a_slow_playback_rate() {
        let slow = Flight { rate: 1e-3, ..transfer(5, 40_000) };
        assert_eq!((slow.shown(), slow.gone()), (Time(5)..Time(1_000_005), Time(1_300_005)));
        let slow = Flight { rate: 1e-6, ..transfer(5, 40_000) };
        assert_eq!(slow.shown(), Time(5)..Time(40_005));
    }

    proptest! {
        #[test]
        fn progress_rises_and_opacity_falls(
            sent in 0..10_000_000_000u64, length in 0..5_000_000_000u64, one in 0..20_000_000_000u64, more in 0..1_000_000_000u64,
        ) {
            let flight = transfer(sent, length);
            let (earlier, later) = (Time(one), Time(one + more));
            prop_assert!(flight.progress(earlier) <= flight.progress(later));
            prop_assert!(flight.opacity(earlier) >= flight.opacity(later));
            prop_assert!(flight.shown().end >= flight.arrives);
        }
    }
}
