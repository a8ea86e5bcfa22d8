//! What one event is called in a sentence, whether it is said large or kept in the list.

use std::cmp::Ordering;
use std::ops::Range;
use std::time::Duration;

use crate::balance::{NodeId, PIPE_ATOMS, Remedy, Strategy};
use crate::language::{say, word};
use crate::picture::Atom;
use crate::view::state::node_state::NodeState;
use crate::view::state::run_state::RunState;
use crate::view::state::scheduler::Sharing;
use crate::view::text::format::{atoms_words, duration, fraction, names, node_name};

/// The last event of a run that came to its end.
pub(crate) fn complete() -> &'static str {
    word!("The picture is complete", "A imagem está completa")
}

/// In virtual time every atom's cost is known when the run begins.
pub(crate) fn before_virtual_time() -> &'static str {
    word!(
        "Virtual time begins once the picture is traced, and its costs are known",
        "O tempo virtual começa depois de calculada a imagem e conhecidos os custos"
    )
}

/// The parent hands out the bands, of which this is the first.
pub(crate) fn bands(state: &RunState, first: &Range<Atom>) -> String {
    match state.nodes().iter().filter(|node| !node.spare).count() {
        machines if state.sharing == Sharing::Stealing => say!(
            "{machines} threads trace the picture: whoever is idle steals from another",
            "{machines} threads calculam a imagem: quem fica ociosa rouba de outra"
        ),
        machines if state.sharing.is_farm() => {
            let part = atoms_words(first.len() as u32);
            say!(
                "The parent gives each of {machines} machines a first part: {part}",
                "O pai dá a cada uma das {machines} máquinas uma primeira parte: {part}"
            )
        }
        1 => word!("The parent gives the only machine the whole picture", "O pai dá à única máquina a imagem inteira")
            .into(),
        _ if first.len() as u32 == state.atoms() => {
            word!("The parent gives one machine the whole picture", "O pai dá a imagem inteira a uma só máquina").into()
        }
        machines if state.sharing == Sharing::By(Strategy::StaticEstimate) => say!(
            "The parent gives each of {machines} machines a band that should cost the same",
            "O pai dá a cada uma das {machines} máquinas uma faixa que deve custar o mesmo"
        ),
        machines => say!(
            "The parent gives each of {machines} machines an equal band of the picture",
            "O pai dá a cada uma das {machines} máquinas uma faixa igual da imagem"
        ),
    }
}

/// The parent learns what the picture costs before it hands out bands.
pub(crate) fn estimating() -> &'static str {
    word!(
        "The parent samples the picture to guess what each part costs",
        "O pai amostra a imagem para estimar quanto custa cada parte"
    )
}

/// The parent of a farm has answered a node that asked.
pub(crate) fn part(to: NodeId, atoms: u32) -> String {
    let (name, gets) = (node_name(to), atoms_words(atoms));
    match atoms {
        0 => say!(
            "{name} asks the parent for more, but all is given away: it is no longer needed",
            "{name} pede mais ao pai, mas tudo já foi dado: ela não é mais necessária"
        ),
        _ => say!("{name} asks the parent for more and gets {gets}", "{name} pede mais ao pai e recebe {gets}"),
    }
}

/// So many messages wait at the parent.
pub(crate) fn jam(state: &RunState, most: usize) -> String {
    let each = duration(state.handling);
    say!(
        "{most} messages wait at the parent, which needs {each} for each",
        "{most} mensagens esperam pelo pai, que leva {each} em cada uma"
    )
}

/// Machines are done with their bands, and not all are.
pub(crate) fn done(nodes: &[NodeId]) -> String {
    let who = names(nodes);
    match nodes {
        [_] => {
            say!("{who} is done and waits: nobody shares with it", "{who} terminou e espera: ninguém divide com ela")
        }
        _ => say!(
            "{who} are done and wait: nobody shares with them",
            "{who} terminaram e esperam: ninguém divide com elas"
        ),
    }
}

/// Machines are no longer needed.
pub(crate) fn retired(state: &RunState, nodes: &[NodeId]) -> String {
    let who = names(nodes);
    match (nodes, state.sharing.is_farm()) {
        ([_], true) => say!("{who} asked for more, but all is given away", "{who} pediu mais, mas tudo já foi dado"),
        (_, true) => say!("{who} asked for more, but all is given away", "{who} pediram mais, mas tudo já foi dado"),
        ([_], false) if state.has(Remedy::Wake) => {
            say!("{who} sleeps until somebody needs it", "{who} dorme até que alguém precise dela")
        }
        (_, false) if state.has(Remedy::Wake) => {
            say!("{who} sleep until somebody needs them", "{who} dormem até que alguém precise delas")
        }
        ([_], false) => say!(
            "{who}'s offer came back, nobody needs its help: it retires",
            "A oferta de {who} voltou, ninguém quer ajuda: ela não é mais necessária"
        ),
        (_, false) => say!(
            "{who} retire: their offers came back, nobody needs their help",
            "{who} não são mais necessárias: suas ofertas voltaram, ninguém quer ajuda"
        ),
    }
}

/// A thread has stolen atoms.
pub(crate) fn theft(thief: NodeId, from: NodeId, atoms: u32) -> String {
    let (thief, atoms, from) = (node_name(thief), atoms_words(atoms), node_name(from));
    say!("{thief} steals {atoms} from {from}", "{thief} rouba {atoms} de {from}")
}

/// A machine has given few atoms at a time to others, or they were stolen from it.
pub(crate) fn trickle((from, to): (NodeId, &[NodeId]), (transfers, all): (u32, u32), is_theft: bool) -> String {
    let (giver, takers, words) = (node_name(from), names(to), atoms_words(all));
    if is_theft && to.len() == 1 {
        say!(
            "{takers} steals few atoms at a time from {giver}: {words}",
            "{takers} rouba poucos átomos por vez de {giver}: {words}"
        )
    } else if is_theft {
        say!(
            "{takers} steal few atoms at a time from {giver}: {words}",
            "{takers} roubam poucos átomos por vez de {giver}: {words}"
        )
    } else if to.len() == 1 {
        say!("{giver} gave {words} to {takers}", "{giver} deu {words} a {takers}")
    } else if all as usize == to.len() {
        say!("{giver} gave 1 atom to {takers}", "{giver} deu 1 átomo a {takers}")
    } else {
        say!(
            "{giver} gave few atoms at a time to {takers}: {all} in {transfers} parcels",
            "{giver} deu poucos átomos por vez a {takers}: {all} em {transfers} pacotes"
        )
    }
}

/// A machine that has nothing left to trace, or soon will have, offers help; `whole` if it has traced its whole band itself.
pub(crate) fn offer(state: &RunState, who: NodeId, whole: bool, done: u32) -> String {
    let name = node_name(who);
    let is_early = state.has(Remedy::Early) && state.nodes().get(usize::from(who)).is_some_and(|of| of.left() > 0);
    match (whole, done) {
        _ if is_early => say!(
            "{name} has nearly finished and offers help round the ring",
            "{name} está quase pronta e oferece ajuda pelo anel"
        ),
        (_, 0) => say!(
            "{name} has nothing to trace and offers help round the ring",
            "{name} não tem nada a calcular e oferece ajuda pelo anel"
        ),
        (true, _) => say!(
            "{name} has finished its band and offers help round the ring",
            "{name} terminou sua faixa e oferece ajuda pelo anel"
        ),
        (false, _) => say!(
            "{name} has no atoms left and offers help round the ring",
            "{name} não tem mais átomos e oferece ajuda pelo anel"
        ),
    }
}

/// A machine has given atoms to one that offered help.
pub(crate) fn transfer(state: &RunState, from: NodeId, to: NodeId, atoms: u32) -> String {
    if state.sharing == Sharing::Stealing {
        return theft(to, from, atoms);
    }
    let (giver, offerer) = (node_name(from), node_name(to));
    let busy = match state.nodes().get(usize::from(from)) {
        Some(node) if node.paused => word!("is paused", "está em pausa").into(),
        Some(node) if node.speed == 0.0 => word!("stands still", "está parada").into(),
        Some(node) if is_slow(node) => {
            let speed = fraction(node.speed);
            say!("is slow ({speed})", "é lenta ({speed})")
        }
        _ => word!("is still busy", "ainda está ocupada").into(),
    };
    let atoms = if atoms == 1 { word!("one atom", "um átomo").into() } else { atoms_words(atoms) };
    say!(
        "{offerer} has finished and takes over {atoms} from {giver}, which {busy}",
        "{offerer} terminou e assume {atoms} de {giver}, que {busy}"
    )
}

/// So slow that the others notice.
pub(crate) fn is_slow(node: &NodeState) -> bool {
    node.speed < 0.5
}

/// What a new speed means; `before` is the one before somebody began to change it.
pub(crate) fn speed(state: &RunState, node: NodeId, before: f64, speed: f64) -> String {
    let name = node_name(node);
    let new = fraction(speed);
    if state.nodes().get(usize::from(node)).is_some_and(|node| node.paused) {
        return say!(
            "Machine {name} is paused; it will go on at {new}",
            "A máquina {name} está em pausa; vai continuar a {new}"
        );
    }
    let runs = if speed == 0.0 {
        say!("Machine {name} is stopped", "A máquina {name} está parada")
    } else {
        say!("Machine {name} now runs at {new}", "A máquina {name} agora trabalha a {new}")
    };
    let than_before = speed.total_cmp(&before);
    let then = match than_before {
        Ordering::Equal => None,
        _ if state.sharing.is_fixed() => {
            let has_atoms = state.nodes().get(usize::from(node)).is_some_and(|machine| machine.left() > 0);
            let then = if than_before.is_lt() {
                word!("nobody will make up for it", "ninguém vai compensar")
            } else {
                word!("its band is done sooner", "sua faixa acaba antes")
            };
            has_atoms.then_some(then)
        }
        _ if state.sharing.is_farm() && speed > 0.0 => Some(if than_before.is_lt() {
            word!("it will ask less often", "vai pedir menos vezes")
        } else {
            word!("it will ask more often", "vai pedir mais vezes")
        }),
        _ if state.sharing.is_farm() => Some(word!("what it has stays with it", "o que tem fica com ela")),
        Ordering::Less => {
            others_run(state, node).then_some(word!("the others will make up for it", "as outras vão compensar"))
        }
        Ordering::Greater => Some(word!("it can take more work", "pode assumir mais trabalho")),
    };
    then.map_or_else(|| runs.clone(), |then| format!("{runs}: {then}"))
}

/// A machine was paused.
pub(crate) fn paused(state: &RunState, node: NodeId) -> String {
    let name = node_name(node);
    let paused = say!("Machine {name} is paused", "A máquina {name} está em pausa");
    let Some(machine) = state.nodes().get(usize::from(node)) else { return paused };
    let atoms = atoms_words(machine.left());
    match machine.left() {
        0 if !state.sharing.is_ring() && state.sharing != Sharing::Stealing => paused,
        _ if state.sharing.is_farm() => {
            say!("{paused} and keeps the {atoms} of its part", "{paused} e fica com {atoms} de sua parte")
        }
        _ if state.sharing.is_fixed() => say!(
            "{paused}: its {atoms} wait, nobody will make up for it",
            "{paused} com {atoms}: ninguém vai compensar"
        ),
        1 if !state.has(Remedy::Copies) => {
            say!("{paused} and keeps the atom in its pipe", "{paused} e fica com o átomo em seu pipe")
        }
        2..=PIPE_ATOMS if !state.has(Remedy::Copies) => {
            say!("{paused} and keeps the {atoms} in its pipe", "{paused} e fica com os {atoms} em seu pipe")
        }
        left if (left > 0 || machine.band_at.is_none()) && others_run(state, node) => {
            say!("{paused}: the others will make up for it", "{paused}: as outras vão compensar")
        }
        _ => paused,
    }
}

/// A paused machine goes on.
pub(crate) fn resumed(state: &RunState, node: NodeId) -> String {
    let name = node_name(node);
    match state.nodes().get(usize::from(node)) {
        Some(machine) if machine.speed == 0.0 => say!(
            "Machine {name} is no longer paused, but its speed is 0 %",
            "A máquina {name} saiu da pausa, mas sua velocidade é 0 %"
        ),
        _ => say!("Machine {name} goes on", "A máquina {name} continua"),
    }
}

/// All links have a new latency.
pub(crate) fn latency(state: &RunState, latency: Duration) -> String {
    let what = if state.sharing.is_ring() { word!("A hop", "Um salto") } else { word!("A message", "Uma mensagem") };
    let takes = duration(latency);
    if latency.is_zero() {
        say!("{what} takes no time now", "{what} agora não leva tempo")
    } else {
        say!("{what} takes {takes} now", "{what} agora leva {takes}")
    }
}

fn others_run(state: &RunState, node: NodeId) -> bool {
    (0..).zip(state.nodes()).any(|(other, machine)| other != node && machine.runs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::balance::{Message, Party};
    use crate::record::{Record, RecordKind};
    use crate::time::Time;
    use crate::view::tests::sample_runs;

    /// A run by this strategy in which each of two machines has nine atoms.
    fn run(strategy: Strategy) -> RunState {
        let mut header = sample_runs::header(&[1.0, 1.0], 90);
        header.rules.strategy = strategy;
        let mut state = RunState::new(&header);
        for (id, node) in [(0, 0), (1, 1)] {
            let (from, to, message) = (Party::Parent, Party::Node(node), Message::Band(9 * id..9 * id + 9));
            let (at, id) = (Time::ZERO, u64::from(id));
            state.apply(&Record { at, what: RecordKind::Sent { id, from, to, message, bytes: 0, arrives: at } });
            state.apply(&Record { at, what: RecordKind::Received { id, by: to } });
        }
        state
    }

    #[test]
    fn what_a_change_means_depends_on_how_atoms_are_shared() {
        let said = |strategy| {
            let state = run(strategy);
            let set = |before, now| speed(&state, 1, before, now).split_once(": ").expect("a meaning").1.to_owned();
            [set(1.0, 0.5), set(0.5, 1.0), set(1.0, 0.0)]
        };
        assert_eq!(
            said(Strategy::Static),
            ["nobody will make up for it", "its band is done sooner", "nobody will make up for it"]
        );
        assert_eq!(
            said(Strategy::Farm),
            ["it will ask less often", "it will ask more often", "what it has stays with it"]
        );
        let others = "the others will make up for it";
        assert_eq!(said(Strategy::Ring), [others, "it can take more work", others]);
        assert_eq!(paused(&run(Strategy::Farm), 1), "Machine 2 is paused and keeps the 9 atoms of its part");
        assert_eq!(
            paused(&run(Strategy::Static), 1),
            "Machine 2 is paused: its 9 atoms wait, nobody will make up for it"
        );
        let ms = Duration::from_millis(90);
        assert_eq!(latency(&run(Strategy::Farm), ms), "A message takes 90 ms now");
    }
}
