//! Statistics of a compiled scene, which explain the cost of its picture.

use std::collections::BTreeMap;

use serde::Serialize;

use super::{RayKind, Tracer, sampling_step};
use crate::csg::{DroppedCounts, RootId, Solid};

/// Counts of what a compiled scene keeps and what was dropped.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SceneStats {
    /// Counts of what the scene file states.
    #[serde(rename = "given")]
    pub source: SourceCounts,
    /// Solids that rays are tested with. A split union counts as its operands.
    pub solids: usize,
    /// Solids of more than one primitive, among `solids`.
    pub compositions: usize,
    /// Solids without finite bounds, which every ray is tested with.
    pub unbounded: usize,
    /// Primitives that were kept, by shape.
    pub primitives: BTreeMap<&'static str, usize>,
    /// Boolean operations that were kept.
    pub operations: usize,
    /// Solids that were proved empty and dropped.
    pub dropped: usize,
    /// Parts of other solids that were dropped.
    #[serde(flatten)]
    pub parts_dropped: DroppedCounts,
    /// Lights.
    pub lights: usize,
    /// Whether any surface reflects other solids. If not, no reflection code runs.
    pub reflects: bool,
    /// Whether any surface transmits. If not, no refraction code runs, and a shadow ray ends at the first solid.
    pub transmits: bool,
}

/// Counts of what a scene file states.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct SourceCounts {
    /// Primitives, with named solids put in.
    pub primitives: usize,
    /// Unions, intersections and differences.
    pub operations: usize,
}

impl SourceCounts {
    pub(super) fn of(solids: &[Solid]) -> Self {
        let mut counts = Self::default();
        for solid in solids {
            match solid {
                Solid::Placed { .. } => counts.primitives += 1,
                Solid::Union(solids) | Solid::Intersection(solids) | Solid::Difference(solids) => {
                    let inner = Self::of(solids);
                    counts.primitives += inner.primitives;
                    counts.operations += 1 + inner.operations;
                }
            }
        }
        counts
    }
}

impl Tracer {
    /// The statistics of the compiled scene.
    pub fn scene_stats(&self) -> SceneStats {
        let scene = &self.scene;
        let roots: Vec<RootId> = scene.roots().collect();
        let mut leaves: Vec<_> = roots.iter().flat_map(|&root| scene.tree.leaves_of(root)).collect();
        // Parts of one solid share what is subtracted from all of them.
        leaves.sort_by_key(|leaf| std::ptr::from_ref(*leaf));
        leaves.dedup_by_key(|leaf| std::ptr::from_ref(*leaf));
        let shadings = || leaves.iter().map(|leaf| &scene.shadings[leaf.tag.index()]);
        let mut primitives = BTreeMap::new();
        for leaf in &leaves {
            *primitives.entry(leaf.kind()).or_default() += 1;
        }
        let operations = roots.iter().map(|&root| scene.tree.operations_of(root));
        SceneStats {
            source: scene.source,
            solids: roots.len(),
            compositions: operations.clone().filter(|&operations| operations > 0).count(),
            unbounded: scene.bvh.roots().0.len(),
            operations: operations.sum(),
            primitives,
            dropped: scene.dropped,
            parts_dropped: scene.tree.dropped(),
            lights: scene.lights.len(),
            reflects: shadings().any(|shading| shading.ks > 0.0),
            transmits: shadings().any(|shading| shading.transmits),
        }
    }

    /// The number of primary, reflected and refracted rays on each level of their trees, for a sample of the pixels,
    /// down to the deepest level that any ray reaches.
    pub fn levels(&self) -> Vec<u64> {
        /// Approximate number of pixels in the sample.
        const PIXELS: u32 = 3000;
        let mut levels = Vec::new();
        self.paths_of_some(sampling_step(self.size, PIXELS), |path| {
            if path.kind != RayKind::Shadow {
                let level = path.level as usize;
                levels.resize(levels.len().max(level), 0);
                levels[level - 1] += 1;
            }
        });
        levels
    }
}
