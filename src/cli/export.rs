//! `anel export`: writes a recorded run or a scene in the formats of other programs.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;
use std::sync::Arc;

use indicatif::ProgressBar;

use super::args::ExportArgs;
use super::{Failure, check_format, check_outputs, load_run, open, progress, tell};
use crate::cancel::CancelToken;
use crate::driver::{TracedPicture, trace_strips};
use crate::export::{Drawing, Film, PovScene, to_pov, write_chrome, write_csv};
use crate::output::write_whole;
use crate::picture::{Frame, Quality, Size, write_png, write_png_with_alpha};
use crate::runlog::{RunLog, is_run_file};
use crate::scene::Scene;
use crate::time::Time;
use crate::tracer::Tracer;

/// The most causes of differences from POV-Ray's picture that are told; the file has them all.
const MAX_TOLD_LIMITS: usize = 8;

pub(super) fn export(args: &ExportArgs) -> Result<(), Failure> {
    let source = args.source.as_path();
    check_outputs(source, &outputs(args))?;
    check_formats(args)?;
    if !is_run_file(source) {
        return export_scene(args);
    }
    if let Some(pov) = &args.pov {
        let (source, pov) = (source.display(), pov.display());
        return Err(Failure::Refused(format!(
            "{source} is a recorded run, but {pov} is made of a scene; leave out --pov"
        )));
    }
    let drawings = drawings(args)?;
    let log = load_run(source)?;
    if let Some(path) = &args.csv {
        write(path, |file| write_csv(file, &log))?;
    }
    if let Some(path) = &args.trace {
        write(path, |file| write_chrome(file, &log))?;
    }
    for (path, drawing, is_png) in drawings {
        let mut missing = BTreeSet::new();
        write(path, |file| {
            missing = drawing.write(file, &log, is_png)?;
            Ok(())
        })?;
        if !missing.is_empty() {
            let (path, letters) = (path.display(), missing.iter().collect::<String>());
            tell(&format!(
                "{path}: no font of this computer has {letters}; they are drawn as boxes. Install such a font, or \
                 export the drawing as .svg"
            ));
        }
    }
    if args.png.is_none() && args.gif.is_none() && args.layers.outputs().next().is_none() {
        return Ok(());
    }
    let scene = Scene::parse(&log.header.scene_text)
        .map_err(|error| Failure::Refused(format!("the scene in the run file cannot be read: {error}")))?;
    if let Some(path) = &args.png {
        let tracer = Tracer::new(&scene, args.size.unwrap_or(log.header.size), log.header.quality);
        picture(path, tracer, args.transparent)?;
    }
    if args.gif.is_none() && args.layers.outputs().next().is_none() {
        return Ok(());
    }
    let frame = frame(&scene, &log)?;
    args.layers.write(&log, &frame)?;
    if let Some(path) = &args.gif {
        film(path, &log, &frame, Film { width: args.width, length: args.seconds, ..Film::default() })?;
    }
    Ok(())
}

/// Exports a scene, for which there is only `--pov`.
fn export_scene(args: &ExportArgs) -> Result<(), Failure> {
    let opened = open(&args.source)?;
    let (others, source) = (outputs(args), args.source.display());
    match (&args.pov, others.first()) {
        (Some(pov), _) if others.len() == 1 => {
            let default_size = || Size::new(640, 480).map_err(|error| Failure::Refused(error.to_string()));
            let size = args.size.map_or_else(default_size, Ok)?;
            let PovScene { text, limits } = to_pov(&opened.scene, size, &Quality::default());
            write(pov, |file| file.write_all(text.as_bytes()))?;
            limits.iter().take(MAX_TOLD_LIMITS).for_each(|limit| tell(&format!("POV-Ray's picture differs: {limit}")));
            if limits.len() > MAX_TOLD_LIMITS {
                let (more, pov) = (limits.len() - MAX_TOLD_LIMITS, pov.display());
                tell(&format!("POV-Ray's picture differs for {more} more causes; the comments in {pov} name them"));
            }
            Ok(())
        }
        (pov, other) => {
            let other = others.iter().find(|other| pov.as_deref() != Some(**other)).or(other);
            let other = other.map_or_else(String::new, |other| other.display().to_string());
            Err(Failure::Refused(format!(
                "{source} is a scene, but {other} is made of a recorded run; record one with \
                 `anel render {source} --out … --log RUN.anel`"
            )))
        }
    }
}

/// Checks the endings of the files; [`drawings`] checks those of drawings.
fn check_formats(args: &ExportArgs) -> Result<(), Failure> {
    check_format(args.pov.as_deref(), "a scene for POV-Ray", &["pov"])?;
    check_format(args.csv.as_deref(), "a table", &["csv"])?;
    check_format(args.trace.as_deref(), "a trace in JSON", &["json"])?;
    check_format(args.gif.as_deref(), "an animated GIF", &["gif"])?;
    check_format(args.png.as_deref(), "a PNG picture", &["png"])
}

/// The files to write.
fn outputs(args: &ExportArgs) -> Vec<&Path> {
    let ExportArgs { pov, csv, trace, gif, ring, timeline, png, layers, .. } = args;
    let files = [pov, csv, trace, gif, ring, timeline, png].into_iter().flatten().map(|path| &**path);
    files.chain(layers.outputs()).collect()
}

/// The drawings to make: path, drawing, and whether as PNG.
fn drawings(args: &ExportArgs) -> Result<Vec<(&Path, Drawing, bool)>, Failure> {
    // The run is not read yet. Every time after its end shows the end.
    let ring = Drawing::Ring(args.at.unwrap_or(Time(u64::MAX)));
    let all = [(&args.ring, ring), (&args.timeline, Drawing::Timeline)];
    let asked = all.into_iter().filter_map(|(path, drawing)| Some((path.as_deref()?, drawing)));
    let with_ending = |(path, drawing): (&'_ Path, Drawing)| {
        let ending = path.extension().map(|ending| ending.to_ascii_lowercase());
        match ending.as_deref().and_then(|ending| ending.to_str()) {
            Some("svg") => Ok((drawing, false)),
            Some("png") => Ok((drawing, true)),
            _ => Err(Failure::Refused(format!(
                "{} is drawn as .svg or .png; give its name one of these endings",
                path.display()
            ))),
        }
    };
    asked.map(|(path, drawing)| with_ending((path, drawing)).map(|(drawing, is_png)| (path, drawing, is_png))).collect()
}

/// Traces the scene at any size and writes the picture.
fn picture(path: &Path, tracer: Tracer, transparent: bool) -> Result<(), Failure> {
    let (size, tracer) = (tracer.size(), Arc::new(tracer));
    let bar = parts("tracing");
    let bytes = trace_strips(&tracer, transparent, &|part| show(&bar, part), &CancelToken::default())
        .map_err(|error| Failure::Failed(error.to_string()))?
        // It is `None` only if cancelled, which nothing does here.
        .unwrap_or_default();
    bar.finish_and_clear();
    let write = if transparent { write_png_with_alpha } else { write_png };
    write(path, size, &bytes).map_err(|error| Failure::Failed(error.to_string()))
}

/// Traces the picture of the run again.
fn frame(scene: &Scene, log: &RunLog) -> Result<Frame, Failure> {
    let header = &log.header;
    let tracer = Arc::new(Tracer::new(scene, header.size, header.quality));
    let bar = parts("tracing");
    let whole = TracedPicture::of(&tracer, header.division, &|atoms| {
        bar.set_length(header.division.atoms().into());
        bar.inc(atoms.into());
    });
    bar.finish_and_clear();
    Ok(Frame::of(header.size, &whole.map_err(|error| Failure::Failed(error.to_string()))?.pixels))
}

/// Writes the animation.
fn film(path: &Path, log: &RunLog, frame: &Frame, film: Film) -> Result<(), Failure> {
    let bar = parts("drawing");
    let written = write(path, |file| {
        film.write(file, log, frame, &mut |part| {
            show(&bar, part);
            true
        })
    });
    bar.finish_and_clear();
    written
}

fn write(path: &Path, fill: impl FnOnce(&mut BufWriter<&mut File>) -> io::Result<()>) -> Result<(), Failure> {
    write_whole(path, fill).map_err(|error| Failure::Failed(error.to_string()))
}

/// A progress bar of 1000 steps.
fn parts(what: &'static str) -> ProgressBar {
    progress(1000, "{percent:>3} %  {msg}  {elapsed} ({eta} left)").with_message(what)
}

fn show(bar: &ProgressBar, part: f64) {
    bar.set_position((1000.0 * part) as u64);
}
