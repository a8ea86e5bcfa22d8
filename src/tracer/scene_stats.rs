//! What compiling kept of a scene, and what it dropped: tells why a picture costs what it costs.

use std::collections::BTreeMap;

use serde::Serialize;

use super::{RayKind, Tracer, sampling_step};
use crate::csg::{DroppedCounts, RootId, Solid};

/// What a compiled scene kept and dropped.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SceneStats {
    /// What the scene has as it is written.
    #[serde(rename = "given")]
    pub source: SourceCounts,
    /// Solids that a ray is tested against one by one. Opaque unions count as their parts.
    pub solids: usize,
    /// Solids of these that are made of several primitives.
    pub compositions: usize,
    /// Solids without bounds, which every ray has to be tested against.
    pub unbounded: usize,
    /// Primitives that were kept, by their kind.
    pub primitives: BTreeMap<&'static str, usize>,
    /// Boolean operations that were kept.
    pub operations: usize,
    /// Solids that were proved empty and dropped.
    pub dropped: usize,
    /// What of other solids was dropped.
    #[serde(flatten)]
    pub parts_dropped: DroppedCounts,
    /// Lights.
    pub lights: usize,
    /// Whether any surface reflects other solids: if not, no reflection code runs.
    pub reflects: bool,
    /// Whether any surface transmits: if not, no refraction code runs and a shadow ray ends at the first solid.
    pub transmits: bool,
}

/// What a scene has as it is written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct SourceCounts {
    /// Placed primitives.
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
    /// What the compiled scene kept and dropped, in figures.
    pub fn scene_stats(&self) -> SceneStats {
        let scene = &self.scene;
        let roots: Vec<RootId> = scene.roots().collect();
        let leaves: Vec<_> = roots.iter().flat_map(|&root| scene.tree.leaves_of(root)).collect();
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
            unbounded: scene.unbounded.len(),
            operations: operations.sum(),
            primitives,
            dropped: scene.dropped,
            parts_dropped: scene.tree.dropped(),
            lights: scene.lights.len(),
            reflects: shadings().any(|shading| shading.ks > 0.0),
            transmits: shadings().any(|shading| shading.kt > 0.0),
        }
    }

    /// How many primary, reflected and refracted rays a sample of the pixels needs on each level of their trees, as far as
    /// the deepest that any of them reaches.
    pub fn levels(&self) -> Vec<u64> {
        /// About so many pixels are looked at.
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
