//! Every driver and strategy gives the picture of a plain loop over all pixels, byte for byte.

use std::sync::Arc;

use anel::balance::Strategy;
use anel::driver::Run;
use anel::picture::{Colour, Frame, Quality, Size};
use anel::runlog::{Driver, Header};
use anel::scene::{Scene, built_in};
use anel::tracer::{Scratch, Tracer};

use crate::watched;

const ATOM_PIXELS: [u32; 4] = [1, 50, 333, 5000];

#[test]
fn ring_of_equal_machines() {
    compare(Driver::Threads, Strategy::Ring, |_| 1.0);
}

#[test]
fn ring_of_very_different_machines() {
    compare(Driver::Threads, Strategy::Ring, very_different);
}

#[test]
fn adaptive_ring_of_equal_machines() {
    compare(Driver::Threads, Strategy::Adaptive, |_| 1.0);
}

#[test]
fn adaptive_ring_of_very_different_machines() {
    compare(Driver::Threads, Strategy::Adaptive, very_different);
}

#[test]
fn farm_with_leases_of_very_different_machines() {
    compare(Driver::Threads, Strategy::FarmLeases, very_different);
}

#[test]
fn farm_with_leases_with_two_threads_a_node() {
    compare(Driver::Pairs, Strategy::FarmLeases, |_| 1.0);
}

#[test]
fn adaptive_ring_with_two_threads_a_node() {
    compare(Driver::Pairs, Strategy::Adaptive, |_| 1.0);
}

#[test]
fn serial() {
    compare(Driver::Threads, Strategy::Serial, |_| 1.0);
}

#[test]
fn ring_with_two_threads_a_node() {
    compare(Driver::Pairs, Strategy::Ring, |_| 1.0);
}

#[test]
fn work_stealing_of_equal_machines() {
    compare(Driver::WorkStealing, Strategy::Ring, |_| 1.0);
}

#[test]
fn work_stealing_of_very_different_machines() {
    compare(Driver::WorkStealing, Strategy::Ring, very_different);
}

fn very_different(node: usize) -> f64 {
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
        for atom_pixels in ATOM_PIXELS {
            let header = header(driver, strategy.clone(), size, atom_pixels, (0..nodes).map(speed).collect());
            let frame = picture(&tracer, &header);
            assert!(bits(frame.pixels()).eq(bits(&plain)), "{nodes} nodes, atoms of {atom_pixels}");
        }
    }
}

/// The bits of all channels; NaN is not equal to itself, but its bits are.
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
