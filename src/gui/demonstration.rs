//! The run that the window opens with.

use std::sync::Arc;
use std::time::Duration;

use crate::balance::Strategy;
use crate::driver::{auto_pace, cores, probe};
use crate::picture::{Division, Size};
use crate::runlog::{Header, Link};
use crate::scene::Opened;
use crate::tracer::{Quality, Tracer};

/// Eight machines, of which the fifth is slow.
const SPEEDS: [f64; 8] = [1.0, 1.0, 1.0, 1.0, 0.1, 1.0, 1.0, 1.0];

/// How long the probed work is to last. The run itself takes about 20 s, long enough to see it and short enough to
/// see it again: not all machines are busy to the end, and those that wait after every atom find their caches cold.
const LASTS: Duration = Duration::from_secs(18);

/// A run of `scene` that a class can follow: eight machines, one of them slow, 40 ms a hop, about 20 seconds. A sample
/// of the picture is traced at once, to choose the pace.
pub fn demonstration(scene: &Opened) -> (Arc<Tracer>, Header) {
    const PROBE: Duration = Duration::from_millis(120);
    // Neither side is 0, and there are few pixels.
    let size = Size::new(640, 480).expect("a possible size");
    let quality = Quality::default();
    let division = Division::new(size.pixels(), 50);
    let tracer = Arc::new(Tracer::new(&scene.scene, size, quality));
    let cores = cores();
    let work = probe(&tracer, division, PROBE).whole.as_secs_f64();
    let pace = work / (LASTS.as_secs_f64() * SPEEDS.iter().sum::<f64>());
    let header = Header {
        scene: scene.name.clone(),
        scene_text: scene.text.clone(),
        size,
        samples: quality.samples,
        division,
        strategy: Strategy::Ring,
        speeds: SPEEDS.to_vec(),
        // A computer that is too slow for this makes the run longer instead of late; 0 is not a pace.
        pace: pace.min(auto_pace(&SPEEDS, cores)).max(1e-6),
        link: Link { latency: Duration::from_millis(40), bandwidth: None },
        handling: Duration::ZERO,
        part: 1,
        cores,
    };
    (tracer, header)
}
