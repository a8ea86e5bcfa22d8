//! Explains in a few sentences why one run took longer than another.

use std::time::Duration;

use super::time_budget::TimeBudget;
use crate::language::{Language, say, word};
use crate::time::Time;
use crate::view::text::format::{atoms_words, count, counted, duration, fraction, node_name, ratio_words};

/// Time budget of a finished run, with the run's name.
#[derive(Clone, Copy, Debug)]
pub struct NamedBudget<'a> {
    /// Name of the run.
    pub name: &'a str,
    /// Its time budget.
    pub budget: &'a TimeBudget,
}

/// Greatest ratio of two makespans that count as the same time.
const MAX_EQUAL_RATIO: f64 = 1.02;

/// Says which of two runs took longer, and where its time went.
pub fn compare_runs(one: NamedBudget<'_>, other: NamedBudget<'_>, language: Language) -> String {
    let [quick, slow] = if one.budget.makespan <= other.budget.makespan { [one, other] } else { [other, one] };
    let times = slow.budget.makespan.as_secs_f64() / quick.budget.makespan.as_secs_f64().max(f64::MIN_POSITIVE);
    if times < MAX_EQUAL_RATIO {
        return same(one, other, language);
    }
    let (name, takes, quicker, ratio) =
        (slow.name, duration(slow.budget.makespan, language), quick.name, ratio_words(times, language));
    let mut text = say!(
        language,
        "{name} takes {takes}, {ratio} times as long as {quicker}.",
        "“{name}” leva {takes}, {ratio} vezes o tempo de “{quicker}”."
    );
    for sentence in
        [power(quick.budget, slow.budget, language), cause(quick.budget, slow.budget, language)].into_iter().flatten()
    {
        text.push(' ');
        text.push_str(&sentence);
    }
    text
}

/// Says that both runs take about the same time, and whether their time was used well.
fn same(one: NamedBudget<'_>, other: NamedBudget<'_>, language: Language) -> String {
    let (a, b) = (one.name, other.name);
    let [first, second] = [one, other].map(|run| duration(run.budget.makespan, language));
    let least = one.budget.efficiency().min(other.budget.efficiency());
    let why = if least > 0.95 {
        word!(
            language,
            "Both keep all machines at work until the end.",
            "As duas mantêm todas as máquinas trabalhando até o fim."
        )
    } else {
        word!(language, "Both lose about the same time.", "As duas perdem quase o mesmo tempo.")
    };
    say!(
        language,
        "{a} and {b} take about the same time: {first} and {second}. {why}",
        "“{a}” e “{b}” levam quase o mesmo tempo: {first} e {second}. {why}"
    )
}

/// Says that the slower run's machines have less power, if so.
fn power(quick: &TimeBudget, slow: &TimeBudget, language: Language) -> Option<String> {
    // Until the quicker run ends: a later change explains nothing.
    let [of_quick, of_slow] = [quick, slow].map(|run| run.power(Time::ZERO + quick.makespan));
    let times = of_quick / of_slow.max(f64::MIN_POSITIVE);
    let ratio = ratio_words(times, language);
    (times > MAX_EQUAL_RATIO).then(|| {
        say!(
            language,
            "Its machines together are slower: those of the other run are {ratio} times as fast.",
            "Suas máquinas, juntas, são mais lentas: as da outra são {ratio} vezes tão rápidas."
        )
    })
}

/// Names the part of the budget in which the slower run lost most against the quicker one.
fn cause(quick: &TimeBudget, slow: &TimeBudget, language: Language) -> Option<String> {
    // A part's share of the machine seconds, times the makespan, so that the number of machines does not matter.
    let excess = |part: Part| {
        let seconds = |budget: &TimeBudget| part(budget) / budget.spent.sum() * budget.makespan.as_secs_f64();
        seconds(slow) - seconds(quick)
    };
    let parts: [(Part, Tell); 4] = [
        (|budget| budget.spent.waiting, waiting),
        (|budget| budget.spent.asking, asking),
        (|budget| budget.spent.starting, starting),
        (|budget| budget.spent.stopped, stopped),
    ];
    let (most, tell) = parts.into_iter().map(|(part, tell)| (excess(part), tell)).max_by(|a, b| a.0.total_cmp(&b.0))?;
    let lost = slow.makespan.as_secs_f64() - quick.makespan.as_secs_f64();
    // A part that explains less than a fifth of it is no cause.
    (most > 0.2 * lost).then(|| tell(quick, slow, language))
}

/// Selects a part of a time budget, in machine seconds.
type Part = fn(&TimeBudget) -> f64;

/// Explains a part of the slower run, the second argument.
type Tell = fn(&TimeBudget, &TimeBudget, Language) -> String;

/// Says that machines were done while others still traced.
fn waiting(quick: &TimeBudget, slow: &TimeBudget, language: Language) -> String {
    let last = slow.last;
    let (name, alone, share) =
        (node_name(last.node), duration(last.alone, language), fraction(share(slow, slow.spent.waiting)));
    let traced = atoms_words(last.traced, language);
    let is_slow = last.speed < 0.5;
    let speed = fraction(last.speed);
    let machine = if is_slow {
        say!(language, "machine {name}, which is slow ({speed}),", "a máquina {name}, que é lenta ({speed}),")
    } else {
        say!(language, "machine {name}", "a máquina {name}")
    };
    let long = last.alone > slow.makespan / 10;
    let wait = if long {
        say!(
            language,
            "In it {machine} traces {traced} and is alone for the last {alone}, while all others wait.",
            "Nela {machine} calcula {traced} e fica sozinha nos últimos {alone}, enquanto todas as outras esperam."
        )
    } else {
        say!(
            language,
            "In it the machines that are done wait for the others, {share} of their time.",
            "Nela as máquinas que terminaram esperam pelas outras, {share} do seu tempo."
        )
    };
    let moved = quick.messages.atoms_moved;
    if moved > 0 && slow.messages.atoms_moved == 0 {
        let atoms = atoms_words(moved, language);
        let times = counted(quick.messages.transfers, word!(language, "transfer", "transferência"), language);
        let helped = say!(
            language,
            "In the other run machines that are done take over atoms: {atoms} in {times}.",
            "Na outra, máquinas que terminaram assumem átomos: {atoms} em {times}."
        );
        return format!("{wait} {helped}");
    }
    wait
}

/// Says that machines waited for messages between atoms.
fn asking(_: &TimeBudget, slow: &TimeBudget, language: Language) -> String {
    let share = fraction(share(slow, slow.spent.asking));
    let waited = slow.waited_at_parent;
    // The parent is busy with the messages that it receives.
    let arrived = slow.messages.requests + slow.messages.results;
    let (messages, wait) = (count(arrived), duration(waited, language));
    if slow.scheduler.is_farm() && waited > Duration::from_millis(1) {
        say!(
            language,
            "In it machines wait {share} of their time for more work: the parent is busy with {messages} messages, \
             which wait {wait} in line, all together.",
            "Nela as máquinas passam {share} do tempo à espera de trabalho: o pai se ocupa de {messages} mensagens, \
             que somam {wait} na fila."
        )
    } else {
        say!(
            language,
            "In it machines wait {share} of their time between atoms, while offers of help, requests and atoms are \
             on their way.",
            "Nela as máquinas passam {share} do tempo entre átomos, enquanto ofertas de ajuda, pedidos e átomos estão a caminho."
        )
    }
}

/// Says that machines waited for their first atom.
fn starting(_: &TimeBudget, slow: &TimeBudget, language: Language) -> String {
    let estimating = duration(slow.estimating, language);
    let share = fraction(share(slow, slow.spent.starting));
    if slow.estimating > Duration::ZERO {
        say!(
            language,
            "In it all machines wait {estimating} while the parent samples the picture to estimate the cost of \
             each part.",
            "Nela todas as máquinas esperam {estimating} enquanto o pai amostra a imagem para estimar quanto custa \
             cada parte."
        )
    } else {
        say!(
            language,
            "In it machines wait {share} of their time for their first atoms.",
            "Nela as máquinas esperam {share} do tempo pelos primeiros átomos."
        )
    }
}

/// Says that machines with atoms were stopped.
fn stopped(_: &TimeBudget, slow: &TimeBudget, language: Language) -> String {
    let share = fraction(share(slow, slow.spent.stopped));
    say!(
        language,
        "In it stopped machines keep atoms for {share} of the time.",
        "Nela máquinas paradas guardam átomos durante {share} do tempo."
    )
}

/// Divides a part by all machine seconds.
fn share(budget: &TimeBudget, part: f64) -> f64 {
    part / budget.spent.sum().max(f64::MIN_POSITIVE)
}
