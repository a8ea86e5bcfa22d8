//! Where no window can be opened, the run is done without one: one line gives the reason, and the picture is named.

use std::fs;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

use tempfile::TempDir;

/// Starts the viewer in an empty directory with these environment variables, unset if empty. It must do its run without
/// a window. Returns its error output.
fn runs_without_a_window(variables: &[(&str, &str)]) -> String {
    let directory = TempDir::new().expect("a temporary directory");
    let mut command = Command::new(env!("CARGO_BIN_EXE_anel"));
    command.current_dir(directory.path()).arg("csg-primer");
    for (name, value) in variables {
        if value.is_empty() {
            command.env_remove(name)
        } else {
            command.env(name, value)
        };
    }
    let output = command.output().expect("the program can be started");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{said}");
    assert_eq!(said.matches("no window can be opened").count(), 1, "{said}");
    assert!(!said.contains("panicked") && !said.contains("RUST_BACKTRACE"), "{said}");
    assert_eq!(String::from_utf8_lossy(&output.stdout).trim(), "csg-primer.png");
    let picture = image::open(directory.path().join("csg-primer.png")).expect("a picture");
    assert_eq!((picture.width(), picture.height()), (640, 480));
    said
}

#[test]
fn without_a_display() {
    runs_without_a_window(&[("DISPLAY", ""), ("WAYLAND_DISPLAY", ""), ("WAYLAND_SOCKET", "")]);
}

#[test]
fn recorded_run_is_traced_again_without_a_display() {
    let directory = TempDir::new().expect("a temporary directory");
    let anel = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_anel"));
        command.current_dir(directory.path()).args(arguments);
        command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
        let output = command.output().expect("the program can be started");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{said}");
        String::from_utf8_lossy(&output.stdout).trim().to_owned()
    };
    anel(&["render", "glass", "--out", "first.png", "--size", "80x60", "--nodes", "3", "--log", "run.anel"]);
    // By the command `replay`, and as the argument of the viewer.
    assert_eq!(anel(&["replay", "run.anel"]), "glass.png");
    assert_eq!(anel(&["run.anel"]), "glass-2.png");
    let picture = |name: &str| fs::read(directory.path().join(name)).expect("a picture");
    assert!(picture("first.png") == picture("glass.png") && picture("first.png") == picture("glass-2.png"));
}

#[test]
fn with_a_display_that_does_not_exist() {
    runs_without_a_window(&[("DISPLAY", ":4242"), ("WAYLAND_DISPLAY", ""), ("WAYLAND_SOCKET", "")]);
}

/// A virtual screen, closed on drop.
#[cfg(target_os = "linux")]
struct Screen {
    server: Child,
    name: String,
}

#[cfg(target_os = "linux")]
impl Screen {
    /// Starts Xvfb. Without it returns `None` with a message, or fails if `CI` is set.
    fn open(arguments: &[&str]) -> Option<Self> {
        let found = Command::new("Xvfb").arg("-help").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok();
        if !found {
            assert!(std::env::var_os("CI").is_none(), "Xvfb is missing");
            eprintln!("SKIPPED: this test needs Xvfb, which is not installed");
            return None;
        }
        // The server chooses a free display number and writes it to its output.
        let file = tempfile::NamedTempFile::new().expect("a temporary file");
        let server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-screen", "0", "800x600x24"])
            .args(arguments)
            .stdout(file.reopen().expect("the same file"))
            .stderr(Stdio::null())
            .spawn()
            .expect("Xvfb can be started");
        let mut screen = Self { server, name: String::new() };
        for _ in 0..200 {
            let number = fs::read_to_string(file.path()).unwrap_or_default();
            if number.ends_with('\n') {
                screen.name = format!(":{}", number.trim());
                return Some(screen);
            }
            sleep(Duration::from_millis(50));
        }
        panic!("Xvfb did not start within ten seconds");
    }
}

#[cfg(target_os = "linux")]
impl Drop for Screen {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

#[test]
#[cfg(target_os = "linux")]
fn without_opengl() {
    let Some(screen) = Screen::open(&["-extension", "GLX"]) else { return };
    runs_without_a_window(&[
        ("DISPLAY", &screen.name),
        ("WAYLAND_DISPLAY", ""),
        ("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere.json"),
    ]);
}

/// A dependency panics when this library is missing; an empty file in its place has the same effect.
#[test]
#[cfg(target_os = "linux")]
fn without_an_x_library() {
    let Some(screen) = Screen::open(&[]) else { return };
    let libraries = TempDir::new().expect("a temporary directory");
    fs::write(libraries.path().join("libxkbcommon-x11.so.0"), "").expect("a file");
    fs::write(libraries.path().join("libxkbcommon-x11.so"), "").expect("a file");
    let path = libraries.path().to_string_lossy();
    runs_without_a_window(&[("DISPLAY", &screen.name), ("WAYLAND_DISPLAY", ""), ("LD_LIBRARY_PATH", &path)]);
}
