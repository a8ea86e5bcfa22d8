//! Collects the picture and the records of a run.

use anel::driver::{Run, Update};
use anel::picture::Frame;
use anel::record::Record;
use anel::runlog::Header;

/// Waits for the end of the run that `header` describes. Returns its picture or the reason of its failure, and its
/// records.
///
/// # Panics
/// If an atom is placed twice, or the run ends without a last update.
pub fn picture(run: &Run, header: &Header) -> (Result<Frame, String>, Vec<Record>) {
    let (mut frame, mut records) = (Frame::new(header.size), Vec::new());
    let mut placed_before = vec![false; header.division.atoms() as usize];
    for update in run.updates() {
        match update {
            Update::Placed { atoms, pixels } => {
                let placed = header.division.placed(&atoms, &pixels);
                let count: usize = placed.map(|(place, colours)| (frame.place(place, colours), colours.len()).1).sum();
                assert_eq!(count, pixels.len());
                for atom in atoms.into_iter().flatten() {
                    let before = std::mem::replace(&mut placed_before[atom as usize], true);
                    assert!(!before, "atom {atom} is placed twice");
                }
            }
            Update::Records(more) => records.extend(more),
            Update::Rays(_) => {}
            Update::Finished => return (Ok(frame), records),
            Update::Failed(error) => return (Err(error.to_string()), records),
        }
    }
    panic!("the run ended without a last update");
}
