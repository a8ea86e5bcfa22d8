//! Undo and redo of settings.

use super::Settings;
use crate::balance::NodeId;

/// Settings before each change, and settings after the undone changes.
#[derive(Debug, Default)]
pub struct UndoHistory {
    past: Vec<Settings>,
    future: Vec<Settings>,
    gesture: Option<Gesture>,
}

/// Origin of a change. Consecutive changes of one gesture, like a drag, are undone together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Gesture {
    /// The slider or the number field of a machine's speed.
    Speed(NodeId),
    /// The latency slider.
    Latency,
    /// A single change.
    Once,
}

impl UndoHistory {
    /// Number of changes that can be undone.
    const MAX_STEPS: usize = 200;

    /// Stores the settings before a change, unless the change continues the present gesture.
    pub fn push(&mut self, before: Settings, gesture: Gesture) {
        let continues = gesture != Gesture::Once && self.gesture == Some(gesture);
        self.gesture = Some(gesture);
        self.future.clear();
        if !continues {
            self.past.push(before);
            let surplus = self.past.len().saturating_sub(Self::MAX_STEPS);
            self.past.drain(..surplus);
        }
    }

    /// Ends the present gesture: the next change starts a new one.
    pub fn end_gesture(&mut self) {
        self.gesture = None;
    }

    /// Returns the settings before the last change, if there is one, and keeps `now` for redo.
    pub fn undo(&mut self, now: &Settings) -> Option<Settings> {
        self.gesture = None;
        let before = self.past.pop()?;
        self.future.push(now.clone());
        Some(before)
    }

    /// Returns the settings before the last undo, unless a change came after it, and keeps `now` for undo.
    pub fn redo(&mut self, now: &Settings) -> Option<Settings> {
        self.gesture = None;
        let after = self.future.pop()?;
        self.past.push(now.clone());
        Some(after)
    }

    /// Undoes all changes since the settings were `before`, if the history has these, and keeps `now` for redo.
    pub fn undo_to(&mut self, before: &Settings, now: &Settings) {
        self.gesture = None;
        if let Some(index) = self.past.iter().rposition(|settings| settings == before) {
            self.future.push(now.clone());
            self.future.extend(self.past.drain(index + 1..).rev());
            self.past.pop();
        }
    }

    /// Whether there is a change to undo.
    pub fn can_undo(&self) -> bool {
        !self.past.is_empty()
    }

    /// Whether there is an undone change to redo.
    pub fn can_redo(&self) -> bool {
        !self.future.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_latency(latency: u32) -> Settings {
        Settings { latency: latency.into(), ..Settings::default() }
    }

    #[test]
    fn undo_takes_back_a_whole_gesture() {
        let mut history = UndoHistory::default();
        for latency in 0..5 {
            history.push(with_latency(latency), Gesture::Latency);
        }
        history.end_gesture();
        history.push(with_latency(5), Gesture::Latency);
        history.push(with_latency(6), Gesture::Once);
        history.push(with_latency(7), Gesture::Once);
        let now = with_latency(8);
        let undone: Vec<_> = std::iter::from_fn(|| history.undo(&now)).map(|settings| settings.latency).collect();
        assert_eq!(undone, [7.0, 6.0, 5.0, 0.0]);
        assert!(!history.can_undo() && history.can_redo());
    }

    #[test]
    fn redo_is_possible_until_the_next_change() {
        let mut history = UndoHistory::default();
        history.push(with_latency(1), Gesture::Once);
        let undone = history.undo(&with_latency(2)).unwrap();
        assert_eq!(history.redo(&undone), Some(with_latency(2)));
        assert_eq!(history.undo(&with_latency(2)), Some(with_latency(1)));
        history.push(with_latency(1), Gesture::Once);
        assert!(!history.can_redo());
    }

    #[test]
    fn several_changes_are_undone_at_once() {
        let mut history = UndoHistory::default();
        (0..4).for_each(|latency| history.push(with_latency(latency), Gesture::Once));
        history.undo_to(&with_latency(9), &with_latency(4));
        assert_eq!(history.past.len(), 4, "these settings are not in the history");
        history.undo_to(&with_latency(1), &with_latency(4));
        assert_eq!([2, 3, 4].map(|_| history.redo(&with_latency(1)).unwrap().latency), [2.0, 3.0, 4.0]);
    }

    #[test]
    fn history_has_a_limit() {
        let mut history = UndoHistory::default();
        (0..1000).for_each(|latency| history.push(with_latency(latency), Gesture::Once));
        assert_eq!(history.past.len(), UndoHistory::MAX_STEPS);
        assert_eq!(history.undo(&with_latency(1000)), Some(with_latency(999)));
    }
}
