//! Undo and redo of settings.

use std::sync::Arc;

use super::Settings;
use crate::balance::NodeId;
use crate::scene::Opened;

/// Settings before each change, and settings after the undone changes.
#[derive(Debug, Default)]
pub struct UndoHistory {
    past: Vec<Step>,
    future: Vec<Step>,
    gesture: Option<Gesture>,
}

/// Settings to go back to.
#[derive(Clone, Debug)]
pub struct Step {
    /// The settings.
    pub settings: Settings,
    /// The scene, if the change replaced it.
    pub scene: Option<Arc<Opened>>,
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
            self.add(Step { settings: before, scene: None });
        }
    }

    /// Stores the settings and the scene before a change of both.
    pub fn push_scene(&mut self, before: Settings, scene: Arc<Opened>) {
        self.end_gesture();
        self.future.clear();
        self.add(Step { settings: before, scene: Some(scene) });
    }

    fn add(&mut self, step: Step) {
        self.past.push(step);
        let surplus = self.past.len().saturating_sub(Self::MAX_STEPS);
        self.past.drain(..surplus);
    }

    /// Ends the present gesture: the next change starts a new one.
    pub fn end_gesture(&mut self) {
        self.gesture = None;
    }

    /// Returns the step before the last change, if there is one, and keeps `now` and its `scene` for redo.
    pub fn undo(&mut self, now: &Settings, scene: Option<Arc<Opened>>) -> Option<Step> {
        self.gesture = None;
        let before = self.past.pop()?;
        self.future.push(Step { settings: now.clone(), scene: scene.filter(|_| before.scene.is_some()) });
        Some(before)
    }

    /// Returns the step before the last undo, unless a change came after it, and keeps `now` and its `scene` for undo.
    pub fn redo(&mut self, now: &Settings, scene: Option<Arc<Opened>>) -> Option<Step> {
        self.gesture = None;
        let after = self.future.pop()?;
        self.past.push(Step { settings: now.clone(), scene: scene.filter(|_| after.scene.is_some()) });
        Some(after)
    }

    /// Undoes all changes since the settings were `before`, if the history has these, and keeps `now` for redo.
    pub fn undo_to(&mut self, before: &Settings, now: &Settings) {
        self.gesture = None;
        if let Some(index) = self.past.iter().rposition(|step| step.settings == *before) {
            self.future.push(Step { settings: now.clone(), scene: None });
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
        let undone: Vec<_> =
            std::iter::from_fn(|| history.undo(&now, None)).map(|step| step.settings.latency).collect();
        assert_eq!(undone, [7.0, 6.0, 5.0, 0.0]);
        assert!(!history.can_undo() && history.can_redo());
    }

    #[test]
    fn redo_is_possible_until_the_next_change() {
        let mut history = UndoHistory::default();
        history.push(with_latency(1), Gesture::Once);
        let undone = history.undo(&with_latency(2), None).unwrap().settings;
        assert_eq!(history.redo(&undone, None).unwrap().settings, with_latency(2));
        assert_eq!(history.undo(&with_latency(2), None).unwrap().settings, with_latency(1));
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
        assert_eq!([2, 3, 4].map(|_| history.redo(&with_latency(1), None).unwrap().settings.latency), [2.0, 3.0, 4.0]);
    }

    #[test]
    fn history_has_a_limit() {
        let mut history = UndoHistory::default();
        (0..1000).for_each(|latency| history.push(with_latency(latency), Gesture::Once));
        assert_eq!(history.past.len(), UndoHistory::MAX_STEPS);
        assert_eq!(history.undo(&with_latency(1000), None).unwrap().settings, with_latency(999));
    }
}
