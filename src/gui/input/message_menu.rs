//! What can become of a message on its way: it is held up, and whatever follows it there.

use std::time::Duration;

use egui::{Popup, Response, Ui};

use crate::balance::Party;
use crate::gui::session::Session;
use crate::gui::widgets::theme::Look;
use crate::gui::widgets::{deeds, popup_frame};
use crate::language::{Language, say, word};
use crate::view::{Flight, flight_words};

/// How long it may be held up, in seconds.
const SECONDS: [u64; 3] = [1, 5, 20];

/// The message that the menu is about, which may have arrived since it opened.
#[derive(Clone, Debug)]
pub struct MessageInMenu {
    words: String,
    way: (Party, Party),
}

impl MessageInMenu {
    /// The message that a menu opens for.
    pub fn new(flight: &Flight, language: Language) -> Self {
        Self { words: flight_words(flight, language), way: (flight.from, flight.to) }
    }
}

/// The menu of a message, which opens where the right button is pressed on `response`.
pub fn on(response: &Response, session: &mut Session, subject: &MessageInMenu, look: Look) {
    let popup = Popup::context_menu(response).frame(popup_frame(&response.ctx));
    popup.show(|ui| items(ui, session, subject, look));
}

fn items(ui: &mut Ui, session: &mut Session, MessageInMenu { words, way }: &MessageInMenu, look: Look) {
    let language = session.language();
    let hold = SECONDS.map(|seconds| (seconds, say!(language, "Hold it up for {seconds} s", "Reter por {seconds} s")));
    let hint = word!(
        language,
        "What is on this way, and what is sent there meanwhile, arrives then, in its order",
        "O que está neste caminho, e o que nele se mande até lá, chega então, em ordem"
    );
    if let Some(seconds) = deeds(ui, words, hold, (session.can_fail(), hint), look, language) {
        session.delay(*way, Duration::from_secs(seconds));
    }
}
