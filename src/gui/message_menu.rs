//! What can become of a message on its way: it is held up, and whatever follows it there.

use std::time::Duration;

use egui::{Label, Popup, Response, RichText, Ui};

use super::session::Session;
use super::theme::{self, GRID, Look};
use super::widgets::{Weight, button, popup_frame};
use crate::balance::Party;
use crate::language::{say, word};
use crate::view::{Flight, flight_words};

/// How long it may be held up, in seconds.
const SECONDS: [u64; 3] = [1, 5, 20];

/// The message that the menu is about, which may have arrived since it opened.
#[derive(Clone, Debug)]
pub struct Subject {
    words: String,
    way: (Party, Party),
}

impl From<&Flight> for Subject {
    fn from(flight: &Flight) -> Self {
        Self { words: flight_words(flight), way: (flight.from, flight.to) }
    }
}

/// The menu of a message, which opens where the right button is pressed on `response`.
pub fn on(response: &Response, session: &mut Session, subject: &Subject, look: Look) {
    let popup = Popup::context_menu(response).frame(popup_frame(&response.ctx));
    popup.show(|ui| items(ui, session, subject, look));
}

fn items(ui: &mut Ui, session: &mut Session, Subject { words, way }: &Subject, look: Look) {
    ui.set_width(34.0 * GRID);
    let title = RichText::new(words).font(theme::strong(theme::BODY)).color(look.text);
    ui.add(Label::new(title).wrap());
    let can_fail = session.can_fail();
    for seconds in SECONDS {
        ui.add_enabled_ui(can_fail, |ui| {
            let words = say!("Hold it up for {seconds} s", "Reter por {seconds} s");
            if button(ui, None, &words, true, Weight::Quiet).clicked() {
                session.delay(*way, Duration::from_secs(seconds));
                ui.close();
            }
        });
    }
    let hint = if can_fail {
        word!(
            "What is on this way, and what is sent there meanwhile, arrives then, in its order",
            "O que está neste caminho, e o que nele se mande até lá, chega então, em ordem"
        )
    } else {
        word!("Only while a run goes on, live", "Só enquanto uma execução acontece, ao vivo")
    };
    ui.add(Label::new(RichText::new(hint).font(theme::regular(theme::SMALL)).color(look.quiet)).wrap());
}
