//! The real window on a virtual display: Xvfb shows it, xdotool drags a slider in it, ImageMagick's `import` takes its
//! picture. Without these programs the test is skipped with a message, or fails if `CI` is set.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use anel::palette::node_colour;
use anel::record::RecordKind;
use anel::runlog::RunLog;
use image::RgbImage;

/// The programs that the test needs.
const PROGRAMS: [&str; 3] = ["Xvfb", "xdotool", "import"];

#[test]
fn window_shows_the_run_and_obeys_the_mouse() {
    let missing: Vec<_> = PROGRAMS.into_iter().filter(|program| !is_installed(program)).collect();
    if !missing.is_empty() {
        assert!(std::env::var_os("CI").is_none(), "not installed: {missing:?}");
        eprintln!("\n*** SKIPPED: the window was NOT tested, since these are not installed: {missing:?} ***\n");
        return;
    }
    let directory = tempfile::tempdir().expect("a temporary directory");
    let log = directory.path().join("run.anel");
    let display = Display::new();
    let mut window = Window::open(&display, directory.path(), &log);

    display.wait_for_window();
    std::thread::sleep(Duration::from_secs(1));

    // Node 1 from full speed to about a third, in steps as by hand.
    let slider = window.place("Speed of machine 1");
    let y = slider.middle()[1];
    let from = slider.x + slider.width - slider.height / 2;
    // On its logarithmic scale a third is at four fifths.
    let to = slider.x + 4 * slider.width / 5;
    display.xdotool(&["mousemove", &from.to_string(), &y.to_string()]);
    display.xdotool(&["mousedown", "1"]);
    for step in 1..=8 {
        std::thread::sleep(Duration::from_millis(40));
        let x = from + (to - from) * step / 8;
        display.xdotool(&["mousemove", &x.to_string(), &y.to_string()]);
    }
    std::thread::sleep(Duration::from_millis(200));
    display.xdotool(&["mouseup", "1"]);
    std::thread::sleep(Duration::from_secs(2));

    let shot = display.shot(&directory.path().join("shot.png"));
    let (picture, ring) = (window.place("Picture"), window.place("The ring"));
    let mut colours: Vec<_> = pixels(&shot, picture).collect();
    colours.sort_unstable();
    colours.dedup();
    assert!(colours.len() > 100, "only {} colours in the picture", colours.len());
    for node in 0..8 {
        let own = node_colour(node);
        let seen = pixels(&shot, ring).filter(|&pixel| pixel == own).count();
        assert!(seen > 20, "node {} shows {seen} pixels of its colour", node + 1);
    }

    display.xdotool(&["search", "--name", "^anel$", "windowfocus"]);
    display.xdotool(&["key", "ctrl+q"]);
    window.wait();
    let log = RunLog::load(&log).expect("a run file");
    let speeds: Vec<_> = log
        .records()
        .iter()
        .filter_map(
            |record| if let RecordKind::SpeedSet { node, speed } = record.kind { Some((node, speed)) } else { None },
        )
        .collect();
    let last = speeds.last().copied();
    assert!(last.is_some_and(|(node, speed)| node == 0 && (0.1..0.6).contains(&speed)), "{speeds:?}");
}

fn is_installed(program: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|directory| directory.join(program).is_file())
}

fn pixels(shot: &RgbImage, place: Place) -> impl Iterator<Item = [u8; 3]> {
    let clip = |at: i32, side: u32| at.clamp(0, side as i32) as u32;
    let [left, right] = [place.x, place.x + place.width].map(|x| clip(x, shot.width()));
    let [top, bottom] = [place.y, place.y + place.height].map(|y| clip(y, shot.height()));
    (top..bottom).flat_map(move |y| (left..right).map(move |x| shot.get_pixel(x, y).0))
}

/// A virtual X server, closed on drop.
struct Display {
    server: Child,
    name: String,
}

impl Display {
    fn new() -> Self {
        // The server chooses a free display number and writes it to its output.
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "1280x800x24", "-nolisten", "tcp"])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb starts");
        let mut number = String::new();
        let output = server.stdout.take().expect("it is piped");
        BufReader::new(output).read_line(&mut number).expect("a display's number");
        Self { server, name: format!(":{}", number.trim()) }
    }

    fn xdotool(&self, arguments: &[&str]) {
        let done = Command::new("xdotool").args(arguments).env("DISPLAY", &self.name).stdout(Stdio::null()).status();
        assert!(done.is_ok_and(|status| status.success()), "xdotool {arguments:?}");
    }

    /// Waits until the window is visible.
    ///
    /// # Panics
    /// If that takes longer than a minute.
    fn wait_for_window(&self) {
        for _ in 0..600 {
            let search = ["search", "--onlyvisible", "--name", "^anel$"];
            let found = Command::new("xdotool").args(search).env("DISPLAY", &self.name).stdout(Stdio::null()).status();
            if found.is_ok_and(|status| status.success()) {
                return;
            }
            std::thread::sleep(Duration::from_millis(100));
        }
        panic!("no window within a minute");
    }

    fn shot(&self, path: &Path) -> RgbImage {
        let done = Command::new("import").args(["-window", "root"]).arg(path).env("DISPLAY", &self.name).status();
        assert!(done.is_ok_and(|status| status.success()), "import failed");
        image::open(path).expect("a PNG").to_rgb8()
    }
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// The place of a widget, in pixels.
#[derive(Clone, Copy, Debug)]
struct Place {
    x: i32,
    y: i32,
    width: i32,
    height: i32,
}

impl Place {
    fn middle(self) -> [i32; 2] {
        [self.x + self.width / 2, self.y + self.height / 2]
    }
}

/// The program with its window.
struct Window {
    program: Child,
    lines: Receiver<String>,
    places: Vec<(String, Place)>,
}

impl Window {
    fn open(display: &Display, home: &Path, log: &Path) -> Self {
        let mut program = Command::new(PathBuf::from(env!("CARGO_BIN_EXE_anel")))
            .arg("--log")
            .arg(log)
            .env("DISPLAY", &display.name)
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("WAYLAND_SOCKET")
            // Settings of earlier windows must not count.
            .env("HOME", home)
            .env("XDG_DATA_HOME", home)
            .env("ANEL_PLACES", "1")
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        let (sender, lines) = channel();
        let output = BufReader::new(program.stderr.take().expect("it is piped"));
        let read = move || output.lines().map_while(Result::ok).all(|line| sender.send(line).is_ok());
        std::thread::Builder::new().name("places".into()).spawn(read).expect("a thread");
        Self { program, lines, places: Vec::new() }
    }

    /// The current place of the widget with this accessible name.
    fn place(&mut self, name: &str) -> Place {
        let limit = Duration::from_secs(30);
        loop {
            // All lines so far are read first, since widgets may have moved; without a place yet, the next line is
            // awaited.
            let known = self.places.iter().rposition(|(known, _)| known == name);
            let line = match known {
                Some(known) => match self.lines.try_recv() {
                    Ok(line) => line,
                    Err(_) => return self.places[known].1,
                },
                None => self.lines.recv_timeout(limit).unwrap_or_else(|_| panic!("no place of {name}")),
            };
            if let Some(place) = parse(&line) {
                self.places.push(place);
            } else {
                eprintln!("anel says: {line}");
            }
        }
    }

    fn wait(&mut self) {
        for _ in 0..600 {
            if self.program.try_wait().expect("a child").is_some() {
                return;
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        panic!("the window has not closed within half a minute");
    }
}

impl Drop for Window {
    fn drop(&mut self) {
        let _ = self.program.kill();
        let _ = self.program.wait();
    }
}

/// `place: NAME: X Y WIDTH HEIGHT`
fn parse(line: &str) -> Option<(String, Place)> {
    let (name, numbers) = line.strip_prefix("place: ")?.rsplit_once(": ")?;
    let numbers: Vec<i32> = numbers.split(' ').map(|number| number.parse().ok()).collect::<Option<_>>()?;
    let &[x, y, width, height] = &numbers[..] else { return None };
    Some((name.to_owned(), Place { x, y, width, height }))
}
