//! The cost of the window: `cargo bench --bench window`. Measures the CPU of one frame of a running and of a recorded
//! run, what is seen while the camera is dragged, the loss of a run at full speed with the window open, and the CPU of
//! a resting window. The last two need Linux and Xvfb. `cargo bench --bench window frames` measures only frames,
//! `… drag SCENE…` only the camera; `… memory SECONDS` repeats runs for this time and prints the memory of the window.
//!
//! The figures depend on the computer, which must be otherwise idle; none of them is asserted.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use anel::balance::Strategy;
use anel::gui::{App, Launch, Opening, Phase};
use anel::picture::Size;
use anel::runlog::{Driver, Header, LinkSettings, Metrics, RunLog};
use anel::scene::Opened;
use anel::sim::Sim;
use anel::time::Time;
use cpu_time::ThreadTime;
use egui::Key;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use tempfile::TempDir;

/// Pairs of runs, with the window and without it.
const PAIRS: usize = 5;

/// Settings of the runs at full speed: eight equal machines, a picture that takes some seconds.
const SETTINGS: &str = r#"(settings: (size: (width: 1280, height: 960), quality: (samples: 4), tempo: Full, latency: 0,
    speeds: [1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]), scene: Some("ten-objects"))"#;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["frames"] => return frames_of_all(),
        ["drag"] => return drag("ten-objects"),
        ["drag", ref scenes @ ..] => return scenes.iter().copied().for_each(drag),
        ["memory", seconds] => return memory(seconds.parse().expect("a number of seconds")),
        _ => {
            frames_of_all();
            drag("ten-objects");
        }
    }
    if let Some(display) = Display::open() {
        against_headless(&display);
        at_rest(&display);
    } else {
        println!("Xvfb is not installed: the window itself was not measured");
    }
}

/// Measures interface and tessellation of one frame, at 1280 × 800.
fn frames_of_all() {
    println!("one frame, interface and tessellation, 1280x800 (ms of CPU):");
    running("eight nodes at full speed", SETTINGS, false);
    let many = SETTINGS.replace("[1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]", &format!("{:?}", [1.0; 32]));
    running("32 nodes at full speed", &many, false);
    running("32 nodes at full speed, timeline", &many, true);
    let log = long_log();
    let mut window = harness(SETTINGS, Opening::Run(log));
    while window.state().session().loading().is_some() || !window.state().session().stage().source.has_ended() {
        sleep(Duration::from_millis(20));
        window.step();
    }
    let length = window.state().session().stage().length();
    let scrub = |window: &mut Harness<'static, App>, times: &mut Vec<f64>| {
        // Back and forth in steps of all sizes, as by hand.
        for i in 0..400_u32 {
            let share = 0.5 + 0.5 * f64::from(i).mul_add(0.043, (f64::from(i) * 0.61).sin() * 0.1).sin();
            window.state_mut().seek(Time((share * length.0 as f64) as u64));
            times.push(frame(window));
        }
    };
    let mut times = Vec::new();
    scrub(&mut window, &mut times);
    print_times("a log of 100,000 atoms, 32 nodes, scrubbed", times);
    window.key_press(Key::T);
    let mut times = Vec::new();
    scrub(&mut window, &mut times);
    print_times("the same with the timeline, all of it", times);
    for _ in 0..7 {
        window.key_press_modifiers(egui::Modifiers::COMMAND, Key::ArrowUp);
        window.step();
    }
    let mut times = Vec::new();
    scrub(&mut window, &mut times);
    print_times("the same, 128 times nearer", times);
    window.key_press(Key::Home);
    window.key_press(Key::Space);
    let times = (0..400).map(|_| frame(&mut window)).collect();
    print_times("the same, played", times);
}

/// A run of 32 machines in virtual time, on a picture of 100,000 atoms.
fn long_log() -> std::sync::Arc<RunLog> {
    let size = Size::new(2500, 2000).expect("a picture");
    let speeds: Vec<f64> = (0..32).map(|node| if node % 5 == 4 { 0.1 } else { 1.0 }).collect();
    let plain = Header::plain(size, 50, Strategy::Ring, speeds);
    let opened = Opened::new("ten-objects").expect("a built-in scene");
    let link = LinkSettings { latency: Duration::from_millis(20), ..plain.link };
    let names = (opened.name, opened.text);
    let header = Header { scene: names.0, scene_text: names.1, driver: Driver::Sim, pace: 0.05, link, ..plain };
    let mut log = RunLog::new(header.clone());
    let mut records = Vec::new();
    // Atoms of different costs.
    let cost = |atom: u32| Duration::from_micros(300 + u64::from(atom.wrapping_mul(2_654_435_761) >> 22));
    Sim::new(&header, &[], cost).run(&mut |record| records.push(record));
    log.add(records);
    std::sync::Arc::new(log)
}

fn harness(settings: &str, opening: Opening) -> Harness<'static, App> {
    let storage = Storage(settings.into());
    let launch = Launch { opening: Some(opening), ..Launch::default() };
    let build =
        move |creation: &mut eframe::CreationContext<'static>| App::new(&creation.egui_ctx, Some(&storage), launch);
    Harness::builder().with_size([1280.0, 800.0]).build_eframe(build)
}

/// Draws one frame. Returns its CPU time in milliseconds.
fn frame(window: &mut Harness<'static, App>) -> f64 {
    let before = ThreadTime::now();
    window.step();
    let interface = before.elapsed();
    // The real window moves its shapes; the copy is not measured.
    let shapes = window.output().shapes.clone();
    let scale = window.ctx.pixels_per_point();
    let before = ThreadTime::now();
    let meshes = window.ctx.tessellate(shapes, scale);
    let took = interface + before.elapsed();
    assert!(!meshes.is_empty(), "the frame is not empty");
    took.as_secs_f64() * 1e3
}

fn print_times(what: &str, mut times: Vec<f64>) {
    times.sort_by(f64::total_cmp);
    let at = |share: f64| times[((times.len() - 1) as f64 * share) as usize];
    let (count, median, most) = (times.len(), at(0.5), at(0.99));
    println!("  {what}: median {median:.2}, 99th percentile {most:.2} ({count} frames)");
}

fn running(what: &str, settings: &str, shows_timeline: bool) {
    let mut window = harness(settings, Opening::read("ten-objects").expect("a built-in scene"));
    if shows_timeline {
        window.key_press(Key::T);
    }
    let (mut times, mut restarts) = (Vec::new(), 0);
    while restarts < 3 {
        sleep(Duration::from_millis(20));
        let took = frame(&mut window);
        match window.state().session().stage().phase {
            Phase::Running => times.push(took),
            Phase::Finished => {
                restarts += 1;
                window.key_press(Key::R);
            }
            Phase::Preparing | Phase::Failed(_) => {}
        }
    }
    print_times(what, times);
}

/// Drags the camera of a scene for some seconds at 60 frames a second, and prints how many of the frames show a new
/// picture, and how fine it is.
#[expect(clippy::disallowed_methods, reason = "frames come at the times of a display")]
fn drag(scene: &str) {
    const FRAMES: u32 = 300;
    const FRAME: Duration = Duration::from_nanos(1_000_000_000 / 60);
    let settings = r#"(settings: (size: (width: 640, height: 480), tempo: Full))"#;
    let mut window = harness(settings, Opening::read(scene).expect("a scene"));
    let until = |window: &mut Harness<'static, App>, is_true: &dyn Fn(&Phase) -> bool| {
        while !is_true(&window.state().session().stage().phase) {
            sleep(Duration::from_millis(20));
            window.step();
        }
    };
    until(&mut window, &|phase| matches!(phase, Phase::Finished));
    window.key_press(Key::C);
    window.step();
    let start = window.get_by_label_contains("Picture").rect().center();
    window.hover_at(start);
    window.drag_at(start);
    window.step();
    let (mut fresh, mut last, mut steps) = (0, std::ptr::null(), Vec::new());
    let began = std::time::Instant::now();
    for number in 0..FRAMES {
        window.hover_at(start + egui::vec2((number as f32 * 0.1).sin() * 60.0, 0.0));
        window.step();
        if let Some(preview) = window.state().session().camera_preview()
            && last != std::sync::Arc::as_ptr(preview)
        {
            (fresh, last) = (fresh + 1, std::sync::Arc::as_ptr(preview));
            steps.push(f64::from(preview.step));
        }
        sleep((FRAME * (number + 1)).saturating_sub(began.elapsed()));
    }
    let rate = f64::from(fresh) / began.elapsed().as_secs_f64();
    let step = median(steps);
    println!(
        "the camera of {scene} dragged at 60 frames a second, 640x480: {rate:.1} pictures a second, {:.1} % of the \
         pixels traced",
        100.0 / (step * step)
    );
}

/// Repeats paced runs for `seconds` seconds, scrubs through each of them, and prints the memory; needs xdotool too.
#[expect(clippy::disallowed_methods, reason = "the time limit is in wall-clock time")]
fn memory(seconds: u64) {
    let display = Display::open().expect("Xvfb");
    let directory = TempDir::new().expect("a temporary directory");
    let settings = r#"(settings: (tempo: Lasts(5)), scene: Some("ten-objects"))"#;
    let window = Window::open_with(&display, directory.path(), None, settings);
    let press = |keys: &[&str]| {
        let mut xdotool = Command::new("xdotool");
        xdotool.env("DISPLAY", &display.name).args([
            "search",
            "--name",
            "anel",
            "windowfocus",
            "key",
            "--delay",
            "100",
        ]);
        let _ = xdotool.args(keys).stdout(Stdio::null()).stderr(Stdio::null()).status();
    };
    let began = std::time::Instant::now();
    let (mut runs, mut next) = (0, 0);
    while began.elapsed().as_secs() < seconds {
        sleep(Duration::from_secs(6));
        press(&["Home", "ctrl+Right", "ctrl+Right", "shift+Right", "t", "End", "ctrl+Left", "v", "t", "r"]);
        runs += 1;
        if began.elapsed().as_secs() >= next {
            next += (seconds / 20).max(1);
            let status = fs::read_to_string(format!("/proc/{}/status", window.0.id())).unwrap_or_default();
            let of = |name: &str| status.lines().find_map(|line| line.strip_prefix(name)).unwrap_or("?").trim();
            println!("{:5} s, {runs} runs: {} in memory", began.elapsed().as_secs(), of("VmRSS:"));
        }
    }
}

/// Measures the same run with the window and without it, in turn.
fn against_headless(display: &Display) {
    println!("\nthe same run at full speed, eight nodes, {PAIRS} pairs in turn (s):");
    let (mut losses, mut owns) = (Vec::new(), Vec::new());
    for _ in 0..PAIRS {
        let headless = headless();
        let (with, own) = with_window(display);
        let loss = with / headless - 1.0;
        let (loss_percent, own_percent) = (100.0 * loss, 100.0 * own);
        print!("  headless {headless:.3}, with the window {with:.3}: {loss_percent:+.1} %; ");
        println!("the window's own CPU {own_percent:.1} % of the computer");
        losses.push(loss);
        owns.push(own);
    }
    println!("  median: {:+.1} % for {:.1} % of the computer", 100.0 * median(losses), 100.0 * median(owns));
}

fn headless() -> f64 {
    let directory = TempDir::new().expect("a temporary directory");
    let log = directory.path().join("run.anel");
    let done = Command::new(env!("CARGO_BIN_EXE_anel"))
        .args(["render", "ten-objects", "--size", "1280x960", "--samples", "4", "--nodes", "8", "--pace", "full"])
        .arg("--out")
        .arg(directory.path().join("out.png"))
        .arg("--log")
        .arg(&log)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status();
    assert!(done.is_ok_and(|status| status.success()), "the headless run failed");
    makespan(&log)
}

/// The makespan, and the CPU of everything but the nodes as a fraction of the computer.
fn with_window(display: &Display) -> (f64, f64) {
    let directory = TempDir::new().expect("a temporary directory");
    let log = directory.path().join("run.anel");
    let mut window = Window::open(display, directory.path(), Some(&log));
    let mut cpu = None;
    while !log.exists() {
        // Seldom, since reading these figures slows the run too.
        sleep(Duration::from_millis(100));
        let now = [window.cpu_without_nodes(), display.cpu()];
        if cpu.is_none() && window.has_nodes() {
            cpu = Some((now, now));
        }
        if let Some((_, last)) = &mut cpu
            && window.has_nodes()
        {
            *last = now;
        }
    }
    window.close();
    let makespan = makespan(&log);
    let (first, last) = cpu.expect("the nodes were seen");
    let used: f64 = last.iter().zip(first).map(|(last, first)| last - first).sum();
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    (makespan, used / makespan / cores as f64)
}

/// Measures the CPU of the window and its display while a finished run is shown.
fn at_rest(display: &Display) {
    const REST: Duration = Duration::from_secs(10);
    let directory = TempDir::new().expect("a temporary directory");
    let log = directory.path().join("run.anel");
    let mut window = Window::open(display, directory.path(), Some(&log));
    while !log.exists() {
        sleep(Duration::from_millis(20));
    }
    // Waits until the notice below the top bar has disappeared.
    sleep(Duration::from_secs(10));
    let before = window.cpu() + display.cpu();
    sleep(REST);
    let used = window.cpu() + display.cpu() - before;
    window.close();
    println!(
        "\nat rest, a finished run shown: {:.2} % of one core over {} s",
        100.0 * used / REST.as_secs_f64(),
        REST.as_secs()
    );
}

fn makespan(log: &Path) -> f64 {
    let log = RunLog::load(log).expect("a run file");
    Metrics::of(&log).makespan().expect("a whole run").as_secs_f64()
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// A storage with the settings of an earlier window.
struct Storage(String);

impl eframe::Storage for Storage {
    fn get_string(&self, _key: &str) -> Option<String> {
        Some(self.0.clone())
    }

    fn set_string(&mut self, _key: &str, _value: String) {}

    fn remove_string(&mut self, _key: &str) {}

    fn flush(&mut self) {}
}

/// A virtual X server, closed on drop.
struct Display {
    server: Child,
    name: String,
}

impl Display {
    fn open() -> Option<Self> {
        use std::io::BufRead;
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1280x800x24", "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .ok()?;
        let mut number = String::new();
        std::io::BufReader::new(server.stdout.take()?).read_line(&mut number).ok()?;
        Some(Self { server, name: format!(":{}", number.trim()) })
    }

    fn cpu(&self) -> f64 {
        cpu_seconds(Path::new(&format!("/proc/{}/stat", self.server.id())))
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

struct Window(Child);

impl Window {
    fn open(display: &Display, home: &Path, log: Option<&Path>) -> Self {
        Self::open_with(display, home, log, SETTINGS)
    }

    /// Opens a window with these stored settings.
    fn open_with(display: &Display, home: &Path, log: Option<&Path>, settings: &str) -> Self {
        let remembered = home.join("anel");
        fs::create_dir_all(&remembered).expect("a directory");
        let quoted = format!("{{\"anel\": {settings:?}}}");
        fs::write(remembered.join("app.ron"), quoted).expect("a file");
        let mut command = Command::new(env!("CARGO_BIN_EXE_anel"));
        command.env("DISPLAY", &display.name).env("HOME", home).env("XDG_DATA_HOME", home);
        command.env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET").stderr(Stdio::null());
        if let Some(log) = log {
            command.arg("--log").arg(log);
        }
        Self(command.spawn().expect("the program starts"))
    }

    fn tasks(&self) -> Vec<std::path::PathBuf> {
        let tasks = fs::read_dir(format!("/proc/{}/task", self.0.id()));
        tasks.into_iter().flatten().filter_map(|task| Some(task.ok()?.path())).collect()
    }

    fn has_nodes(&self) -> bool {
        self.tasks().iter().any(|task| name(task).starts_with("node "))
    }

    /// CPU seconds of all threads that are not nodes.
    fn cpu_without_nodes(&self) -> f64 {
        let others = self.tasks().into_iter().filter(|task| !name(task).starts_with("node "));
        others.map(|task| cpu_seconds(&task.join("stat"))).sum()
    }

    fn cpu(&self) -> f64 {
        cpu_seconds(Path::new(&format!("/proc/{}/stat", self.0.id())))
    }

    fn close(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

impl Drop for Window {
    fn drop(&mut self) {
        self.close();
    }
}

fn name(task: &Path) -> String {
    fs::read_to_string(task.join("comm")).unwrap_or_default()
}

/// The seconds of user and system time in a `stat` file of Linux, whose unit is 1/100 s.
fn cpu_seconds(stat: &Path) -> f64 {
    let text = fs::read_to_string(stat).unwrap_or_default();
    let fields: Vec<_> = text.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let ticks = |index: usize| fields.get(index).and_then(|field| field.parse::<f64>().ok()).unwrap_or(0.0);
    (ticks(11) + ticks(12)) / 100.0
}
