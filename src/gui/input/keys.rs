//! Which key does what. One table serves both the keys themselves and the page that lists them.

use egui::{Context, Event, Key, Modifiers};

use crate::balance::{Condition, NodeId};
use crate::language::word;
use crate::view::{About, Step};

/// What can be asked for, by a key or by a button.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    /// Stand still, or go on.
    Pause,
    /// A new run.
    Restart,
    /// What happened next (`true`) or before.
    Step(Step, bool),
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
    Jump(usize, About),
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
    keys: &'static [(Modifiers, Key, Command)],
}

/// The same in English and in Portuguese.
type Both = (&'static str, &'static str);

/// What is on the keys themselves.
const fn same(shown: &'static str) -> Both {
    (shown, shown)
}

impl Line {
    /// What the keys are called.
    pub fn shown(&self) -> &'static str {
        word!(self.shown.0, self.shown.1)
    }

    /// What they do.
    pub fn what(&self) -> &'static str {
        word!(self.what.0, self.what.1)
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
        keys: &[(NONE, Key::Space, Command::Pause)],
    },
    Line {
        shown: same("←  →"),
        what: ("An event back or on; or the pixel beside", "Um evento atrás ou adiante; ou o pixel ao lado"),
        keys: &[
            (NONE, Key::ArrowLeft, Command::Arrow([-1, 0])),
            (NONE, Key::ArrowRight, Command::Arrow([1, 0])),
            (NONE, Key::ArrowUp, Command::Arrow([0, -1])),
            (NONE, Key::ArrowDown, Command::Arrow([0, 1])),
        ],
    },
    Line {
        shown: same("Shift ←  →"),
        what: ("An atom back or on", "Um átomo atrás ou adiante"),
        keys: &[
            (SHIFT, Key::ArrowLeft, Command::Step(Step::Atom, false)),
            (SHIFT, Key::ArrowRight, Command::Step(Step::Atom, true)),
        ],
    },
    Line {
        shown: same("Ctrl ←  →"),
        what: ("An offer back or on, from when it is made", "Uma oferta atrás ou adiante, ao ser feita"),
        keys: &[
            (CTRL, Key::ArrowLeft, Command::Step(Step::Lap, false)),
            (CTRL, Key::ArrowRight, Command::Step(Step::Lap, true)),
        ],
    },
    Line {
        shown: same(",  ."),
        what: ("Time goes slower, or faster", "O tempo passa mais devagar, ou mais depressa"),
        keys: &[(NONE, Key::Comma, Command::Rate(false)), (NONE, Key::Period, Command::Rate(true))],
    },
    Line {
        shown: same("Home"),
        what: ("To the beginning", "Ao início"),
        keys: &[(NONE, Key::Home, Command::Beginning)],
    },
    Line {
        shown: same("L"),
        what: ("Live: what happens now; or the end", "Ao vivo: o que acontece agora; ou o fim"),
        keys: &[(NONE, Key::L, Command::Live), (NONE, Key::End, Command::Live)],
    },
    Line {
        shown: same("F"),
        what: ("Find the first offer, the biggest transfer …", "Achar a primeira oferta, a maior transferência …"),
        keys: &[(NONE, Key::F, Command::Find), (CTRL, Key::F, Command::Find)],
    },
    Line {
        shown: same("T"),
        what: ("The timeline, or the machines", "A linha do tempo, ou as máquinas"),
        keys: &[(NONE, Key::T, Command::Timeline)],
    },
    Line {
        shown: same("Ctrl ↑  ↓"),
        what: ("Zoom the timeline", "Ampliar a linha do tempo"),
        keys: &[(CTRL, Key::ArrowUp, Command::Zoom(true)), (CTRL, Key::ArrowDown, Command::Zoom(false))],
    },
    Line {
        shown: same("R"),
        what: ("Restart with what is set", "Reiniciar com o que está ajustado"),
        keys: &[(NONE, Key::R, Command::Restart)],
    },
    Line {
        shown: same("S"),
        what: ("Save a picture, or the run", "Salvar uma imagem, ou a execução"),
        keys: &[(NONE, Key::S, Command::Save), (CTRL, Key::S, Command::Save)],
    },
    Line {
        shown: same("Ctrl Shift S"),
        what: ("Save the run; then Enter", "Salvar a execução; depois, Enter"),
        keys: &[(CTRL.plus(SHIFT), Key::S, Command::SaveRun)],
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
        keys: &[(NONE, Key::O, Command::Scenes), (CTRL, Key::O, Command::Scenes)],
    },
    Line {
        shown: same("A"),
        what: ("Accuracy: what other qualities cost", "Precisão: o que custam outras qualidades"),
        keys: &[(NONE, Key::A, Command::Accuracy)],
    },
    Line {
        shown: same("N"),
        what: ("Learn: lessons with questions", "Aprender: lições com perguntas"),
        keys: &[(NONE, Key::N, Command::Learn)],
    },
    Line {
        shown: same("K"),
        what: ("Compare: the same by other strategies", "Comparar: o mesmo com outras estratégias"),
        keys: &[(NONE, Key::K, Command::Compare)],
    },
    Line {
        shown: same("F5"),
        what: ("Read the scene's file again", "Ler de novo o arquivo da cena"),
        keys: &[(NONE, Key::F5, Command::Reload)],
    },
    Line {
        shown: same("E"),
        what: ("Set up machines, picture and strategy", "Ajustar máquinas, imagem e estratégia"),
        keys: &[(NONE, Key::E, Command::Setup)],
    },
    Line {
        shown: same("1 … 9"),
        what: ("Select a machine; answer; choose of a list", "Selecionar máquina; responder; escolher da lista"),
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
        shown: same("+  −"),
        what: ("The selected machine faster, or slower", "A máquina selecionada mais rápida, ou mais lenta"),
        keys: &[
            (NONE, Key::Plus, Command::Faster),
            (NONE, Key::Equals, Command::Faster),
            (NONE, Key::Minus, Command::Slower),
        ],
    },
    Line {
        shown: same("P"),
        what: ("Pause the selected machine, or let it go on", "Pausar a máquina selecionada, ou retomá-la"),
        keys: &[(NONE, Key::P, Command::PauseNode)],
    },
    Line {
        shown: same("X  H  U"),
        what: ("It is off, hangs, is cut off; or well again", "Ela é desligada, trava, isola-se; ou volta"),
        keys: &[
            (NONE, Key::X, Command::Put(Condition::Off)),
            (NONE, Key::H, Command::Put(Condition::Hung)),
            (NONE, Key::U, Command::Put(Condition::CutOff)),
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
        keys: &[(NONE, Key::V, Command::Layer)],
    },
    Line {
        shown: same("C"),
        what: ("Drag or arrows move the camera; Shift C: back", "Arrastar ou setas: câmera; Shift C: de volta"),
        keys: &[(NONE, Key::C, Command::Camera), (SHIFT, Key::C, Command::CameraHome)],
    },
    Line {
        shown: same("Page ↑  ↓"),
        what: ("The camera nearer, or further away", "A câmera mais perto, ou mais longe"),
        keys: &[(NONE, Key::PageUp, Command::Dolly(true)), (NONE, Key::PageDown, Command::Dolly(false))],
    },
    Line {
        shown: same("B"),
        what: ("Lines between bands, and from near atoms", "Linhas entre faixas e, de perto, átomos"),
        keys: &[(NONE, Key::B, Command::Outlines)],
    },
    Line {
        shown: same("Ctrl Z"),
        what: ("Undo the last change of a speed or a setting", "Desfazer a última mudança de ajuste"),
        keys: &[(CTRL, Key::Z, Command::Undo)],
    },
    Line {
        shown: same("Ctrl Y"),
        what: ("Redo", "Refazer"),
        keys: &[(CTRL.plus(Modifiers::SHIFT), Key::Z, Command::Redo), (CTRL, Key::Y, Command::Redo)],
    },
    // The keys of the zoom are egui's own.
    Line {
        shown: same("Ctrl +  −  0"),
        what: ("Everything larger, smaller, as usual", "Tudo maior, menor, normal"),
        keys: &[],
    },
    Line { shown: same("D"), what: ("Dark or light", "Escuro ou claro"), keys: &[(NONE, Key::D, Command::Theme)] },
    Line {
        shown: same("Shift L"),
        what: ("English, or Portuguese", "Inglês, ou português"),
        keys: &[(SHIFT, Key::L, Command::Language)],
    },
    Line {
        shown: same("F11"),
        what: ("For a projector: large, plain; Page ↓ ↑ go on", "Para o projetor: grande; Page ↓ ↑ avançam"),
        keys: &[(NONE, Key::F11, Command::Projector)],
    },
    Line {
        shown: same("Alt Enter"),
        what: ("Full screen, or a window again", "Tela cheia, ou janela de novo"),
        keys: &[(Modifiers::ALT, Key::Enter, Command::FullScreen)],
    },
    Line {
        shown: same("Esc"),
        what: ("Close what is open", "Fechar o que está aberto"),
        keys: &[(NONE, Key::Escape, Command::Back)],
    },
    Line {
        shown: same("F1"),
        what: ("This list of keys", "Esta lista de teclas"),
        keys: &[(NONE, Key::F1, Command::Help)],
    },
    Line { shown: same("Ctrl Q"), what: ("Quit", "Sair"), keys: &[(CTRL, Key::Q, Command::Quit)] },
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
        let is_of_focus = key == Key::Space || matches!(command, Command::Arrow(_) | Command::Step(..));
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
        commands.push(Command::Copy);
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
