//! How often rays would change hands.

use super::{Octree, Partition, assign_owners};
use crate::tracer::{Path, RayKind, Tracer, sampling_step};

/// What a ray weighs on a wire, in bytes, at least: an envelope of 16 (as every message has, see
/// [`Message::bytes`](crate::balance::Message::bytes)), origin and direction as six 64-bit floats, 8 for its weight,
/// 4 for its pixel, and 4 for its kind and level.
pub const RAY_BYTES: u64 = 80;

/// What a ray's result weighs on its way back, in bytes: an envelope of 16, three 32-bit floats, and 4 for whose result
/// it is.
pub const ANSWER_BYTES: u64 = 32;

/// What dividing a scene's space among owners means for one picture. Rays and messages are for the whole picture, also
/// where only some of its pixels were looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Traffic {
    /// Those among whom the octree was dealt.
    pub owners: u32,
    /// Leaves of the octree that hold something.
    pub leaves: u32,
    /// Rays of all kinds.
    pub rays: u64,
    /// Of these, rays that never change hands.
    pub staying: u64,
    /// How often a ray is sent from one owner to another.
    pub messages: u64,
    /// How often the result of a shadow, reflected or refracted ray has to be sent back, because the ray ends with
    /// another owner than the one where it began and where it is waited for. Not part of `messages`: owners that add
    /// each ray's share to the picture themselves could do without.
    pub answers: u64,
    /// How often the ray that changes hands most often does.
    pub most: u32,
    /// Each owner's share of all work; they sum up to 1, unless there is none at all. A ray that crosses a leaf is as
    /// much work as the leaf holds primitives.
    pub shares: Vec<f64>,
}

impl Traffic {
    /// The work of the busiest owner, as a multiple of the mean: this much longer than ideal they need together, even
    /// if messages took no time. 1 if there is no work.
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

/// Counts what dividing the space of the tracer's scene among `owners` would mean. Looks at every `every`-th pixel in
/// scan order; a number that has no divisor in common with the picture's width spreads them best. Neither may be 0.
///
/// A ray that starts where another ended begins with the owner where that one ended. Outside of the octree and in its
/// empty cells nothing has to be done that not everybody could do, so a ray stays there with whoever has it.
pub fn traffic(tracer: &Tracer, owners: u32, how: Partition, every: u32) -> Traffic {
    let octree = Octree::new(&tracer.boxes());
    let owner_of = assign_owners(how, &work(tracer, &octree), owners);
    let mut count = TrafficCounter::new(&octree, &owner_of, owners);
    tracer.paths_of_some(every, |path| count.add(&path));
    count.scaled(tracer.size().pixels().into(), tracer.size().pixels().div_ceil(every).into())
}

/// Each leaf's work, from a coarse sample of the picture. How many primitives a leaf holds says little about it: most
/// rays meet few of the leaves.
fn work(tracer: &Tracer, octree: &Octree) -> Vec<u64> {
    /// Pixels looked at, about: few, but thousands of rays.
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
    /// With whom the rays of the present sample ended, by their numbers; nobody, if they met no leaf.
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
            // Who meets a ray first that nobody has, made it.
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

    /// For a picture of `pixels`, of which `seen` were looked at.
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
