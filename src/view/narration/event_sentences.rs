//! Sentences for the events of a run.

use std::time::Duration;

use super::happening::{Happening, OfferReason, PauseEffect, Retirement, SpeedEffect};
use super::transfer_sentences::{self, Transfer};
use crate::balance::{NodeId, Party, Scheduler, Strategy};
use crate::language::{Language, say, word};
use crate::view::text::format::{atoms_words, counted, duration, fraction, names, node_name};

/// Returns the sentence for a run in virtual time that has no records yet, because its costs are not known.
pub fn before_virtual_time(language: Language) -> &'static str {
    word!(
        language,
        "Virtual time begins when the picture is traced and all costs are known",
        "O tempo virtual começa quando a imagem está calculada e todos os custos são conhecidos"
    )
}

impl Happening {
    /// Puts it into one sentence without a full stop.
    pub fn sentence(&self, language: Language) -> String {
        match self {
            Self::Complete => word!(language, "The picture is complete", "A imagem está completa").into(),
            Self::Estimating => word!(
                language,
                "The parent samples the picture to estimate the cost of each part",
                "O pai amostra a imagem para estimar o custo de cada parte"
            )
            .into(),
            Self::Bands { machines, first, is_whole, scheduler } => {
                bands(language, *machines, *first, *is_whole, scheduler)
            }
            &Self::Part { to, atoms } => part(language, to, atoms),
            &Self::PartsSoFar(parts) => {
                let parts = counted(parts, word!(language, "part", "parte"), language);
                say!(language, "The parent has handed out {parts} so far", "O pai já distribuiu {parts}")
            }
            Self::Queue { waiting, handling } => {
                let each = duration(*handling, language);
                say!(
                    language,
                    "{waiting} messages wait at the parent; it needs {each} for each",
                    "{waiting} mensagens esperam pelo pai; ele leva {each} em cada uma"
                )
            }
            Self::BandsDone(nodes) => bands_done(language, nodes),
            Self::Retired { nodes, reason } => retired(language, nodes, *reason),
            &Self::Offer { node, reason } => offer(language, node, reason),
            &Self::Theft { thief, from, atoms } => transfer_sentences::theft(language, thief, from, atoms),
            &Self::Takeover { from, to, atoms, giver, share, is_early, unreached } => {
                let transfer = Transfer { from, to, atoms, waiting: share.map_or(atoms, |share| share.waiting) };
                match (unreached, share) {
                    (Some(unreached), _) => transfer.before(unreached, language),
                    (None, share) => transfer.takeover(giver, share, is_early, language),
                }
            }
            &Self::Gift { from, to, atoms, waiting, slow_at } => {
                Transfer { from, to, atoms, waiting }.gift(slow_at, language)
            }
            Self::SmallTransfers { from, to, transfers, atoms, is_theft } => {
                transfer_sentences::small_transfers(language, (*from, to), (*transfers, *atoms), *is_theft)
            }
            &Self::Speed { node, speed, effect } => self::speed(language, node, speed, effect),
            &Self::Paused { node, atoms, effect } => paused(language, node, atoms, effect),
            &Self::Resumed { node, is_stopped } => {
                let name = node_name(node);
                if is_stopped {
                    say!(
                        language,
                        "Machine {name} is not paused any more, but its speed is 0 %",
                        "A máquina {name} não está mais em pausa, mas sua velocidade é 0 %"
                    )
                } else {
                    say!(language, "Machine {name} continues", "A máquina {name} continua")
                }
            }
            &Self::Latency { latency, is_hop } => {
                let what = if is_hop {
                    word!(language, "A hop", "Um salto")
                } else {
                    word!(language, "A message", "Uma mensagem")
                };
                let takes = duration(latency, language);
                if latency.is_zero() {
                    say!(language, "{what} now takes no time", "{what} agora não leva tempo")
                } else {
                    say!(language, "{what} now takes {takes}", "{what} agora leva {takes}")
                }
            }
            &Self::OwnLatency { party, latency } => own_latency(language, party, latency),
            Self::Failure(failure) => failure.sentence(language),
        }
    }
}

fn own_latency(language: Language, party: Party, latency: Option<Duration>) -> String {
    let whose = match party {
        Party::Parent => word!(language, "the parent", "o pai").to_owned(),
        Party::Node(node) => {
            let name = node_name(node);
            say!(language, "machine {name}", "a máquina {name}")
        }
    };
    match latency {
        None => say!(
            language,
            "A message from or to {whose} takes no longer than usual now",
            "Uma mensagem entre {whose} e as outras não demora mais que o usual agora"
        ),
        Some(latency) => {
            let takes = duration(latency, language);
            say!(
                language,
                "A message from or to {whose} now takes at least {takes}",
                "Uma mensagem entre {whose} e as outras agora leva ao menos {takes}"
            )
        }
    }
}

fn bands(language: Language, machines: usize, first: u32, is_whole: bool, scheduler: &Scheduler) -> String {
    match machines {
        1 if *scheduler == Scheduler::WorkStealing => {
            word!(language, "One thread traces the picture", "Uma thread calcula a imagem").into()
        }
        _ if *scheduler == Scheduler::WorkStealing => say!(
            language,
            "{machines} threads trace the picture; an idle thread steals from another",
            "{machines} threads calculam a imagem; uma thread ociosa rouba de outra"
        ),
        1 if scheduler.is_farm() => {
            let part = atoms_words(first, language);
            say!(
                language,
                "The parent gives the only machine a first part: {part}",
                "O pai dá à única máquina uma primeira parte: {part}"
            )
        }
        _ if scheduler.is_farm() => {
            let part = atoms_words(first, language);
            say!(
                language,
                "The parent gives each of {machines} emulated machines a first part: {part}",
                "O pai dá a cada uma das {machines} máquinas emuladas uma primeira parte: {part}"
            )
        }
        1 => word!(
            language,
            "The parent gives the only machine the whole picture",
            "O pai dá à única máquina a imagem inteira"
        )
        .into(),
        _ if is_whole => word!(
            language,
            "The parent gives one machine the whole picture",
            "O pai dá a imagem inteira a uma só máquina"
        )
        .into(),
        _ if *scheduler == Scheduler::Protocol(Strategy::StaticEstimate) => say!(
            language,
            "The parent gives each of {machines} emulated machines a band that should cost the same",
            "O pai dá a cada uma das {machines} máquinas emuladas uma faixa que deve custar o mesmo"
        ),
        _ => say!(
            language,
            "The parent gives each of {machines} emulated machines an equal band of the picture",
            "O pai dá a cada uma das {machines} máquinas emuladas uma faixa igual da imagem"
        ),
    }
}

fn part(language: Language, to: NodeId, atoms: u32) -> String {
    let (name, gets) = (node_name(to), atoms_words(atoms, language));
    match atoms {
        0 => say!(
            language,
            "{name} asks for more, but the parent has no more: {name} is no longer needed",
            "{name} pede mais, mas o pai não tem mais: {name} não é mais necessária"
        ),
        _ => {
            say!(language, "{name} asks the parent for more and gets {gets}", "{name} pede mais ao pai e recebe {gets}")
        }
    }
}

fn bands_done(language: Language, nodes: &[NodeId]) -> String {
    let who = names(nodes, language);
    match nodes {
        [_] => say!(
            language,
            "{who} has finished and waits: nobody shares with it",
            "{who} terminou e espera: ninguém divide com ela"
        ),
        _ => say!(
            language,
            "{who} have finished and wait: nobody shares with them",
            "{who} terminaram e esperam: ninguém divide com elas"
        ),
    }
}

fn retired(language: Language, nodes: &[NodeId], reason: Retirement) -> String {
    let who = names(nodes, language);
    match (nodes, reason) {
        ([_], Retirement::NothingLeft) => {
            say!(
                language,
                "{who} asked for more, but the parent has no more",
                "{who} pediu mais, mas o pai não tem mais"
            )
        }
        (_, Retirement::NothingLeft) => {
            say!(
                language,
                "{who} asked for more, but the parent has no more",
                "{who} pediram mais, mas o pai não tem mais"
            )
        }
        ([_], Retirement::Sleeps) => {
            say!(language, "{who} sleeps until it is needed", "{who} dorme até ser necessária")
        }
        (_, Retirement::Sleeps) => {
            say!(language, "{who} sleep until they are needed", "{who} dormem até serem necessárias")
        }
        ([_], Retirement::OfferCameBack) => say!(
            language,
            "{who}'s offer came back: nobody needs its help, and it retires",
            "A oferta de {who} voltou: ninguém precisa de ajuda, e ela é dispensada"
        ),
        (_, Retirement::OfferCameBack) => say!(
            language,
            "{who} retire: their offers came back, nobody needs their help",
            "{who} são dispensadas: suas ofertas voltaram, ninguém precisa de ajuda"
        ),
    }
}

fn offer(language: Language, node: NodeId, reason: OfferReason) -> String {
    let name = node_name(node);
    match reason {
        OfferReason::Early => say!(
            language,
            "{name} has nearly finished and offers help round the ring",
            "{name} está quase pronta e oferece ajuda pelo anel"
        ),
        OfferReason::NothingToTrace => say!(
            language,
            "{name} has nothing to trace and offers help round the ring",
            "{name} não tem nada a calcular e oferece ajuda pelo anel"
        ),
        OfferReason::BandDone => say!(
            language,
            "{name} has finished its band and offers help round the ring",
            "{name} terminou sua faixa e oferece ajuda pelo anel"
        ),
        OfferReason::NoAtomsLeft => say!(
            language,
            "{name} has no atoms left and offers help round the ring",
            "{name} não tem mais átomos e oferece ajuda pelo anel"
        ),
    }
}

fn speed(language: Language, node: NodeId, speed: f64, effect: SpeedEffect) -> String {
    let (name, new) = (node_name(node), fraction(speed));
    let effect = match effect {
        SpeedEffect::AfterPause => {
            return say!(
                language,
                "Machine {name} is paused; it will continue at {new}",
                "A máquina {name} está em pausa; vai continuar a {new}"
            );
        }
        SpeedEffect::None => None,
        SpeedEffect::NobodyHelps => {
            Some(word!(language, "nobody will take over its work", "ninguém vai assumir seu trabalho"))
        }
        SpeedEffect::BandSooner => {
            Some(word!(language, "it will finish its band sooner", "vai terminar sua faixa antes"))
        }
        SpeedEffect::AsksLess => Some(word!(language, "it will ask less often", "vai pedir menos vezes")),
        SpeedEffect::AsksMore => Some(word!(language, "it will ask more often", "vai pedir mais vezes")),
        SpeedEffect::KeepsPart => Some(word!(language, "it keeps its atoms", "fica com seus átomos")),
        SpeedEffect::PartReturns => Some(word!(
            language,
            "after a long time the parent gives its atoms out again",
            "depois de muito tempo o pai dá de novo seus átomos"
        )),
        SpeedEffect::OthersHelp => {
            Some(word!(language, "the others will take over its work", "as outras vão assumir seu trabalho"))
        }
        SpeedEffect::AnswersFirst(first) => {
            let first = node_name(first);
            return say!(
                language,
                "Machine {name} is stopped: {first} answers offers first, then the others take over its work",
                "A máquina {name} está parada: {first} responde antes às ofertas, depois as outras assumem seu trabalho"
            );
        }
        SpeedEffect::AtomsSooner => {
            Some(word!(language, "it will trace its last atoms sooner", "vai calcular antes seus últimos átomos"))
        }
        SpeedEffect::Retired => {
            Some(word!(language, "it has retired and takes no more work", "foi dispensada e não assume mais trabalho"))
        }
        SpeedEffect::TakesMore => Some(word!(language, "it can take more work", "pode assumir mais trabalho")),
    };
    let runs = if speed == 0.0 {
        say!(language, "Machine {name} is stopped", "A máquina {name} está parada")
    } else {
        say!(language, "Machine {name} now runs at {new}", "A máquina {name} agora trabalha a {new}")
    };
    effect.map_or_else(|| runs.clone(), |effect| format!("{runs}: {effect}"))
}

fn paused(language: Language, node: NodeId, atoms: u32, effect: PauseEffect) -> String {
    let (name, count) = (node_name(node), atoms);
    let paused = say!(language, "Machine {name} is paused", "A máquina {name} está em pausa");
    let atoms = atoms_words(atoms, language);
    match effect {
        PauseEffect::None => paused,
        PauseEffect::KeepsPart => {
            say!(language, "{paused} and keeps the {atoms} of its part", "{paused} e fica com {atoms} de sua parte")
        }
        PauseEffect::PartReturns => say!(
            language,
            "{paused} with {atoms}: after a long time the parent gives them out again",
            "{paused} com {atoms}: depois de muito tempo o pai os dá de novo"
        ),
        PauseEffect::NobodyHelps => say!(
            language,
            "{paused} with {atoms}: nobody will take over its work",
            "{paused} com {atoms}: ninguém vai assumir seu trabalho"
        ),
        PauseEffect::KeepsPipe if count == 1 => {
            say!(language, "{paused} and keeps the atom in its pipe", "{paused} e fica com o átomo em seu pipe")
        }
        PauseEffect::KeepsPipe => {
            say!(language, "{paused} and keeps the {atoms} in its pipe", "{paused} e fica com os {atoms} em seu pipe")
        }
        PauseEffect::AnswersFirst(first) => {
            let first = node_name(first);
            say!(
                language,
                "{paused}: {first} answers offers first, then the others take over its work",
                "{paused}: {first} responde antes às ofertas, depois as outras assumem seu trabalho"
            )
        }
        PauseEffect::OthersHelp => {
            say!(
                language,
                "{paused}: the others will take over its work",
                "{paused}: as outras vão assumir seu trabalho"
            )
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::balance::{Message, Party};
    use crate::record::{Record, RecordKind};
    use crate::time::Time;
    use crate::view::state::run_state::RunState;
    use crate::view::tests::sample_runs;

    /// A run by `strategy` in which each of two machines has nine atoms.
    fn run(strategy: Strategy) -> RunState {
        let mut header = sample_runs::header(&[1.0, 1.0], 90);
        header.rules.strategy = strategy;
        let mut state = RunState::new(&header);
        for (id, node) in [(0, 0), (1, 1)] {
            let (from, to, message) = (Party::Parent, Party::Node(node), Message::Band(9 * id..9 * id + 9));
            let (at, id) = (Time::ZERO, u64::from(id));
            state.apply(&Record { at, kind: RecordKind::Sent { id, from, to, message, bytes: 0, arrives: at } });
            state.apply(&Record { at, kind: RecordKind::Received { id, by: to } });
        }
        state
    }

    #[test]
    fn effect_of_a_change_depends_on_the_strategy() {
        let said = |strategy| {
            let state = run(strategy);
            let set = |before, now| {
                let sentence = Happening::speed(&state, 1, before, now).sentence(Language::English);
                sentence.split_once(": ").expect("an effect").1.to_owned()
            };
            [set(1.0, 0.5), set(0.5, 1.0), set(1.0, 0.0)]
        };
        assert_eq!(
            said(Strategy::Static),
            ["nobody will take over its work", "it will finish its band sooner", "nobody will take over its work"]
        );
        assert_eq!(said(Strategy::Farm), ["it will ask less often", "it will ask more often", "it keeps its atoms"]);
        let others = "the others will take over its work";
        assert_eq!(said(Strategy::Ring), [others, "it can take more work", others]);
        assert_eq!(
            Happening::paused(&run(Strategy::Farm), 1).sentence(Language::English),
            "Machine 2 is paused and keeps the 9 atoms of its part"
        );
        assert_eq!(
            Happening::paused(&run(Strategy::Static), 1).sentence(Language::English),
            "Machine 2 is paused with 9 atoms: nobody will take over its work"
        );
        let ms = Duration::from_millis(90);
        assert_eq!(
            Happening::latency(&run(Strategy::Farm), ms).sentence(Language::English),
            "A message now takes 90 ms"
        );
    }
}
