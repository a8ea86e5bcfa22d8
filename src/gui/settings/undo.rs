//! What was set before: undo and redo.

use super::Settings;
use crate::balance::NodeId;

/// The settings before each change, and those after the changes that were undone.
#[derive(Debug, Default)]
pub struct UndoHistory {
    past: Vec<Settings>,
    future: Vec<Settings>,
    gesture: Option<Gesture>,
}

/// What a change is made with: the many small changes of one gesture are undone together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gesture {
    /// A machine's slider, or its value.
    Speed(NodeId),
    /// The slider of the latency.
    Latency,
    /// Something that changes once.
    Once,
}

impl UndoHistory {
    /// More steps back than anybody takes.
    const MOST: usize = 200;

    /// Keeps what was set before a change, unless the change belongs to the gesture that goes on.
    pub fn keep(&mut self, before: Settings, gesture: Gesture) {
        let goes_on = gesture != Gesture::Once && self.gesture == Some(gesture);
        self.gesture = Some(gesture);
        self.future.clear();
        if !goes_on {
            self.past.push(before);
            let surplus = self.past.len().saturating_sub(Self::MOST);
            self.past.drain(..surplus);
        }
    }

    /// The hand has let go: the next change is another gesture.
    pub fn let_go(&mut self) {
        self.gesture = None;
    }

    /// Takes what was set before the last change, if there was one.
    pub fn undo(&mut self, now: &Settings) -> Option<Settings> {
        self.gesture = None;
        let before = self.past.pop()?;
        self.future.push(now.clone());
        Some(before)
    }

    /// Takes what was set before the last undo, if nothing was changed since.
    pub fn redo(&mut self, now: &Settings) -> Option<Settings> {
        self.gesture = None;
        let after = self.future.pop()?;
        self.past.push(now.clone());
        Some(after)
    }

    /// Whether there is something to undo.
    pub fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Whether there is something to redo.
    pub fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_latency(latency: u32) -> Settings {
        Settings { latency, ..Settings::default() }
    }

    #[test]
    fn a_gesture_is_undone_as_a_whole() {
        let mut history = UndoHistory::default();
        for latency in 0..5 {
            history.keep(with_latency(latency), Gesture::Latency);
        }
        history.let_go();
        history.keep(with_latency(5), Gesture::Latency);
        history.keep(with_latency(6), Gesture::Once);
        history.keep(with_latency(7), Gesture::Once);
        let now = with_latency(8);
        let undone: Vec<_> = std::iter::from_fn(|| history.undo(&now)).map(|settings| settings.latency).collect();
        assert_eq!(undone, [7, 6, 5, 0]);
        assert!(!history.can_undo() && history.can_redo());
    }

    #[test]
    fn redo_leads_back_until_something_else_is_changed() {
        let mut history = UndoHistory::default();
        history.keep(with_latency(1), Gesture::Once);
        let undone = history.undo(&with_latency(2)).unwrap();
        assert_eq!(history.redo(&undone), Some(with_latency(2)));
        assert_eq!(history.undo(&with_latency(2)), Some(with_latency(1)));
        history.keep(with_latency(1), Gesture::Once);
        assert!(!history.can_redo());
    }

    #[test]
    fn it_does_not_grow_without_end() {
        let mut history = UndoHistory::default();
        (0..1000).for_each(|latency| history.keep(with_latency(latency), Gesture::Once));
        assert_eq!(history.past.len(), UndoHistory::MOST);
        assert_eq!(history.undo(&with_latency(1000)), Some(with_latency(999)));
    }
}
