//! The pace: how fast the reference machine can be emulated on this computer.

/// Returns the pace at which a computer of `cores` cores can emulate machines of these `speeds`: 1, without any
/// waiting, if every speed is 1; else the pace that leaves 0.6 of the computer idle, since at twice that load the
/// threads slow each other down by 1–2 %.
pub fn auto_pace(speeds: &[f64], cores: usize) -> f64 {
    let sum: f64 = speeds.iter().sum();
    if speeds.iter().all(|&speed| speed == 1.0) { 1.0 } else { (0.4 * cores as f64 / sum).min(1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn auto_pace_is_1_unless_a_machine_is_slower() {
        assert_eq!(auto_pace(&[1.0; 8], 2), 1.0);
        assert_eq!(auto_pace(&[1.0, 1.0, 1.0, 0.2], 2), 0.25);
        assert_eq!(auto_pace(&[0.1], 64), 1.0);
        assert_eq!(auto_pace(&[0.0, 0.0], 2), 1.0);
    }
}
