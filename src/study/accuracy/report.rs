//! What the study of accuracy says.

use super::ring::Ring;
use super::scene::Found;

pub(super) fn report(found: &[Found], ring: &Ring) -> String {
    let _ = (found, ring);
    String::new()
}
