//! Steps of a machine's speed, for keys and the wheel.

/// Returns the next higher (`faster`) or lower step: tenths, and low speeds that make a machine the bottleneck.
pub fn next_speed(now: f64, faster: bool) -> f64 {
    let mut steps = [0.0, 0.01, 0.02, 0.05].into_iter().chain((1..=10).map(|tenth| f64::from(tenth) / 10.0));
    if faster {
        steps.find(|&step| step > now + 0.001).unwrap_or(1.0)
    } else {
        steps.take_while(|&step| step < now - 0.001).last().unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::next_speed;

    #[test]
    fn steps_lead_from_end_to_end_and_back() {
        let walk = |from, faster| {
            let next = |&speed: &f64| Some(next_speed(speed, faster)).filter(|&next| next != speed);
            std::iter::successors(Some(from), next).collect::<Vec<_>>()
        };
        let (mut up, down) = (walk(0.0, true), walk(1.0, false));
        assert_eq!(up[..6], [0.0, 0.01, 0.02, 0.05, 0.1, 0.2]);
        up.reverse();
        assert_eq!(up, down);
        assert_eq!((next_speed(0.37, true), next_speed(0.37, false)), (0.4, 0.3));
    }
}
