//! Why one run took longer than another, in a few sentences.

use std::time::Duration;

use super::time_budget::TimeBudget;
use crate::language::{Language, say, word};
use crate::time::Time;
use crate::view::text::format::{atoms_words, count, duration, fraction, node_name, ratio_words};

/// A run that came to its end, and what it is called.
#[derive(Clone, Copy, Debug)]
pub struct NamedBudget<'a> {
    /// What it is called.
    pub name: &'a str,
    /// What it amounts to.
    pub account: &'a TimeBudget,
}

/// Runs whose times differ by less than this are told to take the same time.
const SAME: f64 = 1.02;

/// What tells two runs apart: which took longer, and where its time went.
pub fn contrast(one: NamedBudget<'_>, other: NamedBudget<'_>, language: Language) -> String {
    let [quick, slow] = if one.account.makespan <= other.account.makespan { [one, other] } else { [other, one] };
    let times = slow.account.makespan.as_secs_f64() / quick.account.makespan.as_secs_f64().max(f64::MIN_POSITIVE);
    if times < SAME {
        return same(one, other, language);
    }
    let (name, takes, quicker, ratio) =
        (slow.name, duration(slow.account.makespan, language), quick.name, ratio_words(times, language));
    let mut told = say!(
        language,
        "{name} takes {takes}, {ratio} times as long as {quicker}.",
        "{name} leva {takes}, {ratio} vezes o tempo de {quicker}."
    );
    for sentence in [power(quick.account, slow.account, language), cause(quick.account, slow.account, language)]
        .into_iter()
        .flatten()
    {
        told.push(' ');
        told.push_str(&sentence);
    }
    told
}

/// Both take about as long.
fn same(one: NamedBudget<'_>, other: NamedBudget<'_>, language: Language) -> String {
    let (a, b) = (one.name, other.name);
    let [first, second] = [one, other].map(|run| duration(run.account.makespan, language));
    let least = one.account.efficiency().min(other.account.efficiency());
    let why = if least > 0.95 {
        word!(
            language,
            "Both keep all machines at work until the end.",
            "As duas mantêm todas as máquinas trabalhando até o fim."
        )
    } else {
        word!(language, "Both lose about as much.", "As duas perdem mais ou menos o mesmo.")
    };
    say!(
        language,
        "{a} and {b} take about the same time: {first} and {second}. {why}",
        "{a} e {b} levam quase o mesmo tempo: {first} e {second}. {why}"
    )
}

/// The machines themselves are not the same.
fn power(quick: &TimeBudget, slow: &TimeBudget, language: Language) -> Option<String> {
    // As long as both go on: what is set later in one of them explains nothing.
    let [of_quick, of_slow] = [quick, slow].map(|run| run.power(Time::ZERO + quick.makespan));
    let times = of_quick / of_slow.max(f64::MIN_POSITIVE);
    let ratio = ratio_words(times, language);
    (times > SAME).then(|| {
        say!(
            language,
            "Its machines together are slower: the other's are worth {ratio} times as much.",
            "Suas máquinas, juntas, são mais lentas: as da outra valem {ratio} vezes mais."
        )
    })
}

/// Where the slower run's time went that the quicker one's did not.
fn cause(quick: &TimeBudget, slow: &TimeBudget, language: Language) -> Option<String> {
    // Shares of the machines' time, so that more machines do not count for more waiting.
    let excess = |part: Part| {
        let seconds = |account: &TimeBudget| part(account) / account.spent.sum() * account.makespan.as_secs_f64();
        seconds(slow) - seconds(quick)
    };
    let parts: [(Part, Tell); 4] = [
        (|account| account.spent.waiting, waiting),
        (|account| account.spent.asking, asking),
        (|account| account.spent.starting, starting),
        (|account| account.spent.stopped, stopped),
    ];
    let (most, tell) = parts.into_iter().map(|(part, tell)| (excess(part), tell)).max_by(|a, b| a.0.total_cmp(&b.0))?;
    let lost = slow.makespan.as_secs_f64() - quick.makespan.as_secs_f64();
    // What explains little of it is no cause.
    (most > 0.2 * lost).then(|| tell(quick, slow, language))
}

/// Seconds of a run's machines that were spent on something.
type Part = fn(&TimeBudget) -> f64;

/// Tells of the slower run, its second argument.
type Tell = fn(&TimeBudget, &TimeBudget, Language) -> String;

/// Machines were done while others still traced.
fn waiting(quick: &TimeBudget, slow: &TimeBudget, language: Language) -> String {
    let last = slow.last;
    let (name, alone, share) =
        (node_name(last.node), duration(last.alone, language), fraction(share(slow, slow.spent.waiting)));
    let traced = atoms_words(last.traced, language);
    let is_slow = last.speed < 0.5;
    let speed = fraction(last.speed);
    let who = if is_slow {
        say!(language, "machine {name}, which is slow ({speed}),", "a máquina {name}, que é lenta ({speed}),")
    } else {
        say!(language, "machine {name}", "a máquina {name}")
    };
    let long = last.alone > slow.makespan / 10;
    let wait = if long {
        say!(
            language,
            "There {who} traces {traced} and is alone for the last {alone}, while all others wait.",
            "Nela {who} calcula {traced} e fica sozinha nos últimos {alone}, enquanto todas as outras esperam."
        )
    } else {
        say!(
            language,
            "There machines that are done wait for the others, {share} of their time.",
            "Nela as máquinas que terminaram esperam pelas outras, {share} do seu tempo."
        )
    };
    let moved = quick.messages.atoms_moved;
    if moved > 0 && slow.messages.atoms_moved == 0 {
        let (atoms, times) = (atoms_words(moved, language), count(quick.messages.transfers));
        let helped = say!(
            language,
            "In the other run whoever is done takes over atoms: {atoms} in {times} transfers.",
            "Na outra, quem termina assume átomos: {atoms} em {times} transferências."
        );
        return format!("{wait} {helped}");
    }
    wait
}

/// Machines waited for messages in the middle of the work.
fn asking(_: &TimeBudget, slow: &TimeBudget, language: Language) -> String {
    let share = fraction(share(slow, slow.spent.asking));
    let waited = slow.waited_at_parent;
    // Only what comes to it keeps the parent busy.
    let arrived = slow.messages.requests + slow.messages.results;
    let (messages, wait) = (count(arrived), duration(waited, language));
    if slow.sharing.is_farm() && waited > Duration::from_millis(1) {
        say!(
            language,
            "There machines wait {share} of their time for more work: the parent is busy with {messages} messages, \
             which stand in line for {wait} together.",
            "Nela as máquinas passam {share} do tempo à espera de trabalho: o pai se ocupa de {messages} mensagens, \
             que somam {wait} na fila."
        )
    } else {
        say!(
            language,
            "There machines wait {share} of their time between atoms, while offers, requests and atoms are on their way.",
            "Nela as máquinas passam {share} do tempo entre átomos, enquanto ofertas, pedidos e átomos estão a caminho."
        )
    }
}

/// Machines waited for their first atom.
fn starting(_: &TimeBudget, slow: &TimeBudget, language: Language) -> String {
    let estimating = duration(slow.estimating, language);
    let share = fraction(share(slow, slow.spent.starting));
    if slow.estimating > Duration::ZERO {
        say!(
            language,
            "There all wait {estimating} while the parent samples the picture to guess what each part costs.",
            "Nela todas esperam {estimating} enquanto o pai amostra a imagem para estimar quanto custa cada parte."
        )
    } else {
        say!(
            language,
            "There machines wait {share} of their time for their first atoms.",
            "Nela as máquinas esperam {share} do tempo pelos primeiros átomos."
        )
    }
}

/// Machines with atoms were stopped.
fn stopped(_: &TimeBudget, slow: &TimeBudget, language: Language) -> String {
    let share = fraction(share(slow, slow.spent.stopped));
    say!(
        language,
        "There machines that were stopped hold atoms for {share} of the time.",
        "Nela máquinas paradas seguram átomos durante {share} do tempo."
    )
}

fn share(of: &TimeBudget, part: f64) -> f64 {
    part / of.spent.sum().max(f64::MIN_POSITIVE)
}
