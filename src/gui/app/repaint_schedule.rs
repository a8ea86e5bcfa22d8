//! Time until the next repaint: short while something moves, long while a run at full pace needs all cores.

use std::time::Duration;

use egui::Context;

use crate::gui::session::{Phase, Session};

/// Interval while something moves.
const FRAME_INTERVAL: Duration = Duration::from_millis(33);
/// Interval while only the clock changes; a movement is noticed within this time.
const IDLE_INTERVAL: Duration = Duration::from_millis(250);
/// Longest interval while something moves; with longer ones the run seems to have stopped.
const MAX_INTERVAL: Duration = Duration::from_millis(500);
/// Share of one core that the window's thread takes while there is no input and the run needs every core. With software
/// OpenGL its threads and the display's take about ten times as much again.
const CORE_SHARE: f64 = 0.005;
/// Seconds after an input during which the window repaints at full rate.
const INPUT_WINDOW_S: f64 = 1.0;

/// Requests the next repaint; `cpu` is the CPU time of the last frame in seconds.
pub fn schedule(ctx: &Context, session: &Session, cpu: Option<f32>) {
    let stage = session.stage();
    let moves = stage.goes_on() && (!stage.is_live() || stage.state().moves(session.now()));
    let works = stage.phase == Phase::Running && !stage.paused;
    let next = match stage.phase {
        // A run at full pace gets all cores, also while an earlier moment is shown.
        _ if moves && works && session.header().pace >= 1.0 && !has_recent_input(ctx) => Some(sparing_interval(cpu)),
        _ if moves => Some(FRAME_INTERVAL),
        Phase::Running if works => Some(IDLE_INTERVAL),
        Phase::Preparing => Some(IDLE_INTERVAL),
        // The picture of the recorded run is still being traced.
        _ if session.is_recorded() && !stage.source.has_ended() => Some(IDLE_INTERVAL),
        Phase::Running | Phase::Finished | Phase::Failed(_) => None,
    };
    let fades = session.notice().and_then(|notice| notice.remains(ctx.input(|input| input.time)));
    let camera = session.is_camera_moving().then_some(FRAME_INTERVAL);
    let others = [fades.map(Duration::from_secs_f64), session.loading().map(|_| IDLE_INTERVAL), camera];
    if let Some(next) = next.into_iter().chain(others.into_iter().flatten()).min() {
        ctx.request_repaint_after(next);
    }
    if session.runs_ending() > 0 {
        ctx.request_repaint_after(IDLE_INTERVAL);
    }
}

/// Returns the interval at which frames of `cpu` seconds take [`CORE_SHARE`] of a core.
fn sparing_interval(cpu: Option<f32>) -> Duration {
    Duration::from_secs_f64(f64::from(cpu.unwrap_or(0.0)) / CORE_SHARE).clamp(FRAME_INTERVAL, MAX_INTERVAL)
}

/// Whether the mouse moved or a key was pressed within the last [`INPUT_WINDOW_S`].
fn has_recent_input(ctx: &Context) -> bool {
    ctx.input(|input| {
        // egui counts the start of its clock as a movement of the mouse.
        let moved = input.time > INPUT_WINDOW_S && f64::from(input.pointer.time_since_last_movement()) < INPUT_WINDOW_S;
        moved || input.pointer.any_down() || !input.keys_down.is_empty()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn costly_frames_lengthen_the_interval() {
        assert_eq!(sparing_interval(None), FRAME_INTERVAL);
        assert_eq!(sparing_interval(Some(0.0001)), FRAME_INTERVAL);
        assert_eq!(sparing_interval(Some(0.0015)).as_millis(), 300);
        assert_eq!(sparing_interval(Some(1.0)), MAX_INTERVAL);
    }
}
