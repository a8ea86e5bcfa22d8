//! Key bindings. One table serves both the input and the Keys page.

use egui::{Context, Event, Key, Modifiers};

use crate::balance::{Condition, NodeId};
use crate::language::{Language, word};
use crate::view::{StepUnit, Subject};

/// Command of a key or a button.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UserCommand {
    /// Pauses or resumes.
    Pause,
    /// Starts a new run.
    Restart,
    /// Starts a new run with the scheduler that would have recovered from the failure for which this one hangs.
    RestartRecovering,
    /// Steps forward (`true`) or back by one unit.
    Step(StepUnit, bool),
    /// Raises (`true`) or lowers the playback rate.
    Rate(bool),
    /// Sets the playback rate to this entry of [`RATES`](crate::view::RATES).
    SetRate(usize),
    /// Follows the run, or shows its end.
    Live,
    /// Shows the beginning of the run.
    Beginning,
    /// Opens or closes the list of landmarks.
    Find,
    /// Shows the run as it was after a number of records, and selects a machine, an atom or a message.
    Jump(usize, Subject),
    /// Switches between timeline and table of machines.
    Timeline,
    /// Zooms the timeline in (`true`) or out.
    Zoom(bool),
    /// Opens or closes the save sheet.
    Save,
    /// Opens the save sheet for the run.
    SaveRun,
    /// Copies the picture as it is shown to the clipboard.
    Copy,
    /// Opens or closes the Scenes page.
    Scenes,
    /// Opens or closes the Accuracy page.
    Accuracy,
    /// Opens or closes the Compare page.
    Compare,
    /// Opens or closes the list of lessons.
    Learn,
    /// Reads the file of the scene again.
    Reload,
    /// Opens or closes the settings.
    Setup,
    /// Undoes the last change.
    Undo,
    /// Makes the undone change again.
    Redo,
    /// Selects a machine; in a list or a question chooses the entry of this number, from 0.
    Select(NodeId),
    /// Sets the selected machine to the next higher speed.
    Faster,
    /// Sets the selected machine to the next lower speed.
    Slower,
    /// Pauses or resumes the selected machine.
    PauseNode,
    /// Sets the condition of the selected machine, or sets it to well if it has that condition.
    ToggleCondition(Condition),
    /// Moves the inspected pixel (right, down), or the camera while it is being moved; else left and right step by one
    /// event.
    Arrow([i32; 2]),
    /// Shows the next layer over the render.
    Layer,
    /// Shows or hides lines between bands and atoms.
    Outlines,
    /// Switches whether a drag of the picture moves the camera.
    Camera,
    /// Moves the camera back to that of the scene.
    CameraHome,
    /// Moves the camera nearer (`true`) or further away.
    Dolly(bool),
    /// Switches between the dark and the light theme.
    Theme,
    /// Switches between English and Portuguese.
    Language,
    /// Switches presentation mode on or off.
    Projector,
    /// Switches full screen on or off.
    FullScreen,
    /// Opens or closes the list of keys.
    Help,
    /// Opens or closes the list of words.
    Words,
    /// Closes what lies on top.
    Back,
    /// Closes the window.
    Quit,
}

/// A row of the table: the names of the keys, what they do, and their commands.
pub struct KeyRow {
    keys_text: Bilingual,
    effect: Bilingual,
    keys: &'static [(Modifiers, Key, UserCommand)],
}

/// A text in English and in Portuguese.
type Bilingual = (&'static str, &'static str);

/// A text that is the same in both languages.
const fn same(text: &'static str) -> Bilingual {
    (text, text)
}

impl KeyRow {
    /// Returns the names of the keys.
    pub fn keys_text(&self, language: Language) -> &'static str {
        word!(language, self.keys_text.0, self.keys_text.1)
    }

    /// Returns what the keys do.
    pub fn effect(&self, language: Language) -> &'static str {
        word!(language, self.effect.0, self.effect.1)
    }
}

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const SHIFT: Modifiers = Modifiers::SHIFT;

/// All key bindings, in the order of the Keys page.
pub const KEY_TABLE: &[KeyRow] = &[
    KeyRow {
        keys_text: ("Space", "Espaço"),
        effect: ("Pause or resume", "Pausar ou continuar"),
        keys: &[(NONE, Key::Space, UserCommand::Pause)],
    },
    KeyRow {
        keys_text: same("←  →"),
        effect: ("Previous or next event, or pixel", "Evento ou pixel anterior ou seguinte"),
        keys: &[
            (NONE, Key::ArrowLeft, UserCommand::Arrow([-1, 0])),
            (NONE, Key::ArrowRight, UserCommand::Arrow([1, 0])),
            (NONE, Key::ArrowUp, UserCommand::Arrow([0, -1])),
            (NONE, Key::ArrowDown, UserCommand::Arrow([0, 1])),
        ],
    },
    KeyRow {
        keys_text: same("Shift ←  →"),
        effect: ("Previous or next traced atom", "Átomo calculado anterior ou seguinte"),
        keys: &[
            (SHIFT, Key::ArrowLeft, UserCommand::Step(StepUnit::Atom, false)),
            (SHIFT, Key::ArrowRight, UserCommand::Step(StepUnit::Atom, true)),
        ],
    },
    KeyRow {
        keys_text: same("Ctrl ←  →"),
        effect: ("Previous or next lap: an offer is made", "Volta anterior ou seguinte: uma oferta é feita"),
        keys: &[
            (CTRL, Key::ArrowLeft, UserCommand::Step(StepUnit::Lap, false)),
            (CTRL, Key::ArrowRight, UserCommand::Step(StepUnit::Lap, true)),
        ],
    },
    KeyRow {
        keys_text: same(",  ."),
        effect: ("Slower or faster time", "Tempo mais lento ou mais rápido"),
        keys: &[(NONE, Key::Comma, UserCommand::Rate(false)), (NONE, Key::Period, UserCommand::Rate(true))],
    },
    KeyRow {
        keys_text: same("Home"),
        effect: ("Show the beginning", "Mostrar o início"),
        keys: &[(NONE, Key::Home, UserCommand::Beginning)],
    },
    KeyRow {
        keys_text: same("L"),
        effect: ("Show the present (Live) or the end", "Mostrar o presente (Ao vivo) ou o fim"),
        keys: &[(NONE, Key::L, UserCommand::Live), (NONE, Key::End, UserCommand::Live)],
    },
    KeyRow {
        keys_text: same("F"),
        effect: ("Find the first offer, the biggest transfer …", "Achar a primeira oferta, o maior envio …"),
        keys: &[(NONE, Key::F, UserCommand::Find), (CTRL, Key::F, UserCommand::Find)],
    },
    KeyRow {
        keys_text: same("T"),
        effect: ("Show the timeline or the machines", "Mostrar a linha do tempo ou as máquinas"),
        keys: &[(NONE, Key::T, UserCommand::Timeline)],
    },
    KeyRow {
        keys_text: same("Ctrl ↑  ↓"),
        effect: ("Zoom the timeline", "Ampliar a linha do tempo"),
        keys: &[(CTRL, Key::ArrowUp, UserCommand::Zoom(true)), (CTRL, Key::ArrowDown, UserCommand::Zoom(false))],
    },
    KeyRow {
        keys_text: same("R"),
        effect: ("Restart with the present settings", "Reiniciar com os ajustes atuais"),
        keys: &[(NONE, Key::R, UserCommand::Restart)],
    },
    KeyRow {
        keys_text: same("S"),
        effect: ("Save a picture or the run", "Salvar uma imagem ou a execução"),
        keys: &[(NONE, Key::S, UserCommand::Save), (CTRL, Key::S, UserCommand::Save)],
    },
    KeyRow {
        keys_text: same("Ctrl Shift S"),
        effect: ("Save the run; then press Enter", "Salvar a execução; depois, Enter"),
        keys: &[(CTRL.plus(SHIFT), Key::S, UserCommand::SaveRun)],
    },
    // The window system reports these keys as one copy event.
    KeyRow {
        keys_text: same("Ctrl C"),
        effect: ("Copy the picture as it is shown", "Copiar a imagem como aparece"),
        keys: &[],
    },
    KeyRow {
        keys_text: same("O"),
        effect: ("Open a scene or a recorded run", "Abrir uma cena ou uma execução gravada"),
        keys: &[(NONE, Key::O, UserCommand::Scenes), (CTRL, Key::O, UserCommand::Scenes)],
    },
    KeyRow {
        keys_text: same("A"),
        effect: ("Accuracy: error and time of qualities", "Precisão: erro e tempo das qualidades"),
        keys: &[(NONE, Key::A, UserCommand::Accuracy)],
    },
    KeyRow {
        keys_text: same("N"),
        effect: ("Learn: lessons with questions", "Aprender: lições com perguntas"),
        keys: &[(NONE, Key::N, UserCommand::Learn)],
    },
    KeyRow {
        keys_text: same("K"),
        effect: ("Compare: the run by other strategies", "Comparar: a execução por outras estratégias"),
        keys: &[(NONE, Key::K, UserCommand::Compare)],
    },
    KeyRow {
        keys_text: same("F5"),
        effect: ("Reload the file of the scene", "Recarregar o arquivo da cena"),
        keys: &[(NONE, Key::F5, UserCommand::Reload)],
    },
    KeyRow {
        keys_text: same("E"),
        effect: ("Set up machines, strategy and picture", "Ajustar máquinas, estratégia e imagem"),
        keys: &[(NONE, Key::E, UserCommand::Setup)],
    },
    KeyRow {
        keys_text: same("1 … 9"),
        effect: ("Select a machine; in a question, answer", "Selecionar máquina; numa pergunta, responder"),
        keys: &[
            (NONE, Key::Num1, UserCommand::Select(0)),
            (NONE, Key::Num2, UserCommand::Select(1)),
            (NONE, Key::Num3, UserCommand::Select(2)),
            (NONE, Key::Num4, UserCommand::Select(3)),
            (NONE, Key::Num5, UserCommand::Select(4)),
            (NONE, Key::Num6, UserCommand::Select(5)),
            (NONE, Key::Num7, UserCommand::Select(6)),
            (NONE, Key::Num8, UserCommand::Select(7)),
            (NONE, Key::Num9, UserCommand::Select(8)),
        ],
    },
    KeyRow {
        keys_text: same("+  −"),
        effect: ("Make the selected machine faster or slower", "Máquina selecionada mais rápida ou mais lenta"),
        keys: &[
            (NONE, Key::Plus, UserCommand::Faster),
            (NONE, Key::Equals, UserCommand::Faster),
            (NONE, Key::Minus, UserCommand::Slower),
        ],
    },
    KeyRow {
        keys_text: same("P"),
        effect: ("Pause or resume the selected machine", "Pausar ou retomar a máquina selecionada"),
        keys: &[(NONE, Key::P, UserCommand::PauseNode)],
    },
    KeyRow {
        keys_text: same("X  H  U"),
        effect: ("Switch it off, hang it, cut it off; or undo", "Desligar, travar, isolar a máquina; desfazer"),
        keys: &[
            (NONE, Key::X, UserCommand::ToggleCondition(Condition::Off)),
            (NONE, Key::H, UserCommand::ToggleCondition(Condition::Hung)),
            (NONE, Key::U, UserCommand::ToggleCondition(Condition::CutOff)),
        ],
    },
    KeyRow {
        keys_text: ("Click", "Clique"),
        effect: ("Inspect a pixel of the picture", "Inspecionar um pixel da imagem"),
        keys: &[],
    },
    KeyRow {
        keys_text: ("Wheel", "Roda"),
        effect: ("Zoom the picture or timeline; drag moves it", "Ampliar imagem ou linha do tempo; arrastar move"),
        keys: &[],
    },
    KeyRow {
        keys_text: same("V"),
        effect: ("Colours: who traced it, its cost, its arrival", "Cores: quem calculou, custo, chegada"),
        keys: &[(NONE, Key::V, UserCommand::Layer)],
    },
    KeyRow {
        keys_text: same("C"),
        effect: ("Drag or arrows move the camera; Shift C: back", "Arrastar ou setas: câmera; Shift C: de volta"),
        keys: &[(NONE, Key::C, UserCommand::Camera), (SHIFT, Key::C, UserCommand::CameraHome)],
    },
    KeyRow {
        keys_text: same("Page ↑  ↓"),
        effect: ("Move the camera nearer or further away", "Aproximar ou afastar a câmera"),
        keys: &[(NONE, Key::PageUp, UserCommand::Dolly(true)), (NONE, Key::PageDown, UserCommand::Dolly(false))],
    },
    KeyRow {
        keys_text: same("B"),
        effect: ("Lines between bands; when zoomed, atoms", "Linhas entre faixas; ampliado, entre átomos"),
        keys: &[(NONE, Key::B, UserCommand::Outlines)],
    },
    KeyRow {
        keys_text: same("Ctrl Z"),
        effect: ("Undo the last change of a setting", "Desfazer a última mudança de ajuste"),
        keys: &[(CTRL, Key::Z, UserCommand::Undo)],
    },
    KeyRow {
        keys_text: same("Ctrl Y"),
        effect: ("Redo", "Refazer"),
        keys: &[(CTRL.plus(Modifiers::SHIFT), Key::Z, UserCommand::Redo), (CTRL, Key::Y, UserCommand::Redo)],
    },
    // `zoom` handles these keys.
    KeyRow {
        keys_text: same("Ctrl +  −  0"),
        effect: ("Larger, smaller or normal window content", "Conteúdo maior, menor ou normal"),
        keys: &[],
    },
    KeyRow {
        keys_text: same("D"),
        effect: ("Dark or light colours", "Cores escuras ou claras"),
        keys: &[(NONE, Key::D, UserCommand::Theme)],
    },
    KeyRow {
        keys_text: same("Shift L"),
        effect: ("English or Portuguese", "Inglês ou português"),
        keys: &[(SHIFT, Key::L, UserCommand::Language)],
    },
    KeyRow {
        keys_text: same("F11"),
        effect: ("For a projector: large; Page ↓ ↑: on, back", "Para o projetor: grande; Page ↓ ↑ avançam"),
        keys: &[(NONE, Key::F11, UserCommand::Projector)],
    },
    KeyRow {
        keys_text: same("Alt Enter"),
        effect: ("Full screen or window", "Tela cheia ou janela"),
        keys: &[(Modifiers::ALT, Key::Enter, UserCommand::FullScreen)],
    },
    KeyRow {
        keys_text: same("Esc"),
        effect: ("Close what was opened last", "Fechar o que foi aberto por último"),
        keys: &[(NONE, Key::Escape, UserCommand::Back)],
    },
    KeyRow {
        keys_text: same("F1"),
        effect: ("This list of keys", "Esta lista de teclas"),
        keys: &[(NONE, Key::F1, UserCommand::Help)],
    },
    KeyRow {
        keys_text: same("W"),
        effect: ("What the words of this window mean", "O que significam as palavras desta janela"),
        keys: &[(NONE, Key::W, UserCommand::Words)],
    },
    KeyRow { keys_text: same("Ctrl Q"), effect: ("Quit", "Sair"), keys: &[(CTRL, Key::Q, UserCommand::Quit)] },
];

/// Returns the commands of the keys pressed in this frame. While the user `is_typing`, plain keys are text.
pub fn pressed(ctx: &Context, is_typing: bool) -> Vec<UserCommand> {
    // Space and Enter press the widget with the focus, and arrows move the focus.
    let has_focus = ctx.memory(|memory| memory.focused().is_some());
    let mut commands = Vec::new();
    // Keys with Shift first, so that Ctrl Shift Z is not taken for Ctrl Z.
    let mut keys: Vec<_> = KEY_TABLE.iter().flat_map(|row| row.keys).collect();
    keys.sort_by_key(|(modifiers, ..)| std::cmp::Reverse(modifiers.shift));
    for &(modifiers, key, command) in keys {
        let plain = modifiers == NONE;
        let is_text = plain && !matches!(key, Key::F1 | Key::F5 | Key::F11 | Key::Escape);
        let edits = matches!(command, UserCommand::Undo | UserCommand::Redo);
        let is_of_focus = key == Key::Space || matches!(command, UserCommand::Arrow(_) | UserCommand::Step(..));
        if is_typing && (is_text || edits) || is_of_focus && has_focus {
            continue;
        }
        let is_pressed = ctx.input_mut(|input| {
            // Shift is ignored, because a plus may need it; Ctrl and Alt are not.
            let exact = if plain { !input.modifiers.command && !input.modifiers.alt } else { true };
            exact && if plain { input.key_pressed(key) } else { input.consume_key(modifiers, key) }
        });
        if is_pressed {
            commands.push(command);
        }
    }
    if !is_typing && !has_focus && ctx.input(|input| input.events.contains(&Event::Copy)) {
        commands.push(UserCommand::Copy);
    }
    commands
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_has_two_commands() {
        let keys: Vec<_> = KEY_TABLE.iter().flat_map(|row| row.keys).collect();
        for (i, (modifiers, key, _)) in keys.iter().enumerate() {
            assert!(!keys[..i].iter().any(|(others, other, _)| (others, other) == (modifiers, key)), "{key:?}");
        }
    }
}
