//! Context menu of a message on its way: delay it and the messages behind it.

use std::time::Duration;

use egui::{Popup, Response, Ui};

use crate::balance::Party;
use crate::gui::session::{Session, only_live_words};
use crate::gui::widgets::theme::Look;
use crate::gui::widgets::{action_menu, popup_frame};
use crate::language::{Language, say, word};
use crate::view::{Flight, flight_words};

/// Delays that the menu offers, in seconds.
const DELAYS_S: [u64; 3] = [1, 5, 20];

/// The message of a menu; it may have arrived since the menu opened.
#[derive(Clone, Debug)]
pub struct MessageInMenu {
    text: String,
    parties: (Party, Party),
}

impl MessageInMenu {
    /// Keeps what the menu needs of a message.
    pub fn new(flight: &Flight, language: Language) -> Self {
        Self { text: flight_words(flight, language), parties: (flight.from, flight.to) }
    }
}

/// Opens the menu of a message when `response` is right-clicked.
pub fn on(response: &Response, session: &mut Session, message: &MessageInMenu, look: Look) {
    let popup = Popup::context_menu(response).frame(popup_frame(&response.ctx));
    popup.show(|ui| items(ui, session, message, look));
}

fn items(ui: &mut Ui, session: &mut Session, MessageInMenu { text, parties }: &MessageInMenu, look: Look) {
    let language = session.language();
    let delays = DELAYS_S.map(|seconds| (seconds, say!(language, "Delay by {seconds} s", "Atrasar {seconds} s"), ""));
    let hint = word!(
        language,
        "All messages from this sender to this receiver wait and then arrive in order",
        "Todas as mensagens deste remetente a este destino esperam e depois chegam em ordem"
    );
    let hint = if session.can_fail() { hint } else { only_live_words(language) };
    if let Some(seconds) = action_menu(ui, text, delays, (session.can_fail(), hint), look) {
        session.delay(*parties, Duration::from_secs(seconds));
    }
}
