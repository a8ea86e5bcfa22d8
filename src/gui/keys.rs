//! Which key does what. One table serves both the keys themselves and the page that lists them.

use egui::{Context, Key, Modifiers};

use crate::balance::NodeId;

/// What can be asked for, by a key or by a button.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// Stand still, or go on.
    Pause,
    /// From the beginning.
    Restart,
    /// Into a file.
    Save,
    /// The scenes, and what else can be opened.
    Scenes,
    /// Speed against accuracy.
    Accuracy,
    /// The scene's file once more.
    Reload,
    /// What can be set.
    Setup,
    /// Take the last change back.
    Undo,
    /// Make it again.
    Redo,
    /// A machine, to be changed with keys.
    Select(NodeId),
    /// The selected machine, a tenth faster.
    Faster,
    /// The selected machine, a tenth slower.
    Slower,
    /// The selected machine stands still, or goes on.
    PauseNode,
    /// The pixel so far to the right and below, instead of the one that is inspected.
    Inspect([i32; 2]),
    /// Dark or light.
    Theme,
    /// The whole screen, or a window.
    FullScreen,
    /// This table.
    Help,
    /// Whatever lies over the picture goes away.
    Back,
    /// The end.
    Quit,
}

/// A line of the table: what the keys are called, what they do, and the keys.
pub struct Line {
    /// What the keys are called.
    pub shown: &'static str,
    /// What they do.
    pub what: &'static str,
    keys: &'static [(Modifiers, Key, Command)],
}

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;

/// Everything that keys do, in the order in which it is listed.
pub const TABLE: &[Line] = &[
    Line { shown: "Space", what: "Pause, or go on", keys: &[(NONE, Key::Space, Command::Pause)] },
    Line { shown: "R", what: "Restart with what is set", keys: &[(NONE, Key::R, Command::Restart)] },
    Line {
        shown: "S",
        what: "Save a picture, or the run",
        keys: &[(NONE, Key::S, Command::Save), (CTRL, Key::S, Command::Save)],
    },
    Line {
        shown: "O",
        what: "Scenes: open one, or a recorded run",
        keys: &[(NONE, Key::O, Command::Scenes), (CTRL, Key::O, Command::Scenes)],
    },
    Line { shown: "A", what: "Accuracy: what other qualities cost", keys: &[(NONE, Key::A, Command::Accuracy)] },
    Line { shown: "F5", what: "Read the scene's file again", keys: &[(NONE, Key::F5, Command::Reload)] },
    Line { shown: "E", what: "Set up machines, picture and strategy", keys: &[(NONE, Key::E, Command::Setup)] },
    Line {
        shown: "1 … 9",
        what: "Select a machine (a click on it, too)",
        keys: &[
            (NONE, Key::Num1, Command::Select(0)),
            (NONE, Key::Num2, Command::Select(1)),
            (NONE, Key::Num3, Command::Select(2)),
            (NONE, Key::Num4, Command::Select(3)),
            (NONE, Key::Num5, Command::Select(4)),
            (NONE, Key::Num6, Command::Select(5)),
            (NONE, Key::Num7, Command::Select(6)),
            (NONE, Key::Num8, Command::Select(7)),
            (NONE, Key::Num9, Command::Select(8)),
        ],
    },
    Line {
        shown: "+  −",
        what: "The selected machine faster, or slower",
        keys: &[
            (NONE, Key::Plus, Command::Faster),
            (NONE, Key::Equals, Command::Faster),
            (NONE, Key::Minus, Command::Slower),
        ],
    },
    Line {
        shown: "P",
        what: "Pause the selected machine, or let it go on",
        keys: &[(NONE, Key::P, Command::PauseNode)],
    },
    Line { shown: "Click", what: "Inspect a pixel of the picture", keys: &[] },
    Line {
        shown: "Arrows",
        what: "Inspect the pixel beside it",
        keys: &[
            (NONE, Key::ArrowLeft, Command::Inspect([-1, 0])),
            (NONE, Key::ArrowRight, Command::Inspect([1, 0])),
            (NONE, Key::ArrowUp, Command::Inspect([0, -1])),
            (NONE, Key::ArrowDown, Command::Inspect([0, 1])),
        ],
    },
    Line {
        shown: "Ctrl Z",
        what: "Undo the last change of a speed or a setting",
        keys: &[(CTRL, Key::Z, Command::Undo)],
    },
    Line {
        shown: "Ctrl Y",
        what: "Redo",
        keys: &[(CTRL.plus(Modifiers::SHIFT), Key::Z, Command::Redo), (CTRL, Key::Y, Command::Redo)],
    },
    // The keys of the zoom are egui's own.
    Line { shown: "Ctrl +  −  0", what: "Zoom in, zoom out, no zoom", keys: &[] },
    Line { shown: "D", what: "Dark or light", keys: &[(NONE, Key::D, Command::Theme)] },
    Line { shown: "F11", what: "Full screen, or a window again", keys: &[(NONE, Key::F11, Command::FullScreen)] },
    Line { shown: "Esc", what: "Close what is open", keys: &[(NONE, Key::Escape, Command::Back)] },
    Line { shown: "F1", what: "This list of keys", keys: &[(NONE, Key::F1, Command::Help)] },
    Line { shown: "Ctrl Q", what: "Quit", keys: &[(CTRL, Key::Q, Command::Quit)] },
];

/// What the keys ask for. While somebody `types`, letters and digits are what is typed.
pub fn pressed(ctx: &Context, types: bool) -> Vec<Command> {
    // Space and Enter press what has the focus, and arrows move it.
    let has_focus = ctx.memory(|memory| memory.focused().is_some());
    let mut commands = Vec::new();
    // The more modifiers, the sooner: Ctrl Shift Z is not Ctrl Z.
    let mut keys: Vec<_> = TABLE.iter().flat_map(|line| line.keys).collect();
    keys.sort_by_key(|(modifiers, ..)| std::cmp::Reverse(modifiers.shift));
    for &(modifiers, key, command) in keys {
        let plain = modifiers == NONE;
        let typed = plain && !matches!(key, Key::F1 | Key::F5 | Key::F11 | Key::Escape);
        let edits = matches!(command, Command::Undo | Command::Redo);
        let is_of_focus = key == Key::Space || matches!(command, Command::Inspect(_));
        if types && (typed || edits) || is_of_focus && has_focus {
            continue;
        }
        let happens = ctx.input_mut(|input| {
            // A plus may need Shift, an F key may not be one with Alt.
            let exact = if plain { !input.modifiers.command && !input.modifiers.alt } else { true };
            exact && if plain { input.key_pressed(key) } else { input.consume_key(modifiers, key) }
        });
        if happens {
            commands.push(command);
        }
    }
    commands
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_does_two_things() {
        let keys: Vec<_> = TABLE.iter().flat_map(|line| line.keys).collect();
        for (i, (modifiers, key, _)) in keys.iter().enumerate() {
            assert!(!keys[..i].iter().any(|(others, other, _)| (others, other) == (modifiers, key)), "{key:?}");
        }
    }
}
