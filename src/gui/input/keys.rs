//! Which key does what. One table serves both the keys themselves and the page that lists them.

use egui::{Context, Event, Key, Modifiers};

use crate::balance::{Condition, NodeId};
use crate::language::{Language, word};
use crate::view::{StepUnit, Subject};

/// What can be asked for, by a key or by a button.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UserCommand {
    /// Stand still, or go on.
    Pause,
    /// A new run.
    Restart,
    /// What happened next (`true`) or before.
    StepUnit(StepUnit, bool),
    /// The run's time goes faster (`true`) or slower.
    Rate(bool),
    /// Time goes at this place of [`RATES`](crate::view::RATES).
    SetRate(usize),
    /// What happens as it happens; or the end.
    Live,
    /// The run's beginning.
    Beginning,
    /// What is worth jumping to.
    Find,
    /// The moment after so many records, and what it is about.
    Jump(usize, Subject),
    /// The timeline in the machines' place, or these again.
    Timeline,
    /// Less of the timeline (`true`), from nearer, or more.
    Zoom(bool),
    /// Into a file.
    Save,
    /// The run into a file.
    SaveRun,
    /// The picture as it is shown into the clipboard.
    Copy,
    /// The scenes, and what else can be opened.
    Scenes,
    /// Speed against accuracy.
    Accuracy,
    /// Runs beside each other.
    Compare,
    /// The lessons.
    Learn,
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
    /// The selected machine, to the next higher speed.
    Faster,
    /// The selected machine, to the next lower speed.
    Slower,
    /// The selected machine stands still, or goes on.
    PauseNode,
    /// The selected machine becomes so, or well again if it is so.
    Put(Condition),
    /// The pixel so far to the right and below, instead of the one that is inspected; if none is, a step to the right is
    /// the next event.
    Arrow([i32; 2]),
    /// What lies over the picture.
    Layer,
    /// Lines between bands and atoms.
    Outlines,
    /// A drag of the picture moves the camera, or no longer.
    Camera,
    /// The scene's own camera.
    CameraHome,
    /// The camera nearer (`true`) or further away.
    Dolly(bool),
    /// Dark or light.
    Theme,
    /// English or Portuguese.
    Language,
    /// Large and plain, for a room.
    Projector,
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
    shown: Both,
    what: Both,
    keys: &'static [(Modifiers, Key, UserCommand)],
}

/// The same in English and in Portuguese.
type Both = (&'static str, &'static str);

/// What is on the keys themselves.
const fn same(shown: &'static str) -> Both {
    (shown, shown)
}

impl Line {
    /// What the keys are called.
    pub fn shown(&self, language: Language) -> &'static str {
        word!(language, self.shown.0, self.shown.1)
    }

    /// What they do.
    pub fn what(&self, language: Language) -> &'static str {
        word!(language, self.what.0, self.what.1)
    }
}

const NONE: Modifiers = Modifiers::NONE;
const CTRL: Modifiers = Modifiers::COMMAND;
const SHIFT: Modifiers = Modifiers::SHIFT;

/// Everything that keys do, in the order in which it is listed.
pub const TABLE: &[Line] = &[
    Line {
        shown: ("Space", "Espaço"),
        what: ("Pause, or go on", "Pausar, ou continuar"),
        keys: &[(NONE, Key::Space, UserCommand::Pause)],
    },
    Line {
        shown: same("←  →"),
        what: ("An event back or on; or the pixel beside", "Um evento atrás ou adiante; ou o pixel ao lado"),
        keys: &[
            (NONE, Key::ArrowLeft, UserCommand::Arrow([-1, 0])),
            (NONE, Key::ArrowRight, UserCommand::Arrow([1, 0])),
            (NONE, Key::ArrowUp, UserCommand::Arrow([0, -1])),
            (NONE, Key::ArrowDown, UserCommand::Arrow([0, 1])),
        ],
    },
    Line {
        shown: same("Shift ←  →"),
        what: ("An atom back or on", "Um átomo atrás ou adiante"),
        keys: &[
            (SHIFT, Key::ArrowLeft, UserCommand::StepUnit(StepUnit::Atom, false)),
            (SHIFT, Key::ArrowRight, UserCommand::StepUnit(StepUnit::Atom, true)),
        ],
    },
    Line {
        shown: same("Ctrl ←  →"),
        what: ("An offer back or on, from when it is made", "Uma oferta atrás ou adiante, ao ser feita"),
        keys: &[
            (CTRL, Key::ArrowLeft, UserCommand::StepUnit(StepUnit::Lap, false)),
            (CTRL, Key::ArrowRight, UserCommand::StepUnit(StepUnit::Lap, true)),
        ],
    },
    Line {
        shown: same(",  ."),
        what: ("Time goes slower, or faster", "O tempo passa mais devagar, ou mais depressa"),
        keys: &[(NONE, Key::Comma, UserCommand::Rate(false)), (NONE, Key::Period, UserCommand::Rate(true))],
    },
    Line {
        shown: same("Home"),
        what: ("To the beginning", "Ao início"),
        keys: &[(NONE, Key::Home, UserCommand::Beginning)],
    },
    Line {
        shown: same("L"),
        what: ("Live: what happens now; or the end", "Ao vivo: o que acontece agora; ou o fim"),
        keys: &[(NONE, Key::L, UserCommand::Live), (NONE, Key::End, UserCommand::Live)],
    },
    Line {
        shown: same("F"),
        what: ("Find the first offer, the biggest transfer …", "Achar a primeira oferta, a maior transferência …"),
        keys: &[(NONE, Key::F, UserCommand::Find), (CTRL, Key::F, UserCommand::Find)],
    },
    Line {
        shown: same("T"),
        what: ("The timeline, or the machines", "A linha do tempo, ou as máquinas"),
        keys: &[(NONE, Key::T, UserCommand::Timeline)],
    },
    Line {
        shown: same("Ctrl ↑  ↓"),
        what: ("Zoom the timeline", "Ampliar a linha do tempo"),
        keys: &[(CTRL, Key::ArrowUp, UserCommand::Zoom(true)), (CTRL, Key::ArrowDown, UserCommand::Zoom(false))],
    },
    Line {
        shown: same("R"),
        what: ("Restart with what is set", "Reiniciar com o que está ajustado"),
        keys: &[(NONE, Key::R, UserCommand::Restart)],
    },
    Line {
        shown: same("S"),
        what: ("Save a picture, or the run", "Salvar uma imagem, ou a execução"),
        keys: &[(NONE, Key::S, UserCommand::Save), (CTRL, Key::S, UserCommand::Save)],
    },
    Line {
        shown: same("Ctrl Shift S"),
        what: ("Save the run; then Enter", "Salvar a execução; depois, Enter"),
        keys: &[(CTRL.plus(SHIFT), Key::S, UserCommand::SaveRun)],
    },
    // Windows tell of these keys as of one.
    Line {
        shown: same("Ctrl C"),
        what: ("Copy the picture as it is shown", "Copiar a imagem como se mostra"),
        keys: &[],
    },
    Line {
        shown: same("O"),
        what: ("Scenes: open one, or a recorded run", "Cenas: abrir uma, ou uma execução gravada"),
        keys: &[(NONE, Key::O, UserCommand::Scenes), (CTRL, Key::O, UserCommand::Scenes)],
    },
    Line {
        shown: same("A"),
        what: ("Accuracy: what other qualities cost", "Precisão: o que custam outras qualidades"),
        keys: &[(NONE, Key::A, UserCommand::Accuracy)],
    },
    Line {
        shown: same("N"),
        what: ("Learn: lessons with questions", "Aprender: lições com perguntas"),
        keys: &[(NONE, Key::N, UserCommand::Learn)],
    },
    Line {
        shown: same("K"),
        what: ("Compare: the same by other strategies", "Comparar: o mesmo com outras estratégias"),
        keys: &[(NONE, Key::K, UserCommand::Compare)],
    },
    Line {
        shown: same("F5"),
        what: ("Read the scene's file again", "Ler de novo o arquivo da cena"),
        keys: &[(NONE, Key::F5, UserCommand::Reload)],
    },
    Line {
        shown: same("E"),
        what: ("Set up machines, picture and strategy", "Ajustar máquinas, imagem e estratégia"),
        keys: &[(NONE, Key::E, UserCommand::Setup)],
    },
    Line {
        shown: same("1 … 9"),
        what: ("Select a machine; answer; choose of a list", "Selecionar máquina; responder; escolher da lista"),
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
    Line {
        shown: same("+  −"),
        what: ("The selected machine faster, or slower", "A máquina selecionada mais rápida, ou mais lenta"),
        keys: &[
            (NONE, Key::Plus, UserCommand::Faster),
            (NONE, Key::Equals, UserCommand::Faster),
            (NONE, Key::Minus, UserCommand::Slower),
        ],
    },
    Line {
        shown: same("P"),
        what: ("Pause the selected machine, or let it go on", "Pausar a máquina selecionada, ou retomá-la"),
        keys: &[(NONE, Key::P, UserCommand::PauseNode)],
    },
    Line {
        shown: same("X  H  U"),
        what: ("It is off, hangs, is cut off; or well again", "Ela é desligada, trava, isola-se; ou volta"),
        keys: &[
            (NONE, Key::X, UserCommand::Put(Condition::Off)),
            (NONE, Key::H, UserCommand::Put(Condition::Hung)),
            (NONE, Key::U, UserCommand::Put(Condition::CutOff)),
        ],
    },
    Line {
        shown: ("Click", "Clique"),
        what: ("Inspect a pixel of the picture", "Inspecionar um pixel da imagem"),
        keys: &[],
    },
    Line {
        shown: ("Wheel", "Roda"),
        what: ("Zoom the picture or timeline; drag moves it", "Ampliar imagem ou linha do tempo; arrastar move"),
        keys: &[],
    },
    Line {
        shown: same("V"),
        what: ("Who traced it, what it cost, when it came", "Quem calculou, quanto custou, quando chegou"),
        keys: &[(NONE, Key::V, UserCommand::Layer)],
    },
    Line {
        shown: same("C"),
        what: ("Drag or arrows move the camera; Shift C: back", "Arrastar ou setas: câmera; Shift C: de volta"),
        keys: &[(NONE, Key::C, UserCommand::Camera), (SHIFT, Key::C, UserCommand::CameraHome)],
    },
    Line {
        shown: same("Page ↑  ↓"),
        what: ("The camera nearer, or further away", "A câmera mais perto, ou mais longe"),
        keys: &[(NONE, Key::PageUp, UserCommand::Dolly(true)), (NONE, Key::PageDown, UserCommand::Dolly(false))],
    },
    Line {
        shown: same("B"),
        what: ("Lines between bands, and from near atoms", "Linhas entre faixas e, de perto, átomos"),
        keys: &[(NONE, Key::B, UserCommand::Outlines)],
    },
    Line {
        shown: same("Ctrl Z"),
        what: ("Undo the last change of a speed or a setting", "Desfazer a última mudança de ajuste"),
        keys: &[(CTRL, Key::Z, UserCommand::Undo)],
    },
    Line {
        shown: same("Ctrl Y"),
        what: ("Redo", "Refazer"),
        keys: &[(CTRL.plus(Modifiers::SHIFT), Key::Z, UserCommand::Redo), (CTRL, Key::Y, UserCommand::Redo)],
    },
    // The keys of the zoom are egui's own.
    Line {
        shown: same("Ctrl +  −  0"),
        what: ("Everything larger, smaller, as usual", "Tudo maior, menor, normal"),
        keys: &[],
    },
    Line { shown: same("D"), what: ("Dark or light", "Escuro ou claro"), keys: &[(NONE, Key::D, UserCommand::Theme)] },
    Line {
        shown: same("Shift L"),
        what: ("English, or Portuguese", "Inglês, ou português"),
        keys: &[(SHIFT, Key::L, UserCommand::Language)],
    },
    Line {
        shown: same("F11"),
        what: ("For a projector: large, plain; Page ↓ ↑ go on", "Para o projetor: grande; Page ↓ ↑ avançam"),
        keys: &[(NONE, Key::F11, UserCommand::Projector)],
    },
    Line {
        shown: same("Alt Enter"),
        what: ("Full screen, or a window again", "Tela cheia, ou janela de novo"),
        keys: &[(Modifiers::ALT, Key::Enter, UserCommand::FullScreen)],
    },
    Line {
        shown: same("Esc"),
        what: ("Close what is open", "Fechar o que está aberto"),
        keys: &[(NONE, Key::Escape, UserCommand::Back)],
    },
    Line {
        shown: same("F1"),
        what: ("This list of keys", "Esta lista de teclas"),
        keys: &[(NONE, Key::F1, UserCommand::Help)],
    },
    Line { shown: same("Ctrl Q"), what: ("Quit", "Sair"), keys: &[(CTRL, Key::Q, UserCommand::Quit)] },
];

/// What the keys ask for. While somebody `types`, letters and digits are what is typed.
pub fn pressed(ctx: &Context, types: bool) -> Vec<UserCommand> {
    // Space and Enter press what has the focus, and arrows move it.
    let has_focus = ctx.memory(|memory| memory.focused().is_some());
    let mut commands = Vec::new();
    // The more modifiers, the sooner: Ctrl Shift Z is not Ctrl Z.
    let mut keys: Vec<_> = TABLE.iter().flat_map(|line| line.keys).collect();
    keys.sort_by_key(|(modifiers, ..)| std::cmp::Reverse(modifiers.shift));
    for &(modifiers, key, command) in keys {
        let plain = modifiers == NONE;
        let typed = plain && !matches!(key, Key::F1 | Key::F5 | Key::F11 | Key::Escape);
        let edits = matches!(command, UserCommand::Undo | UserCommand::Redo);
        let is_of_focus = key == Key::Space || matches!(command, UserCommand::Arrow(_) | UserCommand::StepUnit(..));
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
    if !types && !has_focus && ctx.input(|input| input.events.contains(&Event::Copy)) {
        commands.push(UserCommand::Copy);
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
