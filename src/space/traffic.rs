//! The number of times that rays would change owners.

use super::{Octree, Partition, assign_owners};
use crate::tracer::{Path, RayKind, Tracer, sampling_step};

/// The smallest size of a ray in a message, in bytes: an envelope of 16 (as for every message, see
/// [`Message::bytes`](crate::balance::Message::bytes)), origin and direction as six 64-bit floats, 8 for its weight, 4
/// for its pixel, and 4 for its kind and level.
pub const RAY_BYTES: u64 = 80;

/// The size of a ray's result on its way back, in bytes: an envelope of 16, three 32-bit floats, and 4 for the ray.
pub const ANSWER_BYTES: u64 = 32;

/// The cost of a division of space for one picture. Counts are for the whole picture, even if only some of its pixels
/// were sampled.
#[derive(Clone, Debug, PartialEq)]
pub struct Traffic {
    /// The number of owners.
    pub owners: u32,
    /// The number of non-empty leaves of the octree.
    pub leaves: u32,
    /// The number of rays of all kinds.
    pub rays: u64,
    /// The number of rays that never change owners.
    pub staying: u64,
    /// The number of times that a ray is sent from one owner to another.
    pub messages: u64,
    /// The number of results of shadow, reflected and refracted rays that are sent back, because the ray ends with
    /// another owner than the one where it began, which waits for it. They are not part of `messages`: owners that add
    /// each ray's contribution to the picture themselves do not need them.
    pub answers: u64,
    /// The greatest number of changes of owner of one ray.
    pub most: u32,
    /// Each owner's part of all work; the sum is 1, or 0 if there is no work. The work of a ray in a leaf is the number
    /// of primitives in the leaf.
    pub shares: Vec<f64>,
}

impl Traffic {
    /// The work of the busiest owner as a multiple of the mean: all owners together need this factor longer than ideal,
    /// even if messages took no time. 1 if there is no work.
    pub fn imbalance(&self) -> f64 {
        let largest = self.shares.iter().copied().fold(0.0, f64::max);
        if largest > 0.0 { largest * f64::from(self.owners) } else { 1.0 }
    }

    /// The bytes of [`Traffic::messages`].
    pub fn ray_bytes(&self) -> u64 {
        self.messages * RAY_BYTES
    }

    /// The bytes of [`Traffic::answers`].
    pub fn answer_bytes(&self) -> u64 {
        self.answers * ANSWER_BYTES
    }
}

/// Counts the messages if the space of the tracer's scene were divided among `owners`. Samples each `every`-th pixel in
/// scan order; a number coprime to the picture's width spreads the samples best. Neither may be 0.
///
/// A secondary ray begins with the owner where its parent ended. Outside the octree and in empty cells there is no
/// work, so a ray stays with its owner there.
pub fn traffic(tracer: &Tracer, owners: u32, how: Partition, every: u32) -> Traffic {
    let octree = Octree::new(&tracer.boxes());
    let owner_of = assign_owners(how, &work(tracer, &octree), owners);
    let mut count = TrafficCounter::new(&octree, &owner_of, owners);
    tracer.paths_of_some(every, |path| count.add(&path));
    count.scaled(tracer.size().pixels().into(), tracer.size().pixels().div_ceil(every).into())
}

/// Estimates each leaf's work from a coarse sample of the picture. The number of primitives in a leaf says little about
/// it: most rays meet few of the leaves.
fn work(tracer: &Tracer, octree: &Octree) -> Vec<u64> {
    /// Approximate number of pixels in the sample: few, but thousands of rays.
    const PIXELS: u32 = 2000;
    let mut work = vec![0; octree.leaves().len()];
    tracer.paths_of_some(sampling_step(tracer.size(), PIXELS), |path| {
        octree.walk(&path.ray, path.to, |leaf| {
            work[leaf as usize] += u64::from(octree.leaves()[leaf as usize].boxes);
        });
    });
    work
}

/// Follows rays from owner to owner.
struct TrafficCounter<'a> {
    octree: &'a Octree,
    owner_of: &'a [u32],
    /// The owners with which the current sample's rays ended, by ray number; none for a ray that met no leaf.
    ended: Vec<Option<u32>>,
    rays: u64,
    staying: u64,
    messages: u64,
    answers: u64,
    most: u32,
    /// By owner.
    work: Vec<u64>,
}

impl<'a> TrafficCounter<'a> {
    fn new(octree: &'a Octree, owner_of: &'a [u32], owners: u32) -> Self {
        let (ended, work) = (Vec::new(), vec![0; owners as usize]);
        Self { octree, owner_of, ended, rays: 0, staying: 0, messages: 0, answers: 0, most: 0, work }
    }

    fn add(&mut self, path: &Path) {
        if path.kind == RayKind::Primary {
            self.ended.clear();
        }
        let mut began = path.from.and_then(|from| self.ended[from as usize]);
        let (mut at, mut changes) = (began, 0);
        self.octree.walk(&path.ray, path.to, |leaf| {
            let owner = self.owner_of[leaf as usize];
            self.work[owner as usize] += u64::from(self.octree.leaves()[leaf as usize].boxes);
            // The first owner that a ray meets has made it, if no other has it.
            began = began.or(Some(owner));
            changes += u32::from(at.is_some_and(|at| at != owner));
            at = Some(owner);
        });
        if path.kind != RayKind::Shadow {
            self.ended.push(at);
        }
        self.rays += 1;
        self.staying += u64::from(changes == 0);
        self.messages += u64::from(changes);
        self.answers += u64::from(path.kind != RayKind::Primary && at != began);
        self.most = self.most.max(changes);
    }

    /// Scales the counts to a picture of `pixels`, of which `seen` were sampled.
    fn scaled(self, pixels: u64, seen: u64) -> Traffic {
        let scaled = |count: u64| (count as f64 * (pixels as f64 / seen as f64)).round() as u64;
        let all = self.work.iter().sum::<u64>().max(1) as f64;
        Traffic {
            owners: self.work.len() as u32,
            leaves: self.octree.leaves().len() as u32,
            rays: scaled(self.rays),
            staying: scaled(self.staying),
            messages: scaled(self.messages),
            answers: scaled(self.answers),
            most: self.most,
            shares: self.work.iter().map(|&work| work as f64 / all).collect(),
        }
    }
}
