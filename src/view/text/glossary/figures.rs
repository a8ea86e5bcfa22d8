//! Figures of the table of machines, of the timeline, of the result and of comparisons.

use super::{Definition, definitions};

definitions! {
    /// Figures of the table of machines and of the timeline, up to the shown time.
    TABLE;
    DONE_AND_LEFT ["done + left", "fez + resta"] =>
        "All atoms that the machine has traced (strong) and still has (pale). The bar grows when it gets atoms and \
         shrinks when it gives some away. All machines have one scale.",
        "Todos os átomos que a máquina calculou (forte) e ainda tem (claro). A barra cresce quando ela recebe átomos e \
         encolhe quando cede. Todas as máquinas têm a mesma escala.";
    DONE ["done", "feitos"] =>
        "Atoms that the machine has traced.",
        "Átomos que a máquina calculou.";
    LEFT ["left", "restam"] =>
        "Atoms that the machine still has. Atoms on their way to it do not count yet.",
        "Átomos que a máquina ainda tem. Os que estão a caminho dela ainda não contam.";
    RATE ["atoms/s", "átomos/s"] =>
        "Atoms traced a second, in the last 3 s; after the run, over all of it. Machines of one speed differ, because \
         some atoms cost more.",
        "Átomos calculados por segundo, nos últimos 3 s; após a execução, em toda ela. Máquinas da mesma velocidade \
         diferem, porque alguns átomos custam mais.";
    IDLE ["idle", "ociosa"] =>
        "Part of the time in which the machine had no atoms.",
        "Parte do tempo em que a máquina não tinha átomos.";
    NOW_COLUMN ["now", "agora"] =>
        "What the machine does at the shown time. Click the word to switch the machine off, hang it or cut it off.",
        "O que a máquina faz no tempo mostrado. Clique na palavra para desligar, travar ou isolar a máquina.";
    STOPPED ["stopped", "parada"] =>
        "Time in which the machine was paused, hung, off or at speed 0. It is not idle while it has atoms.",
        "Tempo em que a máquina esteve em pausa, travada, desligada ou com velocidade 0. Com átomos, não conta como \
         ociosa.";
    WHO_TRACED ["who has traced how much", "quem calculou quanto"] =>
        "Atoms that each machine has traced / all atoms of the picture. Empty: not traced yet.",
        "Átomos que cada máquina calculou / todos os átomos da imagem. Vazio: ainda não calculado.";
    IN_USE ["machines in use", "máquinas em uso"] =>
        "The part of the machines that traced, at each time.",
        "A parte das máquinas que calculava, a cada momento.";
    TIME_USED ["machines' time spent tracing", "tempo das máquinas calculando"] =>
        "Time in which machines traced / time of all machines. Each machine counts alike. In the efficiency a machine \
         counts by its speed, so both figures differ.",
        "Tempo em que as máquinas calcularam / tempo de todas. Cada máquina conta igual. Na eficiência uma máquina conta \
         por sua velocidade; por isso os dois números diferem.";
    IMBALANCE ["busiest machine above the mean", "máquina mais ocupada acima da média"] =>
        "Tracing time of the machine that traced longest / mean of all machines − 1.",
        "Tempo de cálculo da máquina que calculou mais / média de todas − 1.";
    ON_THE_WAY ["with an offer or atoms on the way", "com oferta ou átomos a caminho"] =>
        "Time in which the offer of a machine, or atoms for it, were on the way / time of all machines.",
        "Tempo em que a oferta de uma máquina, ou átomos para ela, estavam a caminho / tempo de todas.";
    MESSAGES ["messages", "mensagens"] =>
        "Messages of every kind that were sent, and their bytes.",
        "Mensagens de todo tipo que foram enviadas, e seus bytes.";
    PLACED ["placed", "recebido"] =>
        "Pixels that the parent has received / all pixels.",
        "Pixels que o pai recebeu / todos os pixels.";
    HANDLED ["messages handled", "mensagens tratadas"] =>
        "Messages that the parent has handled, and how many a second.",
        "Mensagens que o pai tratou, e quantas por segundo.";
    IN_LINE ["in line", "na fila"] =>
        "Messages that have arrived at the parent and wait.",
        "Mensagens que chegaram ao pai e esperam.";
}

definitions! {
    /// Figures of the result and of comparisons.
    RESULT;
    MAKESPAN ["start to finish", "início ao fim"] =>
        "How long the run took: from the first band sent to the last atom of the picture. The field calls it makespan.",
        "Quanto durou a execução: da primeira faixa enviada ao último átomo da imagem. Na literatura, makespan.";
    TIME ["time", "tempo"] =>
        "Start to finish: from the first band sent to the last atom of the picture.",
        "Do início ao fim: da primeira faixa enviada ao último átomo da imagem.";
    IDEAL ["shared perfectly", "divisão perfeita"] =>
        "How long the run would take if all machines worked until the end: all work / speed of all machines together.",
        "Quanto duraria a execução se todas as máquinas trabalhassem até o fim: todo o trabalho / velocidade de todas \
         juntas.";
    EFFICIENCY ["efficiency", "eficiência"] =>
        "Shared perfectly / start to finish. 100 %: every machine worked until the end. A fast machine that waits costs \
         more efficiency than a slow one.",
        "Divisão perfeita / início ao fim. 100 %: toda máquina trabalhou até o fim. Uma máquina rápida que espera custa \
         mais eficiência que uma lenta.";
    SPREAD ["first to last done", "da 1ª à última"] =>
        "Time from the last atom of the machine that finished first to the last atom of the machine that finished last.",
        "Tempo do último átomo da máquina que terminou primeiro ao último átomo da que terminou por último.";
    COST_MOST ["cost most", "custou mais"] =>
        "The machine that finished last: the others waited for it. The figure is how long, on average.",
        "A máquina que terminou por último: as outras esperaram por ela. O número é quanto, em média.";
    BUSY_COMPUTER ["this computer was busy", "este computador estava ocupado"] =>
        "Other programs took a tenth of the machines' time or more, so the run took longer than its settings say.",
        "Outros programas levaram um décimo do tempo das máquinas ou mais; a execução durou mais do que os ajustes dizem.";
    SPEEDUP ["speedup", "speedup"] =>
        "Time of one machine at full speed alone / time of the run.",
        "Tempo de uma só máquina em velocidade total / tempo da execução.";
    MESSAGES_TO_SHARE ["messages to share", "mensagens de divisão"] =>
        "All messages without results and beats: bands, requests, parts, offers, transfers …",
        "Todas as mensagens, sem resultados e sinais de vida: faixas, pedidos, partes, ofertas …";
    MESSAGES_WITH_RESULTS ["messages with results", "mensagens de resultados"] =>
        "A machine sends its pixels to the parent in small batches, so that the picture grows visibly. A slow machine \
         sends its atoms one by one, so it makes more messages, with every strategy.",
        "Uma máquina envia seus pixels ao pai em pequenos lotes, para que se veja a imagem crescer. Uma máquina lenta \
         envia seus átomos um a um e assim faz mais mensagens, em toda estratégia.";
    ATOMS_GIVEN_AWAY ["atoms given away", "átomos cedidos"] =>
        "Atoms in transfers from one machine to another.",
        "Átomos em transferências de uma máquina a outra.";
    ALONE ["alone at the end", "sozinha no fim"] =>
        "Time in which only one machine still traced.",
        "Tempo em que só uma máquina ainda calculava.";
}

definitions! {
    /// Parts of the machines' time. Their sum is the time of the run × machines.
    TIME_BUDGET;
    SPENT_TRACING ["tracing", "calculando"] =>
        "Machines traced atoms. Each machine counts alike; the efficiency counts a machine by its speed.",
        "Máquinas calculavam átomos. Cada máquina conta igual; a eficiência conta uma máquina por sua velocidade.";
    SPENT_STARTING ["starting", "início"] =>
        "Before the first atom of a machine: its band is on the way.",
        "Antes do primeiro átomo de uma máquina: sua faixa está a caminho.";
    SPENT_ASKING ["asking", "pedindo"] =>
        "Between its first and its last atom, a machine had none: its offer or request, or the answer, was on the way.",
        "Entre seu primeiro e seu último átomo, uma máquina não tinha nenhum: sua oferta ou pedido, ou a resposta, \
         estava a caminho.";
    SPENT_STOPPED ["stopped", "parada"] =>
        "Between its first and its last atom, a machine was paused, hung, off or at speed 0.",
        "Entre seu primeiro e seu último átomo, uma máquina estava em pausa, travada, desligada ou com velocidade 0.";
    SPENT_WAITING ["waiting at the end", "espera no fim"] =>
        "After the last atom of a machine: it waits until the others have finished.",
        "Após o último átomo de uma máquina: ela espera até as outras terminarem.";
}
