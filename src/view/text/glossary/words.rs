//! Words of a run, its speeds and its network, and the words under *now* in the table of machines.

use super::{Definition, definitions};

definitions! {
    /// Words of a run.
    WORDS;
    MACHINE ["machine", "máquina"] =>
        "A computer of the ring. It is emulated: this computer does its work, at the speed that you set.",
        "Um computador do anel. É emulada: este computador faz seu trabalho, na velocidade que você escolhe.";
    PARENT ["parent", "pai"] =>
        "Hands out the bands or parts, and puts the traced atoms together to the picture. It traces nothing.",
        "Distribui as faixas ou partes e junta os átomos calculados na imagem. Não calcula nada.";
    ATOM ["atom", "átomo"] =>
        "The smallest piece of work: some pixels of the picture, one after the other in a row. It is never divided.",
        "O menor pedaço de trabalho: alguns pixels da imagem, um após o outro em linha. Nunca é dividido.";
    BAND ["band", "faixa"] =>
        "The atoms, side by side, that a machine gets at the beginning. Bands of equally many atoms do not cost the same.",
        "Os átomos, lado a lado, que uma máquina recebe no começo. Faixas com o mesmo número de átomos não custam o mesmo.";
    OFFER ["offer of help", "oferta de ajuda"] =>
        "The message of a machine without atoms: it asks for some. It goes round the ring from neighbour to neighbour, \
         until a machine with atoms answers.",
        "A mensagem de uma máquina sem átomos: ela pede alguns. Vai pelo anel de vizinha em vizinha, até que uma máquina \
         com átomos responda.";
    HOP ["hop", "salto"] =>
        "The step of an offer from a machine to its neighbour.",
        "O passo de uma oferta, de uma máquina à sua vizinha.";
    LAP ["lap", "volta"] =>
        "The way of an offer once round the ring.",
        "O caminho de uma oferta uma vez em torno do anel.";
    TRANSFER ["transfer", "transferência"] =>
        "The answer to an offer: a machine gives atoms to the machine that offered help. It also gives atoms that it has \
         got from others.",
        "A resposta a uma oferta: uma máquina cede átomos à que ofereceu ajuda. Também cede átomos que recebeu de outras.";
    PARCEL ["parcel", "pacote"] =>
        "The atoms of a transfer on their way, with their number: ×37. It has the colour of its giver, and a rim in that \
         of its receiver.",
        "Os átomos de uma transferência a caminho, com seu número: ×37. Tem a cor de quem dá e a borda na cor de quem \
         recebe.";
    SHARE ["share", "parte de quem ajuda"] =>
        "How many atoms a helper gets. If the helper has traced n atoms and the giver m, the helper gets n / (n + m) of \
         those that wait. So a slow helper gets few.",
        "Quantos átomos recebe quem ajuda. Se quem ajuda calculou n átomos e quem dá m, recebe n / (n + m) dos que \
         esperam. Assim, uma ajudante lenta recebe poucos.";
    PIPE ["pipe", "pipe"] =>
        "The next two atoms of a machine: one that it traces and one that waits. It does not give them away. The two \
         squares in its disc show its last ones.",
        "Os dois próximos átomos de uma máquina: um que ela calcula e um que espera. Ela não os cede. Os dois quadrados \
         em seu disco mostram os últimos.";
    RETIRE ["retire", "ser dispensada"] =>
        "A machine retires when its own offer comes back: no machine has atoms to give.",
        "Uma máquina é dispensada quando sua própria oferta volta: nenhuma máquina tem átomos para ceder.";
    PART ["part", "parte"] =>
        "The atoms that a farm's parent gives to a machine at a time. In a ring the fewest atoms that are worth a \
         transfer.",
        "Os átomos que o pai de uma farm dá a uma máquina por vez. Num anel, o mínimo de átomos que vale uma \
         transferência.";
    REQUEST ["request", "pedido"] =>
        "The message of a farm's machine without atoms: it asks the parent for the next part.",
        "A mensagem de uma máquina sem átomos numa farm: ela pede ao pai a próxima parte.";
    LEASE ["lease", "prazo"] =>
        "The time after which silence means loss: then the atoms of a silent machine are given out again.",
        "O tempo após o qual silêncio significa perda: então os átomos da máquina calada são redistribuídos.";
    VIRTUAL_TIME ["virtual time", "tempo virtual"] =>
        "Simulated time: as if every machine were real. It does not depend on this computer.",
        "Tempo simulado: como se cada máquina fosse real. Não depende deste computador.";
}

definitions! {
    /// Speeds, costs and the network.
    SETTINGS;
    SPEED ["speed", "velocidade"] =>
        "How fast a machine is. At 50 % it needs twice as long for an atom as at 100 %.",
        "Quão rápida é uma máquina. A 50 % ela leva o dobro do tempo que leva a 100 % para um átomo.";
    COST ["cost of an atom", "custo de um átomo"] =>
        "The computing time that an atom needs at full speed. Background is cheap; glass and mirrors are costly.",
        "O tempo de cálculo de um átomo em velocidade total. O fundo é barato; vidro e espelhos são caros.";
    PACE ["pace", "ritmo"] =>
        "How fast a machine at 100 % traces, compared with this computer. A slower pace makes a run that you can follow.",
        "Quão rápido uma máquina a 100 % calcula, comparada a este computador. Com um ritmo menor você consegue \
         acompanhar a execução.";
    LATENCY ["latency", "latência"] =>
        "How long a message travels, however short it is.",
        "Quanto tempo uma mensagem viaja, por mais curta que seja.";
    BANDWIDTH ["bandwidth", "largura de banda"] =>
        "How many bytes of messages leave on a link in a second.",
        "Quantos bytes de mensagens saem por um enlace em um segundo.";
    HANDLING ["handling", "atendimento"] =>
        "The time that the parent needs for each message. Other messages wait in line meanwhile.",
        "O tempo que o pai precisa para cada mensagem. Enquanto isso, outras esperam na fila.";
}

definitions! {
    /// The words under *now* in the table of machines.
    NOW;
    NOW_NO_BAND ["no band", "sem faixa"] =>
        "It has not got its band yet.",
        "Ainda não recebeu sua faixa.";
    NOW_TRACING ["tracing", "calculando"] =>
        "It traces an atom.",
        "Calcula um átomo.";
    NOW_AT_0 ["at 0 %", "a 0 %"] =>
        "It has atoms, but its speed is 0.",
        "Tem átomos, mas sua velocidade é 0.";
    NOW_PAUSED ["paused", "em pausa"] =>
        "It has atoms, but you have paused it. It still passes offers on and gives atoms away.",
        "Tem átomos, mas você a pôs em pausa. Ainda repassa ofertas e cede átomos.";
    NOW_OFFERS_HELP ["offers help", "oferece ajuda"] =>
        "It has no atoms. Its offer goes round the ring.",
        "Não tem átomos. Sua oferta percorre o anel.";
    NOW_ASKING ["asking", "pedindo"] =>
        "It has no atoms. Its request is on the way to the parent.",
        "Não tem átomos. Seu pedido está a caminho do pai.";
    NOW_IN_LINE ["in line", "na fila"] =>
        "Its message waits at the parent.",
        "Sua mensagem espera junto ao pai.";
    NOW_RECEIVING ["receiving", "recebendo"] =>
        "Its offer or request was answered: atoms are on their way to it. It traces when they arrive.",
        "Sua oferta ou pedido teve resposta: átomos estão a caminho dela. Calcula quando chegarem.";
    NOW_IDLE ["idle", "ociosa"] =>
        "It has nothing to do.",
        "Não tem o que fazer.";
    NOW_RETIRED ["retired", "dispensada"] =>
        "It is no longer needed: its own offer came back, so no machine has atoms to give.",
        "Não é mais necessária: sua própria oferta voltou, então nenhuma máquina tem átomos para ceder.";
    NOW_ASLEEP ["asleep", "dormindo"] =>
        "It is not needed now. A machine with atoms can wake it.",
        "Não é necessária agora. Uma máquina com átomos pode acordá-la.";
    NOW_NO_MORE ["no more", "sem trabalho"] =>
        "The parent has no more parts for it.",
        "O pai não tem mais partes para ela.";
    NOW_HUNG ["hung", "travada"] =>
        "It does nothing and answers nothing, but keeps its atoms.",
        "Não faz nada nem responde, mas fica com seus átomos.";
    NOW_CUT_OFF ["cut off", "isolada"] =>
        "It works, but no message reaches it or leaves it.",
        "Trabalha, mas nenhuma mensagem chega a ela nem sai dela.";
    NOW_OFF ["off", "desligada"] =>
        "It is switched off. It has lost its atoms.",
        "Está desligada. Perdeu seus átomos.";
    NOW_SPARE ["spare", "reserva"] =>
        "It is off from the beginning, and can join the ring.",
        "Está desligada desde o começo e pode entrar no anel.";
    NOW_DONE ["done", "pronta"] =>
        "The picture is complete.",
        "A imagem está completa.";
}
