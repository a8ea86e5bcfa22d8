//! When the window draws itself anew: as often as something moves, as seldom as that takes cores from the run.

use std::time::Duration;

use egui::Context;

use crate::gui::session::{Phase, Session};

/// While somebody looks at something that moves.
const FRAME: Duration = Duration::from_millis(33);
/// For the clock, and in order to learn when something moves again.
const LOOK_IN: Duration = Duration::from_millis(250);
/// Slower than this one would think that it has stopped.
const SLOWEST: Duration = Duration::from_millis(400);
/// What part of one core the window's own thread takes while nobody touches it and the run wants every core. Where
/// OpenGL is software, its threads and the display's take about ten times as much again.
const SHARE: f64 = 0.005;
/// For so long after a touch the window is as quick as it can be, in seconds.
const TOUCHED: f64 = 1.0;

/// Asks for the next frame; `cpu` is what the last took, in seconds.
pub fn schedule(ctx: &Context, session: &Session, cpu: Option<f32>) {
    let stage = session.stage();
    let moves = stage.goes_on() && (!stage.is_live() || stage.state().moves(session.now()));
    let works = stage.phase == Phase::Running && !stage.paused;
    let next = match stage.phase {
        // A run that wants every core gets it, also while one looks at what it did before.
        _ if moves && works && session.header().pace >= 1.0 && !is_touched(ctx) => Some(spared(cpu)),
        _ if moves => Some(FRAME),
        Phase::Running if works => Some(LOOK_IN),
        Phase::Preparing => Some(LOOK_IN),
        // Its picture is still being traced again.
        _ if session.is_recorded() && !stage.performer.has_ended() => Some(FRAME),
        Phase::Running | Phase::Finished | Phase::Failed(_) => None,
    };
    let fades = session.notice().and_then(|notice| notice.remains(ctx.input(|input| input.time)));
    let moves = session.is_moving().then_some(FRAME);
    let others = [fades.map(Duration::from_secs_f64), session.loading().map(|_| LOOK_IN), moves];
    if let Some(next) = next.into_iter().chain(others.into_iter().flatten()).min() {
        ctx.request_repaint_after(next);
    }
    if session.runs_ending() > 0 {
        ctx.request_repaint_after(LOOK_IN);
    }
}

/// The time between two frames of `cpu` seconds that leaves the run its cores.
fn spared(cpu: Option<f32>) -> Duration {
    Duration::from_secs_f64(f64::from(cpu.unwrap_or(0.0)) / SHARE).clamp(FRAME, SLOWEST)
}

/// Whether somebody has just moved the mouse or pressed a key.
fn is_touched(ctx: &Context) -> bool {
    ctx.input(|input| {
        // A mouse that has never moved has, by egui, moved when its clock began.
        let moved = input.time > TOUCHED && f64::from(input.pointer.time_since_last_movement()) < TOUCHED;
        moved || input.pointer.any_down() || !input.keys_down.is_empty()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dear_frames_come_seldom() {
        assert_eq!(spared(None), FRAME);
        assert_eq!(spared(Some(0.0001)), FRAME);
        assert_eq!(spared(Some(0.0015)).as_millis(), 300);
        assert_eq!(spared(Some(1.0)), SLOWEST);
    }
}
