//! However the work is shared, the picture is that of a plain loop over all pixels, byte for byte.

mod watched;

use std::sync::Arc;

use anel::balance::Strategy;
use anel::driver::Run;
use anel::picture::{Colour, Frame, Quality, Size};
use anel::runlog::{Driver, Header};
use anel::scene::{Scene, built_in};
use anel::tracer::{Scratch, Tracer};

const ATOMS: [u32; 4] = [1, 50, 333, 5000];

#[test]
fn the_ring_of_equal_machines() {
    compare(Driver::Threads, Strategy::Ring, |_| 1.0);
}

#[test]
fn the_ring_of_wildly_different_machines() {
    compare(Driver::Threads, Strategy::Ring, wildly_different);
}

#[test]
fn the_ring_that_adapts_of_equal_machines() {
    compare(Driver::Threads, Strategy::Adaptive, |_| 1.0);
}

#[test]
fn the_ring_that_adapts_of_wildly_different_machines() {
    compare(Driver::Threads, Strategy::Adaptive, wildly_different);
}

#[test]
fn the_ring_that_adapts_with_two_threads_a_node() {
    compare(Driver::Pairs, Strategy::Adaptive, |_| 1.0);
}

#[test]
fn one_node_that_traces_all() {
    compare(Driver::Threads, Strategy::Serial, |_| 1.0);
}

#[test]
fn two_threads_a_node() {
    compare(Driver::Pairs, Strategy::Ring, |_| 1.0);
}

#[test]
fn work_stealing_of_equal_machines() {
    compare(Driver::WorkStealing, Strategy::Ring, |_| 1.0);
}

#[test]
fn work_stealing_of_wildly_different_machines() {
    compare(Driver::WorkStealing, Strategy::Ring, wildly_different);
}

fn wildly_different(node: usize) -> f64 {
    [0.3, 1.0, 0.02, 0.7, 0.1][node % 5]
}

fn compare(driver: Driver, strategy: Strategy, speed: fn(usize) -> f64) {
    let size = Size::new(40, 25).unwrap();
    let scene = Scene::parse(built_in("ten-objects").unwrap()).unwrap();
    let tracer = Arc::new(Tracer::new(&scene, size, Quality::default()));
    let mut plain = Vec::new();
    for pixel in 0..size.pixels() {
        tracer.trace(pixel..pixel + 1, &mut Scratch::default(), &mut plain);
    }
    for nodes in [1, 2, 3, 4, 7, 8, 16, 32] {
        for atom_pixels in ATOMS {
            let header = header(driver, strategy, size, atom_pixels, (0..nodes).map(speed).collect());
            let frame = picture(&tracer, &header);
            assert!(bits(frame.pixels()).eq(bits(&plain)), "{nodes} nodes, atoms of {atom_pixels}");
        }
    }
}

/// NaN is not equal to itself, but its bits are.
fn bits(pixels: &[Colour]) -> impl Iterator<Item = u32> {
    pixels.iter().flatten().map(|channel| channel.to_bits())
}

fn picture(tracer: &Arc<Tracer>, header: &Header) -> Frame {
    let run = Run::start(tracer.clone(), header);
    watched::picture(&run, header).0.unwrap_or_else(|why| panic!("{why}"))
}

fn header(driver: Driver, strategy: Strategy, size: Size, atom_pixels: u32, speeds: Vec<f64>) -> Header {
    Header { scene: "ten-objects".into(), driver, ..Header::plain(size, atom_pixels, strategy, speeds) }
}
