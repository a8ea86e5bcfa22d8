//! Steps of the latency, for the wheel, the arrow keys and the slider.

/// Returns the distance of round values just above a latency, in milliseconds.
fn step_above(latency: f64) -> f64 {
    match latency {
        ..10.0 => 1.0,
        ..50.0 => 5.0,
        ..100.0 => 10.0,
        ..500.0 => 50.0,
        ..1000.0 => 100.0,
        _ => 500.0,
    }
}

/// Returns the round value next to a latency, in milliseconds: … 40, 45, 50, 60 … 90, 100, 150, 200, 250 …
pub fn round_latency(latency: f64) -> f64 {
    let step = step_above(latency);
    (latency / step).round() * step
}

/// Returns the round value above (`longer`) or below a latency, in milliseconds.
pub fn next_latency(now: f64, longer: bool) -> f64 {
    if longer {
        let step = step_above(now);
        return ((now / step + 1e-9).floor() + 1.0) * step;
    }
    let step = step_above(now - 1e-6);
    (((now / step - 1e-9).ceil() - 1.0) * step).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_and_lead_back() {
        let walk = |from: f64, longer, steps| {
            std::iter::successors(Some(from), |&now| Some(next_latency(now, longer))).skip(1).take(steps).collect()
        };
        let up: Vec<f64> = walk(40.0, true, 11);
        assert_eq!(up, [45.0, 50.0, 60.0, 70.0, 80.0, 90.0, 100.0, 150.0, 200.0, 250.0, 300.0]);
        let down: Vec<f64> = walk(300.0, false, 11);
        assert_eq!(down, [250.0, 200.0, 150.0, 100.0, 90.0, 80.0, 70.0, 60.0, 50.0, 45.0, 40.0]);
        assert_eq!([next_latency(0.0, false), next_latency(0.0, true), next_latency(12.5, true)], [0.0, 1.0, 15.0]);
        assert_eq!([round_latency(187.0), round_latency(96.0), round_latency(3.4)], [200.0, 100.0, 3.0]);
    }
}
