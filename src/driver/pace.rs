//! How fast the reference machine may be emulated on this computer.

use std::thread;

/// Cores of this computer.
pub fn cores() -> usize {
    thread::available_parallelism().map_or(1, usize::from)
}

/// The pace that lets machines of these `speeds` be emulated on a computer of `cores` cores: 1, no waiting at all, if
/// every speed is 1; else what leaves 0.6 of the computer idle, since at twice that load the threads get in each
/// other's way and that alone costs 1–2 %.
pub fn auto_pace(speeds: &[f64], cores: usize) -> f64 {
    let sum: f64 = speeds.iter().sum();
    if speeds.iter().all(|&speed| speed == 1.0) { 1.0 } else { (0.4 * cores as f64 / sum).min(1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn auto_pace_waits_only_where_a_machine_is_throttled() {
        assert_eq!(auto_pace(&[1.0; 8], 2), 1.0);
        assert_eq!(auto_pace(&[1.0, 1.0, 1.0, 0.2], 2), 0.25);
        assert_eq!(auto_pace(&[0.1], 64), 1.0);
        assert_eq!(auto_pace(&[0.0, 0.0], 2), 1.0);
    }
}
