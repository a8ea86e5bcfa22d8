//! Rays and boxes around balls: no box may be missed whose ball is hit.

use fastrand::Rng;
use fearless_simd::Level;
use glam::{DAffine3, DVec3};

use super::Workload;
use crate::csg::{Leaf, MaterialTag, Primitive, Solid, Surface, Tree};
use crate::geometry::{Aabb, BoxFrame, Boxes, Ray, WIDTH};
use crate::study::random::{perpendicular, uniform, unit_vector};

/// Rays of the study.
const TRIES: usize = 200_000;

/// Groups of balls; each ray is tested against one group.
const GROUPS: usize = 64;

/// Eight balls with their boxes.
struct Group {
    leaves: Vec<Leaf>,
    bounds: [Aabb; WIDTH],
    frame: BoxFrame,
    boxes: Boxes,
    /// Boxes in single precision that are rounded to the nearest number: least and greatest corners, by axis.
    nearest: [[[f32; WIDTH]; 2]; 3],
}

/// A ray with its group.
pub(super) struct Try {
    ray: Ray,
    group: std::sync::Arc<Group>,
}

pub(super) fn workload(rng: &mut Rng) -> Workload<Try> {
    tried(rng, TRIES)
}

pub(super) fn tried(rng: &mut Rng, tries: usize) -> Workload<Try> {
    let groups: Vec<_> = (0..GROUPS).map(|_| std::sync::Arc::new(Group::new(rng))).collect();
    let attempt = |_| {
        let group = groups[rng.usize(..GROUPS)].clone();
        Try { ray: ray_past_a_pole(rng, &group), group }
    };
    let tries: Vec<Try> = (0..tries).map(attempt).collect();
    let hit = |Try { ray, group }: &Try| {
        let is_hit = |(place, leaf): (usize, &Leaf)| u64::from(leaf.count_crossings(ray) > 0) << place;
        group.leaves.iter().enumerate().map(is_hit).sum()
    };
    Workload {
        name: "boxes",
        title: "Boxes of a hierarchy",
        about: "Eight balls in boxes, and a ray: which boxes does it meet? Half of the rays go anywhere, half pass a \
                pole of a ball, where the ball touches its box, by 10⁻² to 10⁻¹² of its radius. Wrong: a box is left \
                out whose ball is hit. Truth: the test of each ball. Ours are eight boxes in f32 at once, rounded \
                outwards, in the vectors that every processor has or in the longest that this one has. Boxes in f32 \
                that are rounded to the nearest number lose hits.",
        truth: tries.iter().map(hit).collect(),
        tries,
        methods: vec![
            ("ours, usual vectors", |tries, out| eight(Level::baseline(), tries, out)),
            ("ours, longest vectors", |tries, out| eight(Level::new(), tries, out)),
            ("f64, one by one", |tries, out| {
                out.extend(tries.iter().map(|Try { ray, group }| {
                    let met =
                        |(place, bounds): (usize, &Aabb)| u64::from(bounds.entry(ray, 0.0, 1e9).is_some()) << place;
                    group.bounds.iter().enumerate().map(met).sum::<u64>()
                }));
            }),
            ("f32, to the nearest", |tries, out| {
                out.extend(tries.iter().map(|Try { ray, group }| group.meets_nearest(ray)));
            }),
        ],
        is_wrong: |answer, truth| truth & !answer != 0,
    }
}

fn eight(level: Level, tries: &[Try], out: &mut Vec<u64>) {
    out.extend(tries.iter().map(|Try { ray, group }| {
        let single = group.frame.ray(ray);
        let range = [single.place(0.0), single.place(1e9)];
        single.meets_at(level, &group.boxes, range, &mut [0.0; WIDTH])
    }));
}

impl Group {
    fn new(rng: &mut Rng) -> Self {
        let mut tree = Tree::default();
        let mut bounds = [Aabb::EMPTY; WIDTH];
        let mut leaves = Vec::new();
        for place in &mut bounds {
            let centre = unit_vector(rng) * uniform(rng, 1.0, 5.0);
            let scene_from_local = DAffine3::from_translation(centre) * DAffine3::from_scale(DVec3::splat(0.5));
            let ball = Solid::Placed { primitive: Primitive::Sphere, scene_from_local, tag: MaterialTag(0) };
            let (_, own) = tree.add(&ball).expect("a ball is not empty");
            *place = own;
            let index = crate::csg::LeafIndex::of(leaves.len() as u32);
            leaves.push(tree.leaf(Surface { leaf: index, face: 0 }).clone());
        }
        let all = bounds.iter().fold(Aabb::EMPTY, |all, &one| all.union(one));
        let frame = BoxFrame::new(all);
        let mut boxes = Boxes::NONE;
        bounds.iter().for_each(|&one| boxes.add(one, &frame));
        let corner = |axis: usize, side: usize, place: usize| {
            let own: Aabb = bounds[place];
            [own.min, own.max][side][axis] as f32
        };
        let nearest = [0, 1, 2].map(|axis| [0, 1].map(|side| std::array::from_fn(|place| corner(axis, side, place))));
        Self { leaves, bounds, frame, boxes, nearest }
    }

    /// The boxes that the ray meets, all in single precision.
    fn meets_nearest(&self, ray: &Ray) -> u64 {
        let (mut near, mut far) = ([0.0_f32; WIDTH], [1e9_f32; WIDTH]);
        for (axis, [min, max]) in self.nearest.iter().enumerate() {
            let (origin, inverse) = (ray.origin[axis] as f32, 1.0 / ray.direction[axis] as f32);
            for place in 0..WIDTH {
                let (a, b) = ((min[place] - origin) * inverse, (max[place] - origin) * inverse);
                near[place] = near[place].max(a.min(b));
                far[place] = far[place].min(a.max(b));
            }
        }
        (0..WIDTH).map(|place| u64::from(near[place] <= far[place]) << place).sum()
    }
}

fn ray_past_a_pole(rng: &mut Rng, group: &Group) -> Ray {
    let own = group.bounds[rng.usize(..WIDTH)];
    let half = (own.max - own.min) / 2.0;
    if rng.bool() {
        let target = own.centre() + unit_vector(rng) * half * 2.0;
        let direction = unit_vector(rng);
        return Ray::new(target - direction * 20.0, direction);
    }
    let axis = DVec3::AXES[rng.usize(..3)] * if rng.bool() { 1.0 } else { -1.0 };
    let direction = perpendicular(rng, axis);
    let pole = own.centre() + axis * (0.5 * (1.0 - 10f64.powf(uniform(rng, -12.0, -2.0))));
    Ray::new(pole - direction * uniform(rng, 15.0, 50.0), direction)
}
